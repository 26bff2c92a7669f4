//! Files that users write: machines, and layers of settings in TOML.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;
use std::sync::OnceLock;

use serde::de::DeserializeOwned;
use softstop::Machine;

use crate::failure::Failure;
use crate::names::file_stem;

/// Reads a machine file. A machine without a name is called as the file.
///
/// # Errors
/// [`Failure::Usage`] naming the file, and line, key, value and range of what is wrong in it.
pub fn read(path: &Path) -> Result<Machine, Failure> {
    let wrong = |error| Failure::usage(format!("{}: {error}", path.display()));
    let text = text(path)?;
    let mut machine = Machine::from_toml(&text).map_err(wrong)?;
    if let Some(check) = TASKS.get() {
        check(&machine, path, &text)?;
    }
    let stem = || Some(file_stem(&path.file_stem()?.to_string_lossy()));
    machine.name = machine.name.or_else(stem);
    Ok(machine)
}

/// A check of what a file of this machine, at its place and with its text, says is to be done with the machine
/// ([`Machine::TASK`]).
pub type Check = fn(&Machine, &Path, &str) -> Result<(), Failure>;

static TASKS: OnceLock<Check> = OnceLock::new();

/// Has each machine file checked that is read from now on: a program that knows tasks calls this once, at its start. So
/// every command refuses what `softstop optimize` would refuse.
pub fn check_tasks(check: Check) {
    TASKS.get_or_init(|| check);
}

/// Bytes of a file at most.
const LONGEST: u64 = 1 << 20;

/// Opens a file to read it. A pipe is read if it is open already (`/dev/stdin`, or `<(…)` of a shell); one that has a
/// place among the files is refused: it might wait for its writer for ever.
///
/// # Errors
/// What the system says.
pub fn open(path: &Path) -> io::Result<File> {
    #[cfg(unix)]
    if let Ok(place) = fs::canonicalize(path) {
        use std::os::unix::fs::FileTypeExt;

        if fs::metadata(place)?.file_type().is_fifo() {
            return Err(io::Error::other("it is a named pipe"));
        }
    }
    File::open(path)
}

/// Reads a file that a user has written.
///
/// # Errors
/// [`Failure::Usage`] naming the file if it cannot be read ([`open`]), or has more than 1 MiB.
pub fn text(path: &Path) -> Result<String, Failure> {
    let read = || {
        let mut text = String::new();
        open(path)?.take(LONGEST + 1).read_to_string(&mut text)?;
        match text.len() as u64 > LONGEST {
            true => Err(io::Error::other("it has more than 1 MiB")),
            false => Ok(text),
        }
    };
    read().map_err(|error| Failure::usage(format!("{}: cannot be read: {error}", path.display())))
}

/// Reads a TOML file into the layer it describes.
///
/// # Errors
/// [`Failure::Usage`] naming the file and, for unknown keys and wrong values, line and key.
pub fn read_toml<T: DeserializeOwned>(path: &Path) -> Result<T, Failure> {
    parse(path, &text(path)?)
}

/// The layer that the text of a TOML file describes.
///
/// # Errors
/// As [`read_toml`].
pub fn parse<T: DeserializeOwned>(path: &Path, text: &str) -> Result<T, Failure> {
    toml::from_str(text).map_err(|error| Failure::of_toml(path, text, &error))
}
