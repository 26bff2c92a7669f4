//! A continuous input: a polynomial in time.

use serde::{Deserialize, Serialize};

/// Highest order of a time derivative that a continuous input can have.
pub const HIGHEST_ORDER: usize = 7;

/// Derivatives of an input at one time, of order 0 (the value itself) to [`HIGHEST_ORDER`].
pub type Derivatives = [f64; HIGHEST_ORDER + 1];

/// Share of a value by which interpolating between two equal ones may miss it.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// A continuous input: its derivatives p_k at a time, from which it goes on as sum of p_k t^k / k!.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Signal {
    pub(crate) derivatives: Derivatives,
    /// The time in s at which it has these derivatives.
    pub(crate) since: f64,
    /// It has not reached the unit yet.
    pub(crate) pending: bool,
}

impl Signal {
    /// An input that is new to the unit, whose inputs are all zero at first.
    pub(crate) fn new(derivatives: Derivatives, since: f64) -> Self {
        Self {
            derivatives,
            since,
            pending: derivatives != Derivatives::default(),
        }
    }

    /// Whether a value is that of this constant input but for the rounding of who interpolates it.
    pub(crate) fn is_same_value(&self, value: f64) -> bool {
        let own = self.derivatives[0];
        (value - own).abs() <= ROUNDING * own.abs()
    }

    /// Its value at `time` in s.
    pub(crate) fn at(&self, time: f64) -> f64 {
        expanded(&self.derivatives, time - self.since)
    }

    /// Its derivatives at `time` in s, each summed anew, so that only their own rounding is added.
    pub(crate) fn seen_from(&self, time: f64) -> Derivatives {
        std::array::from_fn(|order| expanded(&self.derivatives[order..], time - self.since))
    }
}

/// Sum of derivatives[k] t^k / k!.
fn expanded(derivatives: &[f64], t: f64) -> f64 {
    let terms = derivatives.iter().enumerate().rev();
    terms.fold(0.0, |sum, (k, derivative)| {
        derivative + sum * (t / (k + 1) as f64)
    })
}
