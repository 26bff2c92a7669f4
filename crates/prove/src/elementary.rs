//! Sine, cosine and exponential of intervals, proven from the four operations of [`Interval`] alone: the functions of the
//! standard library promise no accuracy.
//!
//! - **Reduction.** x = k c + r with c = pi/2 or ln 2. c lies between HIGH + LOW.0 and HIGH + LOW.1, where HIGH has 32
//!   significant bits, so that k HIGH is a double for |k| < 2^20, and the bounds of LOW are neighbours. The choice of k need not
//!   be the best: r is an interval, and the series hold on the whole range for which their remainders are stated.
//! - **Series.** Taylor's, by Horner's rule in interval arithmetic. With |r| <= 1 the first omitted term of an alternating
//!   series with falling terms bounds its remainder (sine, cosine); for the exponential Lagrange's form does, e |r|^n/n!.
//! - **Wide arguments.** exp is monotone. For x = m + d, |sin x - sin m - d cos m| <= d^2/2, and so for the cosine.

use crate::interval::Interval;

/// A constant c between `high` + `low.0` and `high` + `low.1`.
struct Constant {
    high: f64,
    low: (f64, f64),
}

const HALF_PI: Constant = Constant {
    high: f64::from_bits(0x3ff9_21fb_5440_0000),
    low: (
        f64::from_bits(0x3dd0_b461_1a62_6331),
        f64::from_bits(0x3dd0_b461_1a62_6332),
    ),
};
const LN_2: Constant = Constant {
    high: f64::from_bits(0x3fe6_2e42_fee0_0000),
    low: (
        f64::from_bits(0x3dea_39ef_3579_3c76),
        f64::from_bits(0x3dea_39ef_3579_3c77),
    ),
};
/// Multiples of a constant up to which they are exact: 2^20.
const MAX_MULTIPLES: f64 = 1_048_576.0;
/// Terms of each series: 1/22! and 1/21! are below 1e-19.
const TERMS: u32 = 10;

impl Constant {
    fn interval(&self) -> Interval {
        Interval::point(self.high) + Interval::new(self.low.0, self.low.1)
    }

    /// A whole number k and x - k c.
    fn reduce(&self, x: f64) -> Option<(f64, Interval)> {
        let multiple = (x / self.high).round();
        if multiple.is_nan() || multiple.abs() >= MAX_MULTIPLES {
            return None;
        }
        let k = Interval::point(multiple);
        let rest = Interval::point(x) - k * Interval::point(self.high);
        Some((multiple, rest - k * Interval::new(self.low.0, self.low.1)))
    }
}

/// An enclosure of 2 pi.
pub fn full_turn() -> Interval {
    HALF_PI.interval() * Interval::point(4.0)
}

/// Enclosures of cos(sqrt(z)) and sin(sqrt(z))/sqrt(z) for |z| <= 1, of either sign: entire functions of z. The whole line
/// for any other z.
///
/// Their series are sum (-z)^n/(2n)! and sum (-z)^n/(2n + 1)!; the tail from n = 11 on is less than twice its first term.
pub fn even_series(z: Interval) -> (Interval, Interval) {
    if z.magnitude() > 1.0 {
        return (Interval::WHOLE, Interval::WHOLE);
    }
    let horner = |offset: u32| {
        (1..=TERMS).rev().fold(Interval::ONE, |sum, n| {
            let factor = f64::from((2 * n + offset) * (2 * n + offset - 1));
            Interval::ONE - z / Interval::point(factor) * sum
        })
    };
    let tail = Interval::around(0.0, 2e-21 * z.magnitude());
    (horner(0) + tail, horner(1) + tail)
}

fn sin_cos_of(x: f64) -> (Interval, Interval) {
    let unit = Interval::new(-1.0, 1.0);
    let Some((multiple, rest)) = HALF_PI.reduce(x) else {
        return (unit, unit);
    };
    let (cosine, ratio) = even_series(rest.square());
    let sine = rest * ratio;
    match multiple.rem_euclid(4.0) as u8 {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

fn exp_of(x: f64) -> Interval {
    let tiny = Interval::new(0.0, 1e-300);
    let Some((multiple, rest)) = LN_2.reduce(x) else {
        return if x < 0.0 { tiny } else { Interval::WHOLE };
    };
    if multiple < -1000.0 {
        return tiny;
    }
    if multiple > 1000.0 {
        return Interval::WHOLE;
    }
    let last = 2 * TERMS;
    let series = (1..=last).rev().fold(Interval::ONE, |sum, n| {
        Interval::ONE + rest / Interval::point(f64::from(n)) * sum
    });
    // e/21! < 1e-19.
    let series = series + Interval::around(0.0, 1e-19 * rest.magnitude());
    // 2^multiple.
    let power = f64::from_bits(((multiple + 1023.0) as u64) << 52);
    series * Interval::point(power)
}

impl Interval {
    /// Enclosures of its sine and cosine.
    pub fn sin_cos(self) -> (Self, Self) {
        let middle = self.middle();
        let (sine, cosine) = sin_cos_of(middle);
        if self.width() == 0.0 {
            return (sine, cosine);
        }
        let away = self - Self::point(middle);
        let half_square = away.square() * Self::point(0.5);
        let rest = Self::around(0.0, half_square.magnitude());
        let unit = Self::new(-1.0, 1.0);
        let clip = |it: Self| it.intersection(unit).unwrap_or(unit);
        (
            clip(sine + cosine * away + rest),
            clip(cosine - sine * away + rest),
        )
    }

    /// An enclosure of its exponential.
    pub fn exp(self) -> Self {
        if self.width() == 0.0 {
            return exp_of(self.low());
        }
        exp_of(self.low()).hull(exp_of(self.high()))
    }
}
