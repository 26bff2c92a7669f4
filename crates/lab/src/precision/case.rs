//! The motions that methods are measured on: built-in ones, and any scene file.

use softstop_console::failure::Failure;

pub use crate::scenes::Case;
use crate::scenes::{BuiltIn, built_in};

/// Drive periods of a scene file.
pub const PERIODS: f64 = 20.0;

/// All built-in scenes.
pub const BUILT_IN: [BuiltIn; 8] = built_in! {
    "precision/":
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
    let places = match scene {
        ALL => BUILT_IN.map(|it| it.name).to_vec(),
        _ => vec![scene],
    };
    let case = |place| {
        let case = Case::find(place, &BUILT_IN, PERIODS)?;
        let periods = periods.unwrap_or(case.periods);
        Ok(Case { periods, ..case })
    };
    places.into_iter().map(case).collect()
}
