//! A force that is a polynomial in time.

use serde::{Deserialize, Serialize};

/// Highest order of a derivative that a [`Polynomial`] has.
pub const HIGHEST_ORDER: usize = 7;

/// p(t) = sum of p_k t^k / k!, given by its derivatives p_k at t = 0, of order 0 (the value itself) to [`HIGHEST_ORDER`].
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Polynomial {
    derivatives: [f64; HIGHEST_ORDER + 1],
}

impl Polynomial {
    /// The polynomial with these derivatives.
    pub const fn new(derivatives: [f64; HIGHEST_ORDER + 1]) -> Self {
        Self { derivatives }
    }

    /// The polynomial `value` + `rate` t.
    pub const fn linear(value: f64, rate: f64) -> Self {
        Self::new([value, rate, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    }

    /// The derivatives of the polynomial at t = 0, the value first.
    pub const fn derivatives(&self) -> &[f64; HIGHEST_ORDER + 1] {
        &self.derivatives
    }

    /// This polynomial with another derivative of one order, at most [`HIGHEST_ORDER`].
    pub const fn with_derivative(mut self, order: usize, derivative: f64) -> Self {
        self.derivatives[order] = derivative;
        self
    }

    /// The value of the polynomial at t = 0.
    #[inline]
    pub const fn value(&self) -> f64 {
        self.derivatives[0]
    }

    /// The first derivative of the polynomial at t = 0.
    #[inline]
    pub const fn rate(&self) -> f64 {
        self.derivatives[1]
    }

    /// True if the polynomial has no derivative of order 2 or higher.
    #[inline]
    pub fn is_linear(&self) -> bool {
        let higher = self.derivatives[2..].iter();
        !higher.fold(false, |some, derivative| some | (*derivative != 0.0))
    }

    /// The value p(t) of the polynomial.
    pub fn value_at(&self, t: f64) -> f64 {
        if self.is_linear() {
            self.value() + self.rate() * t
        } else {
            taylor_sum(&self.derivatives, t)
        }
    }

    /// This polynomial as a function of the time after t = `t`: its derivatives there, each summed anew, so that only
    /// their own rounding is added.
    pub fn shifted(&self, t: f64) -> Self {
        if self.is_linear() {
            return Self::linear(self.value_at(t), self.rate());
        }
        Self::new(std::array::from_fn(|order| {
            taylor_sum(&self.derivatives[order..], t)
        }))
    }

    /// The polynomial for one unit of `mass`, a constant `law` added to it before.
    pub(crate) fn per_mass(&self, law: f64, mass: f64) -> Self {
        let value = (self.value() + law) / mass;
        if self.is_linear() {
            return Self::linear(value, self.rate() / mass);
        }
        Self::new(self.derivatives.map(|derivative| derivative / mass)).with_derivative(0, value)
    }

    /// The polynomial -p(t).
    pub(super) fn mirrored(&self) -> Self {
        Self::new(self.derivatives.map(|derivative| -derivative))
    }

    /// A bound on the first derivative of the polynomial from 0 to `t`.
    pub(crate) fn largest_rate(&self, t: f64) -> f64 {
        taylor_sum(&self.derivatives.map(f64::abs)[1..], t)
    }

    /// True if the polynomial does not change with time.
    pub fn is_constant(&self) -> bool {
        self.is_linear() && self.rate() == 0.0
    }

    /// Coefficients p_k / k! of t^k in the polynomial.
    pub fn taylor_coefficients(&self) -> [f64; HIGHEST_ORDER + 1] {
        let mut factorial = 1.0;
        std::array::from_fn(|k| {
            if k > 1 {
                factorial *= k as f64;
            }
            self.derivatives[k] / factorial
        })
    }
}

/// The polynomial sum of d_k t^k / k!, the d_k being `derivatives`.
fn taylor_sum(derivatives: &[f64], t: f64) -> f64 {
    let terms = derivatives.iter().enumerate().rev();
    terms.fold(0.0, |sum, (k, derivative)| {
        derivative + sum * (t / (k + 1) as f64)
    })
}

#[cfg(test)]
mod tests {
    use super::Polynomial;

    const CURVE: Polynomial = Polynomial::new([1.0, -2.0, 3.0, -4.0, 5.0, -6.0, 7.0, -8.0]);

    #[test]
    fn values_are_those_of_the_written_out_sum() {
        // At t = 2, with 2^k / k! as a fraction over 315.
        let by_hand = 1.0 - 4.0 + 6.0 - 16.0 / 3.0 + 10.0 / 3.0 - 1.6 + 28.0 / 45.0 - 64.0 / 315.0;
        assert!((CURVE.value_at(2.0) - by_hand).abs() < 1e-14);
        assert_eq!(
            Polynomial::linear(0.3, -0.7).value_at(1.7),
            0.3 + -0.7 * 1.7
        );
    }

    #[test]
    fn shifts_add_up() {
        let (once, twice) = (CURVE.shifted(1.5), CURVE.shifted(0.25).shifted(1.25));
        for (a, b) in once.derivatives().iter().zip(twice.derivatives()) {
            assert!((a - b).abs() < 1e-13 * a.abs().max(1.0), "{a} {b}");
        }
        assert_eq!(CURVE.shifted(0.0), CURVE);
        assert!((once.value_at(0.5) - CURVE.value_at(2.0)).abs() < 1e-14);
    }

    #[test]
    fn the_rate_is_bounded_on_the_way() {
        for step in 0..=100 {
            let t = 0.02 * f64::from(step);
            assert!(CURVE.shifted(t).rate().abs() <= CURVE.largest_rate(2.0));
        }
        assert_eq!(Polynomial::linear(5.0, -0.5).largest_rate(3.0), 0.5);
    }
}
