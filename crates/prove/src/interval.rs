//! Closed intervals of doubles with outward rounding.
//!
//! Each operation returns an interval that holds every real result of operands taken from its arguments. Rounding is
//! directed by the sign of the rounding error, which an error-free transformation gives exactly (Knuth's two-sum; a fused
//! multiply-add for products, quotients and roots): a bound is moved by one double if, and only if, it was rounded inwards.
//! Where the error may underflow it is moved anyway, and what is not finite becomes the whole line.

use std::ops::{Add, Div, Mul, Neg, Sub};

use serde::{Serialize, Serializer};

/// The interval [low, high]: never empty, never NaN. Serialized as the pair of its bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    low: f64,
    high: f64,
}

/// Size below which the error of a product may underflow.
const SMALL: f64 = 1e-280;

/// A rounded result as bounds: `error` has the sign of the exact result minus the rounded one.
fn bounds(rounded: f64, error: f64) -> (f64, f64) {
    if !rounded.is_finite() || !error.is_finite() {
        return (f64::NEG_INFINITY, f64::INFINITY);
    }
    let low = if error < 0.0 {
        rounded.next_down()
    } else {
        rounded
    };
    let high = if error > 0.0 {
        rounded.next_up()
    } else {
        rounded
    };
    (low, high)
}

/// Bounds of a result whose rounding error may have underflowed.
fn wide(rounded: f64) -> (f64, f64) {
    (rounded.next_down(), rounded.next_up())
}

fn sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let part = s - a;
    bounds(s, (a - (s - part)) + (b - part))
}

fn product(a: f64, b: f64) -> (f64, f64) {
    if a == 0.0 || b == 0.0 {
        return (0.0, 0.0);
    }
    let p = a * b;
    if p.abs() < SMALL {
        return wide(p);
    }
    bounds(p, a.mul_add(b, -p))
}

fn quotient(a: f64, b: f64) -> (f64, f64) {
    if a == 0.0 {
        return (0.0, 0.0);
    }
    let q = a / b;
    if q.abs() < SMALL || a.abs() < SMALL {
        return wide(q);
    }
    bounds(q, (-q).mul_add(b, a) * b.signum())
}

/// The hull of the bounds of several results.
fn hull(results: &[(f64, f64)]) -> Interval {
    let low = results.iter().fold(f64::INFINITY, |low, it| low.min(it.0));
    let high = results
        .iter()
        .fold(f64::NEG_INFINITY, |high, it| high.max(it.1));
    Interval { low, high }
}

impl Interval {
    /// The number 0.
    pub const ZERO: Self = Self::point(0.0);
    /// The number 1.
    pub const ONE: Self = Self::point(1.0);
    /// All real numbers.
    pub const WHOLE: Self = Self {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    };

    /// One double; the whole line if it is not finite.
    pub const fn point(value: f64) -> Self {
        if !value.is_finite() {
            return Self::WHOLE;
        }
        Self {
            low: value,
            high: value,
        }
    }

    /// From `low` to `high`; the whole line if no number lies between them.
    pub fn new(low: f64, high: f64) -> Self {
        if low <= high && low < f64::INFINITY && high > f64::NEG_INFINITY {
            Self { low, high }
        } else {
            Self::WHOLE
        }
    }

    /// All numbers at most `radius` from `center`.
    pub fn around(center: f64, radius: f64) -> Self {
        Self::point(center) + Self::new(-radius, radius)
    }

    /// Its lower bound.
    pub fn low(self) -> f64 {
        self.low
    }

    /// Its upper bound.
    pub fn high(self) -> f64 {
        self.high
    }

    /// A double inside, near the middle, of an interval with bounds.
    pub fn middle(self) -> f64 {
        (0.5 * self.low + 0.5 * self.high).clamp(self.low, self.high)
    }

    /// Its width, rounded upwards.
    pub fn width(self) -> f64 {
        sum(self.high, -self.low).1
    }

    /// The largest absolute value in it.
    pub fn magnitude(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// True if all of it is above zero.
    pub fn is_positive(self) -> bool {
        self.low > 0.0
    }

    /// True if all of it is below zero.
    pub fn is_negative(self) -> bool {
        self.high < 0.0
    }

    /// True if both bounds are finite.
    pub fn is_bounded(self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }

    /// True if it holds a number.
    pub fn contains(self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }

    /// True if it lies in the interior of another one.
    pub fn is_inside(self, other: Self) -> bool {
        other.low < self.low && self.high < other.high
    }

    /// The numbers in both; none if there are none.
    pub fn intersection(self, other: Self) -> Option<Self> {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        (low <= high).then_some(Self { low, high })
    }

    /// The smallest interval that holds both.
    pub fn hull(self, other: Self) -> Self {
        hull(&[(self.low, self.high), (other.low, other.high)])
    }

    /// Its square.
    pub fn square(self) -> Self {
        let square = self * self;
        Self {
            low: square.low.max(0.0),
            ..square
        }
    }

    /// Its square root; the whole line if it holds negative numbers.
    pub fn sqrt(self) -> Self {
        let root = |x: f64| {
            let s = x.sqrt();
            if x == 0.0 {
                (0.0, 0.0)
            } else if x < SMALL {
                wide(s)
            } else {
                bounds(s, (-s).mul_add(s, x))
            }
        };
        if self.low < 0.0 {
            return Self::WHOLE;
        }
        hull(&[root(self.low), root(self.high)])
    }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (low, high) = (sum(self.low, other.low).0, sum(self.high, other.high).1);
        Self { low, high }
    }
}

impl Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Self {
            low: -self.high,
            high: -self.low,
        }
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        if self == Self::ZERO || other == Self::ZERO {
            return Self::ZERO;
        }
        hull(&[
            product(self.low, other.low),
            product(self.low, other.high),
            product(self.high, other.low),
            product(self.high, other.high),
        ])
    }
}

impl Div for Interval {
    type Output = Self;

    /// The whole line if the divisor holds zero.
    fn div(self, other: Self) -> Self {
        if other.contains(0.0) {
            return Self::WHOLE;
        }
        hull(&[
            quotient(self.low, other.low),
            quotient(self.low, other.high),
            quotient(self.high, other.low),
            quotient(self.high, other.high),
        ])
    }
}

impl From<f64> for Interval {
    fn from(value: f64) -> Self {
        Self::point(value)
    }
}

impl Serialize for Interval {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        [self.low, self.high].serialize(serializer)
    }
}
