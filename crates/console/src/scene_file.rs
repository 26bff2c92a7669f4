//! Machine files as scenes.

use std::fs;
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
    let place = path.display();
    let text = fs::read_to_string(path)
        .map_err(|error| Failure::usage(format!("{place}: cannot be read: {error}")))?;
    parse(&text).map_err(|error| Failure::usage(format!("{place}: {error}")))
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

/// Reads a TOML file into the layer it describes.
///
/// # Errors
/// [`Failure::Usage`] naming the file and, for unknown keys and wrong values, line and key.
pub fn read_toml<T: DeserializeOwned>(path: &Path) -> Result<T, Failure> {
    let text = fs::read_to_string(path)
        .map_err(|error| Failure::usage(format!("{}: cannot be read: {error}", path.display())))?;
    toml::from_str(&text).map_err(|error| Failure::usage(format!("{}: {error}", path.display())))
}
