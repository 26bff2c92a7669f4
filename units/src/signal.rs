//! A continuous input as a unit keeps it.

use serde::{Deserialize, Serialize};
use softstop_fmi::Derivatives;

/// A polynomial in time: its derivatives at a time in s.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Signal {
    pub derivatives: Derivatives,
    since: f64,
}

impl Signal {
    pub fn new(derivatives: Derivatives, since: f64) -> Self {
        Self { derivatives, since }
    }

    /// Its derivative of an order (0: its value) at a time in s.
    pub fn at(&self, time: f64, order: usize) -> f64 {
        let terms = self.derivatives[order..].iter().enumerate().rev();
        terms.fold(0.0, |sum, (k, derivative)| {
            derivative + sum * ((time - self.since) / (k + 1) as f64)
        })
    }
}
