//! The free motion x'' + 2 a x' + b x = 0 without cancellation anywhere in (a, b, t).

use nalgebra::Matrix2;

/// The free motion of a linear law: fundamental solutions of x'' + 2 a x' + b x = 0 for a >= 0 and any real b: C(0) =
/// 1, C'(0) = 0; S(0) = 0, S'(0) = 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Modes {
    /// a in 1/s.
    pub decay: f64,
    /// b in 1/s^2.
    pub stiffness: f64,
    kind: ModeKind,
}

/// The roots of the characteristic equation: complex, real, or one of the limits between.
#[derive(Debug, Clone, Copy, PartialEq)]
enum ModeKind {
    /// b > a^2: roots -a +- i `omega`.
    Oscillating { omega: f64 },
    /// b <= a^2: real roots `slow` >= `fast`, `spread` = slow - fast (0 at the double root).
    Aperiodic { slow: f64, fast: f64, spread: f64 },
}

impl Modes {
    /// The free motion of this decay in 1/s and this stiffness in 1/s^2.
    pub fn new(decay: f64, stiffness: f64) -> Self {
        // fma: b - a^2 rounded once, so that a near-double root keeps its digits.
        let discriminant = (-decay).mul_add(decay, stiffness);
        let kind = if discriminant > 0.0 {
            ModeKind::Oscillating {
                omega: discriminant.sqrt(),
            }
        } else {
            let half = discriminant.abs().sqrt();
            let fast = -(decay + half);
            let slow = if fast == 0.0 { 0.0 } else { stiffness / fast };
            ModeKind::Aperiodic {
                slow,
                fast,
                spread: 2.0 * half,
            }
        };
        Self {
            decay,
            stiffness,
            kind,
        }
    }

    /// The transition [[C, S], [C', S']] of the free motion's state after `t` >= 0 seconds; C' = -b S.
    ///
    /// Aperiodic: with E1 = exp(slow t), E2 = exp(fast t), S = E1 (1 - exp(-spread t)) / spread, C = E2 - fast S, S' =
    /// E2 + slow S; every difference of nearly equal terms is inside `exp_m1`.
    #[inline]
    pub fn transition(&self, t: f64) -> Matrix2<f64> {
        let (cosine, sine, sine_rate) = match self.kind {
            ModeKind::Oscillating { omega } => {
                let fade = (-self.decay * t).exp();
                let (sin, cos) = (omega * t).sin_cos();
                let sine = fade * sin / omega;
                (
                    fade * cos + self.decay * sine,
                    sine,
                    fade * cos - self.decay * sine,
                )
            }
            ModeKind::Aperiodic { slow, fast, spread } => {
                let lag = (-spread * t).exp_m1();
                let first = (slow * t).exp();
                let second = first * (1.0 + lag);
                let sine = if spread == 0.0 {
                    first * t
                } else {
                    first * (-lag / spread)
                };
                (second - fast * sine, sine, second + slow * sine)
            }
        };
        Matrix2::new(cosine, sine, -self.stiffness * sine, sine_rate)
    }

    /// Fastest rate of the free motion in 1/s: no mode grows, decays or turns faster.
    pub fn fastest_rate(&self) -> f64 {
        match self.kind {
            ModeKind::Oscillating { .. } => (2.0 * self.decay).max(self.stiffness.sqrt()),
            ModeKind::Aperiodic { fast, .. } => fast.abs(),
        }
    }

    /// Rate in 1/s that stays when the fast mode has died out.
    pub fn slow_rate(&self) -> f64 {
        match self.kind {
            ModeKind::Oscillating { .. } => self.stiffness.sqrt(),
            ModeKind::Aperiodic { slow, .. } => slow.abs(),
        }
    }

    /// Rates in 1/s at which the two modes die out, the slower first; 0 for one that does not.
    pub fn decay_rates(&self) -> (f64, f64) {
        match self.kind {
            ModeKind::Oscillating { .. } => (self.decay, self.decay),
            ModeKind::Aperiodic { slow, fast, .. } => ((-slow).max(0.0), -fast),
        }
    }

    /// Rate in 1/s of the slower mode, where the free motion dies out.
    pub fn slowest_decay(&self) -> Option<f64> {
        let (slow, _) = self.decay_rates();
        (self.stiffness > 0.0 && slow > 0.0).then_some(slow)
    }

    /// Bounds (max |C|, max |S|) over 0 <= t <= `span`.
    ///
    /// For b >= 0 the energy b x^2 + v^2 never grows, hence |C| <= 1, |S| <= t and |S| <= 1/sqrt(b); for real roots S
    /// <= exp(slow t) / spread as well. For b < 0, C <= exp(slow t) and S <= t exp(slow t).
    pub fn solution_bounds(&self, span: f64) -> (f64, f64) {
        match self.kind {
            ModeKind::Oscillating { .. } => (1.0, span.min(1.0 / self.stiffness.sqrt())),
            ModeKind::Aperiodic { slow, spread, .. } => {
                if self.stiffness > 0.0 {
                    let least = (1.0 / spread).min(1.0 / self.stiffness.sqrt());
                    return (1.0, span.min(least));
                }
                let growth = if slow > 0.0 { (slow * span).exp() } else { 1.0 };
                (growth, growth * span.min(1.0 / spread))
            }
        }
    }

    /// The largest |y| that can follow from (y, y'), or infinity where the motion grows.
    pub fn amplitude_bound(&self, y: f64, rate: f64) -> f64 {
        match self.kind {
            ModeKind::Oscillating { omega } => y.hypot((rate + self.decay * y) / omega),
            ModeKind::Aperiodic { .. } if self.stiffness > 0.0 => {
                y.abs() + rate.abs() / self.stiffness.sqrt()
            }
            ModeKind::Aperiodic { .. } => f64::INFINITY,
        }
    }
}
