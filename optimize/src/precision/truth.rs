//! The motion that all are measured against.

use softstop::methods::{Solution, Task, Work};

use super::errors::Scale;
use crate::failure::Failure;
use crate::interrupt;
use crate::reference::{self, Doubt, ReferenceError};
use crate::simulate;

/// How it is found.
pub const METHOD: &str = "Taylor series in 67 decimal digits, checked in 48";

/// The true motion.
#[derive(Debug, Clone)]
pub struct Truth {
    /// End and impacts, rounded to doubles.
    pub solution: Solution,
    /// How far two computations with different numbers of digits are apart.
    pub doubt: Doubt,
}

impl Truth {
    /// The true motion of a task; `progress` hears which share of the work is done.
    ///
    /// # Errors
    /// [`Failure::Run`] if it cannot be found, [`Failure::Interrupted`] after Ctrl-C.
    pub fn of(task: &Task, progress: &dyn Fn(f64)) -> Result<Self, Failure> {
        let go_on = |share| {
            progress(share);
            !interrupt::requested()
        };
        let reference = reference::solve(task, &go_on).map_err(|error| match error {
            ReferenceError::Interrupted => Failure::Interrupted,
            ReferenceError::Task(error) => simulate::failure(error),
            error => Failure::Run(error.into()),
        })?;
        Ok(Self {
            solution: Solution {
                end: reference.end,
                impacts: reference.impacts,
                work: Work::default(),
            },
            doubt: reference.doubt,
        })
    }

    /// Decimal digits, relative to the motion's size, in which both computations agree; 48 at most.
    #[must_use]
    pub fn digits(&self, scale: &Scale) -> u32 {
        let Doubt {
            end,
            time,
            velocity,
        } = self.doubt;
        let end = end / scale.position.min(scale.velocity);
        let doubt = end.max(time / scale.period).max(velocity / scale.velocity);
        (-doubt.log10()).clamp(0.0, 48.0) as u32
    }
}
