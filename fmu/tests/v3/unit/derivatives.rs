//! Derivatives of a unit.

use std::ffi::c_int;

use softstop_fmi3::*;

use super::Unit;

/// The values that a function for derivatives gives.
macro_rules! derivatives {
    ($function:ident, $unit:ident, $of:ident, $by:ident, $seed:ident, $count:expr) => {{
        let (of, by, seed) = ($of.as_ptr(), $by.as_ptr(), $seed.as_ptr());
        let (counts, mut values) = (($of.len(), $by.len(), $seed.len()), vec![f64::NAN; $count]);
        let (instance, place) = ($unit.instance, values.as_mut_ptr());
        // SAFETY: arrays as long as is said.
        let status = unsafe {
            $function(
                instance, of, counts.0, by, counts.1, seed, counts.2, place, $count,
            )
        };
        (status, values)
    }};
}

impl Unit {
    /// Derivatives of outputs along a direction.
    pub fn directional(&self, of: &[u32], by: &[u32], seed: &[f64]) -> Vec<f64> {
        let (status, values) = self.try_directional(of, by, seed);
        self.check(status);
        values
    }

    /// Status and derivatives of outputs along a direction.
    pub fn try_directional(&self, of: &[u32], by: &[u32], seed: &[f64]) -> (c_int, Vec<f64>) {
        derivatives!(fmi3GetDirectionalDerivative, self, of, by, seed, of.len())
    }

    /// Derivatives of a weighted sum of outputs.
    pub fn adjoint(&self, of: &[u32], by: &[u32], seed: &[f64]) -> Vec<f64> {
        self.adjoint_of(of, by, seed, by.len())
    }

    /// Derivatives of a weighted sum of outputs by knowns that have so many elements.
    pub fn adjoint_of(&self, of: &[u32], by: &[u32], seed: &[f64], count: usize) -> Vec<f64> {
        let (status, values) = derivatives!(fmi3GetAdjointDerivative, self, of, by, seed, count);
        self.check(status);
        values
    }
}
