//! Files that users write: machines, and layers of settings in TOML.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use serde::de::DeserializeOwned;
use softstop::Machine;

use crate::failure::Failure;

/// Reads a machine file. A machine without a name is called as the file.
///
/// # Errors
/// [`Failure::Usage`] naming the file, and line, key, value and range of what is wrong in it.
pub fn read(path: &Path) -> Result<Machine, Failure> {
    let wrong = |error| Failure::usage(format!("{}: {error}", path.display()));
    let mut machine = Machine::from_toml(&text(path)?).map_err(wrong)?;
    let stem = || Some(path.file_stem()?.to_string_lossy().into_owned());
    machine.name = machine.name.or_else(stem);
    Ok(machine)
}

/// Bytes of a file at most.
const LONGEST: u64 = 1 << 20;

/// Reads a file that a user has written, or a pipe.
///
/// # Errors
/// [`Failure::Usage`] naming the file if it cannot be read, or has more than 1 MiB.
pub fn text(path: &Path) -> Result<String, Failure> {
    let read = || {
        let mut text = String::new();
        File::open(path)?
            .take(LONGEST + 1)
            .read_to_string(&mut text)?;
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
    toml::from_str(&text(path)?)
        .map_err(|error| Failure::usage(format!("{}: {error}", path.display())))
}
