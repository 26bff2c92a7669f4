//! Scenes that come with the program, by name, and others from files.

use std::path::Path;

use softstop::Machine;
use softstop_console::failure::Failure;
use softstop_console::scene_file;

/// A scene that comes with the program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BuiltIn {
    /// Name on the command line.
    pub name: &'static str,
    /// What is special about it.
    pub title: &'static str,
    /// Drive periods.
    pub periods: f64,
    pub(crate) text: &'static str,
}

/// Built-in scenes: name, file in docs, drive periods, and what is special about each.
macro_rules! built_in {
    ($($name:literal, $file:literal, $periods:literal, $title:literal;)*) => {
        [$($crate::scenes::BuiltIn {
            name: $name,
            title: $title,
            periods: $periods,
            text: include_str!(concat!("../../../../docs/", $file, ".toml")),
        }),*]
    };
}
pub(crate) use built_in;

impl BuiltIn {
    /// Its machine.
    ///
    /// # Errors
    /// [`Failure::Usage`] if its text is none.
    pub fn machine(&self) -> Result<Machine, Failure> {
        Machine::from_toml(self.text)
            .map_err(|error| Failure::usage(format!("{}: {error}", self.name)))
    }
}

/// The machine of the file at a path, and the file's name without folder and ending.
///
/// # Errors
/// [`Failure::Usage`] if there is none, naming the built-in scenes that could have been meant.
pub fn read(place: &str, known: &[BuiltIn]) -> Result<(String, Machine), Failure> {
    let path = Path::new(place);
    if !path.exists() {
        let names: Vec<&str> = known.iter().map(|known| known.name).collect();
        return Err(Failure::usage(format!(
            "scene = {place}: must be a TOML file or one of {}",
            names.join(", ")
        )));
    }
    let name = path.file_stem().unwrap_or(path.as_os_str());
    Ok((name.to_string_lossy().into_owned(), scene_file::read(path)?))
}
