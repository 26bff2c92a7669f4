//! Sweeps: a parameter goes up or down in steps, and the motion goes on through all of them.
//!
//! The rule: each value of the parameter holds for a whole number of drive periods. The state at the end of a
//! step, at drive angle phi, is the start of the next one. So position, velocity and drive angle are continuous;
//! the parameter alone jumps, each time at drive angle phi. Where that puts a rigid stop before the mass, or the sweep
//! would start beyond one, the step begins at rest on the stop. A sweep loses a motion later than the motion itself
//! ends, by so much the more as it goes faster: where it does is told with the rate ([`Plan::sweep_rate`]).
//!
//! Many sweeps, of several machines and both directions, go side by side in the lanes of the batch engine.
//! What comes out depends on plan and chains alone, not on the number of threads, nor on whether the sweep was
//! interrupted and taken up again.
//!
//! ```
//! use softstop::{Parameter, Ratios};
//! use softstop_dynamics::sweep::{Chain, Direction, Plan, find_coexistences};
//! use softstop_dynamics::monitor::unmonitored;
//!
//! let machine = Ratios::unloaded().scene()?;
//! let plan = Plan::new(Parameter::Frequency, (1.01, 1.4), 40, 200)?;
//! let mut chains = [Direction::Up, Direction::Down].map(|way| Chain::new(machine.clone(), way));
//! plan.run_chains(&mut chains, &unmonitored);
//! let zones = find_coexistences(&chains[0], &chains[1]);
//! // Between g0 = 1.04444 and s_SN = 1.369036 the way matters.
//! assert_eq!(zones.len(), 1);
//! assert!((zones[0].from - 1.05).abs() < 1e-9 && (zones[0].to - 1.36).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod chain;
mod coexistence;
mod run_chains;
mod sweep_step;

pub use chain::{Chain, Jump};
pub use coexistence::{Coexistence, find_coexistences};
pub use sweep_step::SweepStep;

use thiserror::Error;

pub use crate::direction::Direction;
use crate::orbit::recurrence::RECURRENCE_DISTANCE;
use softstop::{Parameter, Start};

/// The plan of a sweep: which parameter takes which values, and for how long each.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plan {
    /// The parameter that is swept.
    pub parameter: Parameter,
    /// Its least and largest value.
    pub range: (f64, f64),
    /// Number of values, evenly spaced, both ends included; at least 2.
    pub steps: usize,
    /// Drive periods for each value; at least 1.
    pub periods: u64,
    /// Distance within which a state has returned, in units of the motion's size. Where each step is too short to settle, it has
    /// to be larger than what a step changes.
    pub tolerance: f64,
    /// Whether the largest position of each step is asked for: it takes the safe engine.
    pub heights: bool,
    /// State before the first step.
    pub start: Start,
}

/// Why a sweep cannot be made as planned.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The range is empty or not finite.
    #[error("range = {from} to {to}: must be finite, and rising")]
    Range {
        /// Its beginning.
        from: f64,
        /// Its end.
        to: f64,
    },
    /// Too few values.
    #[error("steps = {0}: must be >= 2")]
    Steps(usize),
    /// No time.
    #[error("periods = {0}: must be >= 1")]
    Periods(u64),
}

impl Plan {
    /// Most sweeps whose motions are advanced together, as many as there are lanes at most. Lanes that go together round
    /// together, so the groups do not depend on how many threads there are.
    pub const MAX_CHAINS_TOGETHER: usize = 16;

    /// A plan of a sweep that starts from rest at the origin.
    ///
    /// # Errors
    /// [`PlanError`] if it cannot be.
    pub fn new(
        parameter: Parameter,
        range: (f64, f64),
        steps: usize,
        periods: u64,
    ) -> Result<Self, PlanError> {
        let (from, to) = range;
        if !(from.is_finite() && to.is_finite() && from < to) {
            return Err(PlanError::Range { from, to });
        }
        if steps < 2 {
            return Err(PlanError::Steps(steps));
        }
        if periods == 0 {
            return Err(PlanError::Periods(periods));
        }
        Ok(Self {
            parameter,
            range,
            steps,
            periods,
            tolerance: RECURRENCE_DISTANCE,
            heights: true,
            start: Start::REST,
        })
    }

    /// The parameter's value at a step of the sweep, counted from 0 in its direction.
    pub fn value_at(&self, step: usize, direction: Direction) -> f64 {
        let last = self.steps - 1;
        let place = match direction {
            Direction::Up => step,
            Direction::Down => last - step,
        };
        let share = place as f64 / last as f64;
        self.range.0 + share * (self.range.1 - self.range.0)
    }

    /// Mean change of the parameter per drive period of the sweep.
    pub fn sweep_rate(&self) -> f64 {
        (self.range.1 - self.range.0) / (self.steps - 1) as f64 / self.periods as f64
    }

    /// Number of last drive periods of a step in which its motion is watched: half of the step, but 16 to 128 if it has them.
    pub fn watched_periods(&self) -> u64 {
        (self.periods / 2).clamp(16.min(self.periods), 128)
    }
}
