//! The external force as a motion carries it on from arc to arc.

use serde::{Deserialize, Serialize};

use super::clock::{Clock, Instant};
use crate::error::MotionError;
use crate::flow::{HIGHEST_ORDER, Polynomial};

/// A force in N from the instant on at which it was set.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Force {
    set: Polynomial,
    since: Instant,
    on_arc: Polynomial,
}

impl Force {
    /// The force from `since` on, where an arc begins.
    pub fn new(set: Polynomial, since: Instant) -> Self {
        Self {
            set,
            since,
            on_arc: set,
        }
    }

    /// The force as seen from the start of the present arc.
    #[inline]
    pub fn on_arc(&self) -> &Polynomial {
        &self.on_arc
    }

    /// The force as seen from `at`, which is `elapsed` seconds into the present arc. One of degree 2 or higher is
    /// always taken from where it was set, so that no rounding adds up over the arcs.
    pub fn seen_from(&self, clock: &Clock, at: Instant, elapsed: f64) -> Polynomial {
        if self.set.is_linear() {
            self.on_arc.shifted(elapsed)
        } else {
            self.set.shifted(clock.elapsed(self.since, at))
        }
    }

    /// Ends the present arc `elapsed` seconds after its start; the next one begins at `at`.
    pub fn next_arc(&mut self, clock: &Clock, at: Instant, elapsed: f64) {
        self.on_arc = self.seen_from(clock, at, elapsed);
    }
}

/// The force with these derivatives at its beginning, of order 0 on.
pub(crate) fn force_from_derivatives(derivatives: &[f64]) -> Result<Polynomial, MotionError> {
    let mut force = Polynomial::default();
    for (order, &value) in derivatives.iter().enumerate() {
        if !value.is_finite() {
            return Err(MotionError::ForceNotFinite { order, value });
        }
        if order <= HIGHEST_ORDER {
            force = force.with_derivative(order, value);
        } else if value != 0.0 {
            let highest = HIGHEST_ORDER;
            return Err(MotionError::ForceOrder {
                order,
                value,
                highest,
            });
        }
    }
    Ok(force)
}
