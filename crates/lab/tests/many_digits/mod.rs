//! Reference motions of piecewise linear machines in 48 digits and more, for the charts that measure errors.
//!
//! Nothing of the core's flows, events or lowering is used. A scene becomes layers of positions with their laws
//! (`machine`); every arc is the Taylor series of its equation of motion (`arc`); the first root of each
//! guard is isolated by bounds of its derivatives over the whole arc and polished by Newton's method to all
//! digits (`root`); what happens there is decided by Filippov's rules (`rest`, `course`). A motion is computed twice,
//! with 160 and with 224 binary digits and the series cut accordingly; the second is the answer, and
//! the difference says how far to trust the first, chaos included.

mod arc;
mod course;
mod machine;
pub mod number;
mod rest;
mod root;
pub mod walk;

use softstop::{Impact, MotionError};
use softstop_lab::methods::Task;
use softstop_lab::reference::Doubt;
use thiserror::Error;

use number::{Digits, Real, float, size};
use walk::Walk;

/// Binary digits of the two runs: 48 and 67 decimal ones.
const RUNS: [Digits; 2] = [Digits(160), Digits(224)];

/// A motion, rounded from many digits, and its crossings.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// Position in m and velocity in m/s at the end.
    pub end: (f64, f64),
    /// The impacts in order of time, the summable ones of a rigid stop included: the clearance is passed onwards,
    /// or the rigid stop at it is hit.
    pub impacts: Vec<Impact>,
    /// Surfaces passed, rebounds, reversals, switches.
    pub crossings: u64,
    /// How far the two runs are apart.
    pub doubt: Doubt,
}

impl Reference {
    /// What is stored of it.
    pub fn rounded(self) -> softstop_lab::reference::Reference {
        softstop_lab::reference::Reference {
            end: self.end,
            impacts: self.impacts,
            doubt: self.doubt,
        }
    }
}

/// Why there is no reference.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ReferenceError {
    /// The task makes no sense.
    #[error(transparent)]
    Task(#[from] MotionError),
    /// A power law is not analytic at the face of its stop, which needs arcs of another kind.
    #[error(
        "no reference for a Hertz stop with exponent = {exponent} and dissipation = {dissipation} s/m: only the linear \
         one, exponent = 1 and dissipation = 0, has one"
    )]
    PowerLaw {
        /// Its exponent.
        exponent: f64,
        /// Hunt and Crossley's factor in s/m.
        dissipation: f64,
    },
    /// Too much to do.
    #[error("no reference: {steps} Taylor steps and {crossings} crossings cover only {time} s")]
    Endless {
        /// Time in s that was reached.
        time: f64,
        /// Steps made.
        steps: u64,
        /// Crossings passed.
        crossings: u64,
    },
    /// An event at which the rules do not say how to go on.
    #[error("no reference: at t = {time} s an event cannot be decided in {digits} binary digits")]
    Undecided {
        /// Time in s.
        time: f64,
        /// Binary digits.
        digits: usize,
    },
    /// The digits do not do.
    #[error("no reference: {0} and {1} impacts in 48 and in 67 digits; take fewer periods", .impacts.0, .impacts.1)]
    Apart {
        /// Impacts of the two runs.
        impacts: (usize, usize),
    },
    /// The caller asked it to end.
    #[error("interrupted")]
    Interrupted,
}

/// Computes a reference. `go_on` is told the share of the work that is done, in [0, 1], and ends it by `false`.
///
/// # Errors
/// [`ReferenceError`] if the task is invalid, takes too long or was interrupted.
pub fn solve(task: &Task, go_on: &dyn Fn(f64) -> bool) -> Result<Reference, ReferenceError> {
    task.scene.motion(task.start)?;
    let run = |index: usize| {
        let watch = |share: f64| go_on(0.5 * (index as f64 + share));
        Walk::new(task, RUNS[index])?.run(&watch)
    };
    let (check, best) = (run(0)?, run(1)?);
    if check.impacts.len() != best.impacts.len() {
        let impacts = (check.impacts.len(), best.impacts.len());
        return Err(ReferenceError::Apart { impacts });
    }
    let impact = |(time, velocity): &(Real, Real)| Impact {
        time: float(time),
        velocity: float(velocity),
    };
    Ok(Reference {
        end: (float(&best.state.position), float(&best.state.velocity)),
        impacts: best.impacts.iter().map(impact).collect(),
        crossings: best.crossings,
        doubt: doubt(&check, &best),
    })
}

fn doubt(check: &Walk, best: &Walk) -> Doubt {
    let apart = |a: &Real, b: &Real| float(&size(&(a - b)));
    let position = apart(&check.state.position, &best.state.position);
    let pairs = || check.impacts.iter().zip(&best.impacts);
    Doubt {
        end: position.max(apart(&check.state.velocity, &best.state.velocity)),
        time: pairs().map(|(a, b)| apart(&a.0, &b.0)).fold(0.0, f64::max),
        velocity: pairs().map(|(a, b)| apart(&a.1, &b.1)).fold(0.0, f64::max),
    }
}
