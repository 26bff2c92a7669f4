//! What a crate's solver is given and gives back: one leg, followed until a guard ends it.

use super::leg::State;

/// Where a leg begins and how far it may go.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    /// Time in s at which it begins.
    pub from: f64,
    /// The state there.
    pub state: State,
    /// Time in s at which the motion ends.
    pub until: f64,
    /// Steps that are left.
    pub most_steps: u64,
}

/// Where a leg ended.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reached {
    /// Time in s.
    pub time: f64,
    /// The state then.
    pub state: State,
    /// The guard that ended it; none at the end of the span.
    pub guard: Option<usize>,
    /// Accepted steps.
    pub steps: u64,
}

/// Why a solver stopped before.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Halt {
    /// Time in s that it reached.
    pub time: f64,
    /// Accepted steps up to there.
    pub steps: u64,
    /// In the solver's own words, if they are its own.
    pub reason: String,
    /// True if its numbers left all bounds.
    pub blown_up: bool,
}

impl Halt {
    /// A halt at a time after so many steps, its numbers within bounds.
    pub fn new(time: f64, steps: u64, reason: impl Into<String>) -> Self {
        Self {
            time,
            steps,
            reason: reason.into(),
            blown_up: false,
        }
    }

    /// The steps are used up.
    pub fn out_of_steps(time: f64, steps: u64) -> Self {
        Self::new(time, steps, "the steps allowed are used up")
    }
}

/// Largest number that counts as bounded.
const BOUND: f64 = 1e100;

/// Refuses a state that has left all bounds.
pub(super) fn bounded(time: f64, steps: u64, state: State) -> Result<(), Halt> {
    if state.iter().all(|value| value.abs() <= BOUND) {
        return Ok(());
    }
    Err(Halt {
        blown_up: true,
        ..Halt::new(time, steps, "the numbers left all bounds")
    })
}
