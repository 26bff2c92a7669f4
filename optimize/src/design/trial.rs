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

/// Starts of the box.
pub const STARTS: usize = 1024;
/// Drive angles at which the drive is switched on or strips are missing.
pub const ANGLES: usize = 64;

/// How many motions a trial counts.
#[derive(Debug, Clone, Copy)]
pub(super) struct Effort {
    starts: usize,
    angles: usize,
}

/// As many as results are told by, and a quarter of them.
pub(super) const FULL: Effort = Effort {
    starts: STARTS,
    angles: ANGLES,
};
pub(super) const ROUGH: Effort = Effort {
    starts: STARTS / 4,
    angles: ANGLES / 4,
};

impl Problem {
    /// The requirements that take many motions.
    fn trials(&self) -> impl Iterator<Item = &Requirement> {
        self.requirements.iter().filter(|it| it.figure.is_trial())
    }

    /// What a motion has of the requirements that take many.
    ///
    /// # Errors
    /// [`SurveyError`] if a motion cannot be computed, or somebody asked to stop.
    pub fn tried(&self, orbit: &Orbit) -> Result<Vec<Met>, SurveyError> {
        let tried = self.trials().map(|requirement| {
            let (value, starts) = value(requirement, orbit, FULL)?;
            Ok(Met {
                requirement: *requirement,
                value,
                starts,
            })
        });
        tried.collect()
    }

    /// Whether a motion meets the requirements that take many.
    pub(super) fn passes(&self, orbit: &Orbit, effort: Effort) -> bool {
        self.trials().all(|requirement| {
            value(requirement, orbit, effort)
                .is_ok_and(|(value, _)| requirement.margin(value) >= 0.0)
        })
    }

    /// The share of starts that must lead to a motion, if any.
    pub(super) fn least_share(&self) -> Option<f64> {
        let mut all = self.trials();
        all.find(|it| it.figure == Figure::Certainty)?.least
    }

    /// True if a motion must be tried.
    pub fn has_trials(&self) -> bool {
        self.trials().next().is_some()
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
    Effort { starts, angles }: Effort,
) -> Result<(f64, Option<Establishment>), SurveyError> {
    let watcher = &interrupt::watch;
    let value = match requirement.figure {
        Figure::Certainty => {
            let starts = Establishment::of(orbit, starts, watcher)?;
            return Ok((starts.share, Some(starts)));
        }
        Figure::Integrity => {
            let (starts, radius) = Establishment::with_ball(orbit, starts, watcher)?;
            return Ok((radius, Some(starts)));
        }
        Figure::RunUp => RunUp::of(orbit, angles, watcher)?.works().count() as f64,
        Figure::MissingStrips => f64::from(survived(requirement, orbit, angles)?),
        _ => f64::NAN,
    };
    Ok((value, None))
}

/// Strips in a row that may be missing, as many as are asked for at most.
fn survived(requirement: &Requirement, orbit: &Orbit, angles: usize) -> Result<u32, SurveyError> {
    let most = requirement.least.unwrap_or(0.0) as u32;
    for missing in 1..=most {
        let gaps = outlasts(orbit, missing, Reading::Fixed, angles, &interrupt::watch)?;
        if gaps.share() < 1.0 {
            return Ok(missing - 1);
        }
    }
    Ok(most)
}
