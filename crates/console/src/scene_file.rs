//! Machine files as scenes.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use serde::de::DeserializeOwned;
use softstop::{Machine, Scene, Start};

use crate::failure::Failure;

/// A machine and where it starts.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneFile {
    /// The machine; its parameters are in range.
    pub scene: Scene,
    /// The state at time 0; at rest at position 0 unless the file says otherwise.
    pub start: Start,
}

/// Reads a scene file.
///
/// # Errors
/// [`Failure::Usage`] naming the file, and line, key, value and range of what is wrong in it.
pub fn read(path: &Path) -> Result<SceneFile, Failure> {
    parse(&text(path)?).map_err(|error| Failure::usage(format!("{}: {error}", path.display())))
}

/// Reads the text of a scene file.
///
/// # Errors
/// What is wrong, without the name of the file.
pub fn parse(text: &str) -> Result<SceneFile, String> {
    let Machine { scene, start, .. } =
        Machine::from_toml(text).map_err(|error| error.to_string())?;
    Ok(SceneFile { scene, start })
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
