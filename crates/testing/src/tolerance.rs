//! How far apart two numbers of order one may be, and why: one word for each reason.

/// Two ways of a few operations to the same number: some tens of roundings.
pub const ROUNDING: f64 = 1e-14;

/// The same motion in two ways, or against a reference: the roundings of some periods, which an impact may
/// magnify a hundredfold.
pub const MOTION: f64 = 1e-12;

/// A root that Newton's method or a bracket has found: the rounding of its function over its slope.
pub const SOLVED: f64 = 1e-10;

/// What motions make of a tolerance of [`MOTION`] that grow by a factor of ten thousand.
pub const GROWN: f64 = 1e-8;

/// Central differences over 1e-6: [`MOTION`] over that width.
pub const DIFFERENCED: f64 = 1e-6;

/// A number that is known to so many decimals: half a unit in the last one.
pub fn printed(decimals: i32) -> f64 {
    0.5 * 10f64.powi(-decimals)
}
