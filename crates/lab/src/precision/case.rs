//! The motions that methods are measured on: built-in ones, and any scene file.

use softstop::Machine;
use softstop_console::failure::Failure;

use crate::methods::Task;
use crate::reference::{self, Reference};
use crate::scenes::{self, BuiltIn, built_in};

/// A motion to be computed.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Its name, which its files bear.
    pub name: String,
    /// What is special about it.
    pub title: String,
    /// Machine, start and duration.
    pub task: Task,
    /// Whether it is built in.
    pub is_built_in: bool,
}

impl Case {
    /// Its motion in many digits, if it is stored.
    pub fn stored(&self) -> Option<Reference> {
        let stored =
            || reference::stored(&format!("precision/{}", self.name), self.task.periods, None);
        self.is_built_in.then(stored)?
    }
}

/// Drive periods of a scene file.
pub const PERIODS: f64 = 20.0;

/// All built-in scenes.
pub const BUILT_IN: [BuiltIn; 8] = built_in! {
    "periodic", "scenes/preloaded", 200.0, "preloaded stop, one impact per period (point A)";
    "chaotic", "scenes/chaotic", 20.0, "preloaded stop, chaos at η = 0.9875";
    "stiff", "scenes/stiff", 20.0, "stop a million times the suspension";
    "chatter", "scenes/chatter", 5.5, "rigid stop, bounces pile up to rest";
    "hertz", "scenes/hertz", 20.0, "Hertz contact, exponent 3/2";
    "grazing", "scenes/grazing", 20.0, "preloaded stop, first touched by a hair";
    "sticking", "scenes/sticking", 5.0, "dry friction holds the mass half-way through a strip";
    "loaded", "scenes/loaded", 50.0, "piercing a strip in every period (point B)";
};

/// The name that stands for all built-in scenes.
pub const ALL: &str = "all";

/// The cases of a name: a built-in scene, [`ALL`] of them or a file; of other length if `periods` says so.
///
/// # Errors
/// [`Failure::Usage`] if it is neither, or the file cannot be read.
pub fn cases(scene: &str, periods: Option<f64>) -> Result<Vec<Case>, Failure> {
    let wanted = |built_in: &&BuiltIn| scene == ALL || built_in.name == scene;
    let found: Vec<&BuiltIn> = BUILT_IN.iter().filter(wanted).collect();
    let case = |name: &str, title: &str, machine: Machine, length: f64| Case {
        name: name.to_owned(),
        title: title.to_owned(),
        task: Task::new(
            machine.scene,
            machine.start,
            periods.unwrap_or(length),
            u64::MAX,
        ),
        is_built_in: !found.is_empty(),
    };
    if found.is_empty() {
        let (name, machine) = scenes::read(scene, &BUILT_IN)?;
        return Ok(vec![case(&name, scene, machine, PERIODS)]);
    }
    let built_in = |it: &BuiltIn| {
        let machine = it.machine()?;
        Ok(case(it.name, it.title, machine, it.periods))
    };
    found.iter().copied().map(built_in).collect()
}
