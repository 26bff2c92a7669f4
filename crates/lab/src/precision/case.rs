//! The motions that methods are measured on: built-in ones, and any scene file.

use std::path::Path;

use crate::methods::Task;

use softstop_console::failure::Failure;
use softstop_console::scene_file::{self, SceneFile};

/// A motion to be computed.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Its name, which its files bear.
    pub name: String,
    /// What is special about it.
    pub title: String,
    /// Machine, start and duration.
    pub task: Task,
}

/// A scene of `docs/scenes` and how long it runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BuiltIn {
    /// Name on the command line.
    pub name: &'static str,
    /// What is special about it.
    pub title: &'static str,
    /// Drive periods.
    pub periods: f64,
    text: &'static str,
}

/// Drive periods of a scene file.
pub const PERIODS: f64 = 20.0;

macro_rules! built_in {
    ($name:literal, $file:literal, $periods:literal, $title:literal) => {
        BuiltIn {
            name: $name,
            title: $title,
            periods: $periods,
            text: include_str!(concat!("../../../../docs/scenes/", $file, ".toml")),
        }
    };
}

/// All built-in scenes.
pub const BUILT_IN: [BuiltIn; 8] = [
    built_in!(
        "periodic",
        "preloaded",
        200.0,
        "preloaded stop, one impact per period (point A)"
    ),
    built_in!(
        "chaotic",
        "chaotic",
        20.0,
        "preloaded stop, chaos at η = 0.9875"
    ),
    built_in!(
        "stiff",
        "stiff",
        20.0,
        "stop a million times the suspension"
    ),
    built_in!(
        "chatter",
        "chatter",
        5.5,
        "rigid stop, bounces pile up to rest"
    ),
    built_in!("hertz", "hertz", 20.0, "Hertz contact, exponent 3/2"),
    built_in!(
        "grazing",
        "grazing",
        20.0,
        "preloaded stop, first touched by a hair"
    ),
    built_in!(
        "sticking",
        "sticking",
        5.0,
        "dry friction holds the mass half-way through a strip"
    ),
    built_in!(
        "loaded",
        "loaded",
        50.0,
        "piercing a strip in every period (point B)"
    ),
];

/// The name that stands for all built-in scenes.
pub const ALL: &str = "all";

/// The cases of a name: a built-in scene, [`ALL`] of them or a file; of other length if `periods` says so.
///
/// # Errors
/// [`Failure::Usage`] if it is neither, or the file cannot be read.
pub fn cases(scene: &str, periods: Option<f64>) -> Result<Vec<Case>, Failure> {
    let wanted = |built_in: &&BuiltIn| scene == ALL || built_in.name == scene;
    let found: Vec<&BuiltIn> = BUILT_IN.iter().filter(wanted).collect();
    if found.is_empty() {
        return Ok(vec![from_file(Path::new(scene), periods)?]);
    }
    let case = |built_in: &BuiltIn| {
        let file = scene_file::parse(built_in.text)
            .map_err(|error| Failure::usage(format!("{}: {error}", built_in.name)))?;
        let periods = periods.unwrap_or(built_in.periods);
        Ok(Case {
            name: built_in.name.to_owned(),
            title: built_in.title.to_owned(),
            task: task(file, periods),
        })
    };
    found.into_iter().map(case).collect()
}

fn from_file(path: &Path, periods: Option<f64>) -> Result<Case, Failure> {
    if !path.exists() {
        let names: Vec<&str> = BUILT_IN.iter().map(|built_in| built_in.name).collect();
        return Err(Failure::usage(format!(
            "scene = {}: must be {}, {ALL} or a TOML file",
            path.display(),
            names.join(", ")
        )));
    }
    let file = scene_file::read(path)?;
    let stem = path.file_stem().unwrap_or(path.as_os_str());
    Ok(Case {
        name: stem.to_string_lossy().into_owned(),
        title: path.display().to_string(),
        task: task(file, periods.unwrap_or(PERIODS)),
    })
}

fn task(file: SceneFile, periods: f64) -> Task {
    Task {
        scene: file.scene,
        start: file.start,
        periods,
        most_steps: u64::MAX,
    }
}
