//! Scenes as TOML files: the fields of [`softstop::Scene`] in SI units, and a `[start]`.

use std::fs;
use std::path::Path;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use softstop::{Scene, Start};
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer, Error, ValueDeserializer};

use crate::failure::Failure;

/// A machine and where it starts.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneFile {
    /// The machine; its parameters are in range.
    pub scene: Scene,
    /// The state at time 0; at rest at position 0 unless the file says otherwise.
    pub start: Start,
}

/// The table `[start]`.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct StartTable {
    /// In m.
    position: f64,
    /// In m/s.
    velocity: f64,
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
    let (scene, start) = split(text).map_err(|mut error| {
        error.set_input(Some(text));
        error.to_string()
    })?;
    scene.validate().map_err(|error| error.to_string())?;
    let start = Start {
        position: start.position,
        velocity: start.velocity,
    };
    start.validate().map_err(|error| format!("start.{error}"))?;
    Ok(SceneFile { scene, start })
}

/// The scene and the table `[start]` beside it.
fn split(text: &str) -> Result<(Scene, StartTable), Error> {
    let mut table = DeTable::parse(text)?;
    let start = table.get_mut().remove("start").map_or_else(
        || Ok(StartTable::default()),
        |value: Spanned<DeValue<'_>>| StartTable::deserialize(ValueDeserializer::from(value)),
    )?;
    let scene = Scene::deserialize(Deserializer::from(table))?;
    Ok((scene, start))
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
