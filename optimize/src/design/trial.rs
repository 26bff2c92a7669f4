//! Requirements that take many simulated motions: establishing certainty, run-up from rest, missing strips. They have
//! no derivatives: `pass` seeks a design that meets them.

use softstop_console::interrupt;
use softstop_dynamics::Orbit;
use softstop_dynamics::attractors::SurveyError;
use softstop_dynamics::basin::Establishment;
use softstop_dynamics::run_up::RunUp;
use softstop_dynamics::supply::{Reading, outlasts};

use super::figure::Figure;
use super::judge::Met;
use super::problem::Problem;
use super::requirement::Requirement;

/// Starts of the box, and drive angles at which the drive is switched on or strips are missing.
const STARTS: usize = 1024;
const ANGLES: usize = 64;

impl Problem {
    /// What a motion has of the requirements that take many.
    ///
    /// # Errors
    /// [`SurveyError`] if a motion cannot be computed, or somebody asked to stop.
    pub fn tried(&self, orbit: &Orbit) -> Result<Vec<Met>, SurveyError> {
        let trials = self.requirements.iter().filter(|it| it.figure.is_trial());
        let tried = trials.map(|requirement| {
            let (value, starts) = value(requirement, orbit)?;
            Ok(Met {
                requirement: *requirement,
                value,
                starts,
            })
        });
        tried.collect()
    }

    /// True if a motion must be tried.
    pub fn has_trials(&self) -> bool {
        self.requirements.iter().any(|it| it.figure.is_trial())
    }
}

/// The share of starts that lead to a motion.
///
/// # Errors
/// As [`Problem::tried`].
pub(super) fn certainty(orbit: &Orbit) -> Result<f64, SurveyError> {
    Ok(Establishment::of(orbit, STARTS, &interrupt::watch)?.share)
}

/// What a motion has of a figure, and the starts that tell it.
fn value(
    requirement: &Requirement,
    orbit: &Orbit,
) -> Result<(f64, Option<Establishment>), SurveyError> {
    let watcher = &interrupt::watch;
    let value = match requirement.figure {
        Figure::Certainty => {
            let starts = Establishment::of(orbit, STARTS, watcher)?;
            return Ok((starts.share, Some(starts)));
        }
        Figure::Integrity => {
            let (starts, radius) = Establishment::with_ball(orbit, STARTS, watcher)?;
            return Ok((radius, Some(starts)));
        }
        Figure::RunUp => RunUp::of(orbit, ANGLES, watcher)?.works().count() as f64,
        Figure::MissingStrips => f64::from(survived(requirement, orbit)?),
        _ => f64::NAN,
    };
    Ok((value, None))
}

/// Strips in a row that may be missing, as many as are asked for at most.
fn survived(requirement: &Requirement, orbit: &Orbit) -> Result<u32, SurveyError> {
    let most = requirement.least.unwrap_or(0.0) as u32;
    for missing in 1..=most {
        let gaps = outlasts(orbit, missing, Reading::Fixed, ANGLES, &interrupt::watch)?;
        if gaps.share() < 1.0 {
            return Ok(missing - 1);
        }
    }
    Ok(most)
}
