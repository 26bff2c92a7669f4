//! Ways to compute a motion, all behind one trait: the exact one and those it is measured against.
//!
//! Everything outside this module asks the exact method alone; the others are here to chart speed
//! against accuracy and to show where they fail.

mod exact;
mod fixed;
mod ignored;
mod located;
mod machine;
mod moreau;
mod rise;
mod scheme;
mod stability;
mod step;
mod verdict;

pub use exact::Exact;
pub use fixed::{Events, FixedStep};
pub(crate) use machine::in_range;
pub use moreau::Moreau;
pub use rise::{Probe, locate_rise};
pub use scheme::Scheme;
pub use verdict::{Judge, Verdict};

use thiserror::Error;

use softstop::MotionError;
pub use softstop::internals::Evaluations as Work;
use softstop::{Impact, Instant, Scene, Start};

/// A motion to be computed, from time 0 on.
#[derive(Debug, Clone, PartialEq)]
pub struct Task {
    /// The machine.
    pub scene: Scene,
    /// State at time 0.
    pub start: Start,
    /// Drive periods to cover, >= 0.
    pub periods: f64,
    /// Steps after which a method gives up.
    pub most_steps: u64,
}

impl Task {
    /// A motion from time 0 over drive periods, after so many steps at most.
    pub const fn new(scene: Scene, start: Start, periods: f64, most_steps: u64) -> Self {
        Self {
            scene,
            start,
            periods,
            most_steps,
        }
    }

    /// Time to cover, in s.
    pub fn duration(&self) -> f64 {
        self.periods * self.scene.period()
    }

    /// When it ends: whole periods and the rest of them.
    pub fn end(&self) -> Instant {
        let cycles = self.periods.floor();
        let offset = (self.periods - cycles) * self.scene.period();
        Instant { cycles, offset }
    }

    /// The same, of a task that makes sense.
    pub(crate) fn until(&self) -> Result<f64, MethodError> {
        let (until, present) = (self.duration(), 0.0);
        if until >= 0.0 && until.is_finite() {
            return Ok(until);
        }
        Err(MotionError::TimeBackwards { until, present }.into())
    }
}

/// What a method found.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Solution {
    /// Position in m and velocity in m/s at the end.
    pub end: (f64, f64),
    /// The impacts in order of time: the clearance is passed onwards, or the rigid stop at it is hit.
    pub impacts: Vec<Impact>,
    /// What it took.
    pub work: Work,
}

/// Why a method has no answer.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MethodError {
    /// It is not made for this machine.
    #[error("{method} cannot do this: {reason}")]
    Unsuited {
        /// The method.
        method: String,
        /// What it cannot do.
        reason: String,
    },
    /// The numbers left all bounds.
    #[error("blown up near t = {time} s")]
    BlownUp {
        /// Time in s up to which they were finite.
        time: f64,
    },
    /// It does not get on.
    #[error("stuck at t = {time} s after {steps} steps: {reason}")]
    Stuck {
        /// Time in s that it reached.
        time: f64,
        /// Steps it had made.
        steps: u64,
        /// What holds it up.
        reason: String,
    },
    /// The task makes no sense.
    #[error(transparent)]
    Task(MotionError),
}

impl From<MotionError> for MethodError {
    fn from(error: MotionError) -> Self {
        match error {
            MotionError::Unbounded { time, .. } => Self::BlownUp { time },
            MotionError::Stalled { time, .. } => Self::stuck(time, 0, error.to_string()),
            other => Self::Task(other),
        }
    }
}

impl MethodError {
    /// It does not get on from this time, after so many steps.
    pub(crate) fn stuck(time: f64, steps: u64, reason: impl Into<String>) -> Self {
        let reason = reason.into();
        Self::Stuck {
            time,
            steps,
            reason,
        }
    }

    /// The same, said by a method that had made so many steps.
    pub fn after(self, steps: u64) -> Self {
        match self {
            Self::Stuck { time, reason, .. } => Self::stuck(time, steps, reason),
            other => other,
        }
    }
}

/// A way to compute motions, with all its settings. To add one, implement the two methods: `integrate` asks the phases of
/// the checked scene for the laws, ends at the task's duration exactly, and counts its work honestly.
pub trait Integrator: Sync {
    /// What it is, with its settings, for a table or a legend.
    fn name(&self) -> String;

    /// The motion of a task.
    fn integrate(&self, task: &Task) -> Result<Solution, MethodError>;
}
