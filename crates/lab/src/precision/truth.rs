//! The motion that all are measured against.

use crate::methods::{Exact, Integrator, Solution, Task};
use anyhow::{Context, anyhow};

use super::errors::{Errors, Scale};
use crate::reference::Reference;
use crate::solvers::{Adaptive, AdaptiveScheme};
use softstop_console::failure::Failure;

/// How stored motions were found.
const DIGITS: &str = "Taylor series in 67 decimal digits, checked in 48";
/// How all others are found.
const AGREED: &str = "the exact method, borne out by Dormand and Prince's 8(5,3) at a tolerance of 1e-13; errors \
    below their difference cannot be told";
/// The method that bears the exact one out.
pub(crate) const OTHER: Adaptive = Adaptive {
    scheme: AdaptiveScheme::Dop853,
    tolerance: 1e-13,
};
/// Least error of doubles: half a unit in the last place, relative.
const ROUNDING: f64 = 0.5 * f64::EPSILON;

/// The true motion.
#[derive(Debug, Clone)]
pub struct Truth {
    /// End and impacts, rounded to doubles.
    pub solution: Solution,
    /// How it was found.
    pub method: &'static str,
    /// How far two computations of it are apart: smaller errors cannot be told.
    pub doubt: Errors,
}

impl Truth {
    /// The true motion of a task of this size, as it is stored or as two methods agree on it.
    ///
    /// # Errors
    /// [`Failure::Run`] if it is not stored and the methods do not agree.
    pub fn of(task: &Task, scale: &Scale, stored: Option<Reference>) -> Result<Self, Failure> {
        task.scene.motion(task.start)?;
        stored.map_or_else(
            || Self::agreed(task, scale),
            |reference| Ok(Self::rounded(reference, scale)),
        )
    }

    fn rounded(reference: Reference, scale: &Scale) -> Self {
        let doubt = reference.doubt;
        Self {
            solution: reference.solution,
            method: DIGITS,
            doubt: Errors {
                end: doubt.end / scale.position.min(scale.velocity),
                impact_time: Some(doubt.impact_time / scale.period),
                impact_velocity: Some(doubt.impact_velocity / scale.velocity),
                impact_difference: 0,
            },
        }
    }

    /// The exact method's answer, if a method that shares no code with it agrees.
    fn agreed(task: &Task, scale: &Scale) -> Result<Self, Failure> {
        let solution = Exact.integrate(task).context("no reference")?;
        let other = OTHER.integrate(task).context("no reference")?;
        let doubt = Errors::between(&other, &solution, scale);
        if doubt.impact_difference != 0 {
            let apart = doubt.impact_difference.abs();
            let what = format!("two methods differ by {apart} impacts; take fewer periods");
            return Err(anyhow!("no reference: {what}").into());
        }
        Ok(Self {
            solution,
            method: AGREED,
            doubt,
        })
    }

    /// Decimal digits, relative to the motion's size, in which both computations agree; 48 at most.
    pub fn digits(&self) -> u32 {
        (-self.doubt.worst().log10()).clamp(0.0, 48.0) as u32
    }

    /// What a solution is off by; not less than what can be told, if that is more than rounding.
    pub fn errors_of(&self, found: &Solution, scale: &Scale) -> Errors {
        let errors = Errors::between(found, &self.solution, scale);
        let told = |error: f64, doubt: f64| match doubt > ROUNDING {
            true => error.max(doubt),
            false => error,
        };
        let both = |error: Option<f64>, doubt: Option<f64>| {
            error.map(|error| told(error, doubt.unwrap_or(0.0)))
        };
        Errors {
            end: told(errors.end, self.doubt.end),
            impact_time: both(errors.impact_time, self.doubt.impact_time),
            impact_velocity: both(errors.impact_velocity, self.doubt.impact_velocity),
            ..errors
        }
    }
}
