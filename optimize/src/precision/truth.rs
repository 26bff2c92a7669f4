//! The motion that all are measured against.

use anyhow::Context;
use softstop::methods::{Exact, Integrator, Solution, Task};

use crate::failure::Failure;

/// The true motion as far as it is known.
#[derive(Debug, Clone)]
pub struct Truth {
    /// End and impacts, rounded to doubles.
    pub solution: Solution,
    /// How it was found.
    pub method: String,
}

impl Truth {
    /// The true motion of a task.
    ///
    /// # Errors
    /// [`Failure::Run`] if it cannot be found.
    pub fn of(task: &Task) -> Result<Self, Failure> {
        let solution = Exact.integrate(task).context("there is no reference")?;
        Ok(Self {
            solution,
            method: Exact.name(),
        })
    }
}
