//! Scenes that come with the program, by name, and others from files.

use std::path::Path;

use crate::methods::Task;
use crate::reference::{self, Reference};
use softstop::Machine;
use softstop_console::failure::Failure;
use softstop_console::scene_file;

/// A scene that comes with the program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BuiltIn {
    /// Name on the command line.
    pub name: &'static str,
    /// Name among the stored references.
    pub(crate) reference: &'static str,
    /// What is special about it.
    pub title: &'static str,
    /// Drive periods.
    pub periods: f64,
    pub(crate) text: &'static str,
}

/// Built-in scenes: what their references' names begin with, then of each its name, file in docs, drive periods, and what is
/// special about it.
macro_rules! built_in {
    ($kind:literal: $($name:literal, $file:literal, $periods:literal, $title:literal;)*) => {
        [$($crate::scenes::BuiltIn {
            name: $name,
            reference: concat!($kind, $name),
            title: $title,
            periods: $periods,
            text: include_str!(concat!("../../../../docs/", $file, ".toml")),
        }),*]
    };
}
pub(crate) use built_in;

/// A machine with its start and the drive periods that it runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Its name, which its files bear.
    pub name: String,
    /// What is special about it.
    pub title: String,
    /// Machine and start.
    pub machine: Machine,
    /// Drive periods to run.
    pub periods: f64,
    /// Its name among the stored references, if it comes with the program.
    pub reference: Option<&'static str>,
}

impl Case {
    /// The built-in scene of this name, or that of the file at this path, which runs so many periods.
    ///
    /// # Errors
    /// [`Failure::Usage`] if there is neither, naming the built-in scenes, or a file does not describe a machine.
    pub fn find(place: &str, known: &[BuiltIn], periods: f64) -> Result<Self, Failure> {
        if let Some(known) = known.iter().find(|known| known.name == place) {
            let machine = Machine::from_toml(known.text)
                .map_err(|error| Failure::usage(format!("{place}: {error}")))?;
            return Ok(Self {
                name: place.to_owned(),
                title: known.title.to_owned(),
                machine,
                periods: known.periods,
                reference: Some(known.reference),
            });
        }
        let path = Path::new(place);
        if !path.exists() {
            let names: Vec<&str> = known.iter().map(|known| known.name).collect();
            return Err(Failure::usage(format!(
                "scene = {place}: must be a TOML file or one of {}",
                names.join(", ")
            )));
        }
        let name = path.file_stem().unwrap_or(path.as_os_str());
        Ok(Self {
            name: name.to_string_lossy().into_owned(),
            title: place.to_owned(),
            machine: scene_file::read(path)?,
            periods,
            reference: None,
        })
    }

    /// Its motion.
    pub fn task(&self) -> Task {
        let Machine { scene, start, .. } = &self.machine;
        Task::new(scene.clone(), *start, self.periods, u64::MAX)
    }

    /// Its motion in many digits, with its own stop or with one of this stiffness in N/m, if it is stored.
    pub fn stored(&self, stiffness: Option<f64>) -> Option<Reference> {
        reference::stored(self.reference?, self.periods, stiffness)
    }
}
