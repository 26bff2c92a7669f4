//! Whether two numbers, or two vectors, are as near as they should be.

use std::fmt::Debug;

use approx::{AbsDiffEq, RelativeEq};

/// True if two values differ by a tolerance at most.
pub fn is_near<T: AbsDiffEq<Epsilon = f64>>(found: T, expected: T, tolerance: f64) -> bool {
    found.abs_diff_eq(&expected, tolerance)
}

/// Asserts that two values differ by a tolerance at most.
///
/// # Panics
/// If they do not.
#[track_caller]
pub fn assert_near<T>(found: T, expected: T, tolerance: f64)
where
    T: AbsDiffEq<Epsilon = f64> + Debug,
{
    let is_near = found.abs_diff_eq(&expected, tolerance);
    assert!(is_near, "{found:?}, not {expected:?} within {tolerance:e}");
}

/// Asserts that two values differ by a share of the larger one at most.
///
/// # Panics
/// If they do not.
#[track_caller]
pub fn assert_relative<T>(found: T, expected: T, share: f64)
where
    T: RelativeEq<Epsilon = f64> + Debug,
{
    let is_near = found.relative_eq(&expected, 0.0, share);
    assert!(
        is_near,
        "{found:?}, not {expected:?} within a share of {share:e}"
    );
}
