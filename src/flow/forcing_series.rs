//! A polynomial force as series in regularised time sigma.

use super::Polynomial;
use super::polynomial::HIGHEST_ORDER;
use super::series::{ReversedSeries, Series, ZERO};

/// The part of a force beyond its ramp, and its derivatives, as series in sigma: from one order to the next,
/// d p^(j) / dsigma = p^(j+1) dt/dsigma.
pub(super) struct ForcingSeries([Series; HIGHEST_ORDER + 1]);

impl ForcingSeries {
    /// None if there is no such part.
    pub fn new(force: &Polynomial) -> Option<Self> {
        (!force.is_linear()).then(|| {
            let curved = force.with_derivative(0, 0.0).with_derivative(1, 0.0);
            Self(curved.derivatives().map(|derivative| {
                let mut series = ZERO;
                series[0] = derivative;
                series
            }))
        })
    }

    /// The k-th Taylor coefficient in sigma of the force, from those of dt/dsigma below k. Coefficients are computed in order of k.
    pub fn coefficient(&mut self, rate: &ReversedSeries, k: usize) -> f64 {
        if let Some(before) = k.checked_sub(1) {
            for j in 0..HIGHEST_ORDER {
                self.0[j][k] = rate.times(&self.0[j + 1], before) / k as f64;
            }
        }
        self.0[0][k]
    }
}
