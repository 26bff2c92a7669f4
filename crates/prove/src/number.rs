//! Intervals, and numbers with exact derivatives (forward differentiation), which may be nested.

use std::ops::{Add, Mul, Neg, Sub};

use crate::elementary::even_series;
use crate::interval::Interval;

/// What the equations of a motion are written in.
pub trait Number:
    Clone
    + From<Interval>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
{
    /// 1/x.
    fn reciprocal(&self) -> Self;
    /// Sine and cosine.
    fn sin_cos(&self) -> (Self, Self);
    /// u and s of a free motion at this time: see [`Decay`].
    fn decay(&self, decay: &Decay) -> (Self, Self);
    /// A double.
    fn constant(value: f64) -> Self {
        Self::from(Interval::point(value))
    }
    /// A multiple of this number.
    fn times(&self, factor: impl Into<Interval>) -> Self {
        self.clone() * Self::from(factor.into())
    }
}

/// The free motion x = u x0 + s (a x0 + v0) of x'' + 2 a x' + b x = 0: u = exp(-a t) cos(w t) and s = exp(-a t) sin(w t)/w with
/// w^2 = b - a^2 of either sign, or zero. u' = -a u - w^2 s, s' = u - a s.
#[derive(Debug, Clone, Copy)]
pub struct Decay {
    /// a, in 1/s.
    pub rate: Interval,
    /// b, in 1/s^2.
    pub stiffness: Interval,
}

impl Decay {
    /// b - a^2.
    fn square_frequency(&self) -> Interval {
        self.stiffness - self.rate.square()
    }

    /// u and s.
    fn at(&self, time: Interval) -> (Interval, Interval) {
        let square = self.square_frequency();
        let z = square * time.square();
        let decay = || (-(self.rate * time)).exp();
        if z.magnitude() <= 1.0 {
            let (cosine, ratio) = even_series(z);
            let decay = decay();
            return (decay * cosine, decay * time * ratio);
        }
        if square.is_positive() {
            let frequency = square.sqrt();
            let (sine, cosine) = (frequency * time).sin_cos();
            let decay = decay();
            return (decay * cosine, decay * sine / frequency);
        }
        if square.is_negative() {
            // Both exponents without cancellation: their product is b.
            let root = (-square).sqrt();
            let fast = self.rate + root;
            let slow = self.stiffness / fast;
            let (slow, fast) = ((-(slow * time)).exp(), (-(fast * time)).exp());
            let half = Interval::point(0.5);
            return (half * (slow + fast), half * (slow - fast) / root);
        }
        (Interval::WHOLE, Interval::WHOLE)
    }

    /// The derivatives of both by the time.
    fn slope<T: Number>(&self, (u, s): &(T, T)) -> (T, T) {
        (
            -(u.times(self.rate) + s.times(self.square_frequency())),
            u.clone() - s.times(self.rate),
        )
    }
}

impl Number for Interval {
    fn reciprocal(&self) -> Self {
        Self::ONE / *self
    }

    fn sin_cos(&self) -> (Self, Self) {
        Interval::sin_cos(*self)
    }

    fn decay(&self, decay: &Decay) -> (Self, Self) {
        decay.at(*self)
    }
}

/// A number with some derivatives; a constant has none.
#[derive(Debug, Clone)]
pub struct Dual<T> {
    /// The number.
    pub value: T,
    /// Its derivatives; those that are missing are zero.
    pub slopes: Vec<T>,
}

/// A number with its derivatives by all unknowns.
pub type Gradient = Dual<Interval>;

impl<T: Number> Dual<T> {
    /// A derivative.
    pub fn slope(&self, index: usize) -> T {
        let zero = || Interval::ZERO.into();
        self.slopes.get(index).cloned().unwrap_or_else(zero)
    }

    /// A function of this number with a value and a derivative.
    fn chain(&self, value: T, slope: T) -> Self {
        let slopes = self.slopes.iter().map(|it| it.clone() * slope.clone());
        Self {
            slopes: slopes.collect(),
            value,
        }
    }
}

impl Gradient {
    /// The unknown of this index among `count`.
    pub fn unknown(value: Interval, index: usize, count: usize) -> Self {
        let mut slopes = vec![Interval::ZERO; count];
        slopes[index] = Interval::ONE;
        Self { value, slopes }
    }
}

impl<T: Number> From<Interval> for Dual<T> {
    fn from(value: Interval) -> Self {
        Self {
            value: value.into(),
            slopes: Vec::new(),
        }
    }
}

impl<T: Number> Add for Dual<T> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let count = self.slopes.len().max(other.slopes.len());
        let slopes = (0..count).map(|it| self.slope(it) + other.slope(it));
        Self {
            slopes: slopes.collect(),
            value: self.value + other.value,
        }
    }
}

impl<T: Number> Neg for Dual<T> {
    type Output = Self;

    fn neg(self) -> Self {
        self.chain(-self.value.clone(), (-Interval::ONE).into())
    }
}

impl<T: Number> Sub for Dual<T> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<T: Number> Mul for Dual<T> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let value = self.value.clone() * other.value.clone();
        let sum = self.chain(value.clone(), other.value.clone())
            + other.chain(value.clone(), self.value.clone());
        Self { value, ..sum }
    }
}

impl<T: Number> Number for Dual<T> {
    fn reciprocal(&self) -> Self {
        let value = self.value.reciprocal();
        self.chain(value.clone(), -(value.clone() * value))
    }

    fn sin_cos(&self) -> (Self, Self) {
        let (sine, cosine) = self.value.sin_cos();
        (
            self.chain(sine.clone(), cosine.clone()),
            self.chain(cosine, -sine),
        )
    }

    fn decay(&self, decay: &Decay) -> (Self, Self) {
        let pair = self.value.decay(decay);
        let (u, s) = decay.slope(&pair);
        (self.chain(pair.0, u), self.chain(pair.1, s))
    }
}
