//! One Taylor step: the motion over a short time as power series.
//!
//! The deflection d from the face obeys d'' + 2 a d' + b (d + x0) + kappa d^n (1 + lambda d') = forcing. Away from
//! the face, and with n = 2, it is followed in time itself ([`super::taylor_step_in_time`]), but for n = 3/2 under a constant forcing
//! ([`super::taylor_step_on_sphere`]). At the face d^n has a branch point unless n is whole. If n is a
//! multiple of 1/m it goes away where the m-th root s of d is the unknown and a stretched time sigma,
//! dt = s^(m-1) dsigma, the variable (as Levi-Civita did for collisions, 1920):
//!
//! ```text
//! ds/dsigma = v/m    dv/dsigma = s^(m-1) (forcing - 2 a v - b (x0 + s^m) - kappa s^(m n) (1 + lambda v))
//! ```
//!
//! All are power series in sigma whose coefficients follow one from the other (Moore 1966). For
//! other n, while the power law's part of the motion is below rounding, it is left out right at the face. So it is
//! on a start from rest at the face, where sigma is time itself; and so it is in slow motion under heavy damping
//! ([`super::slow_manifold`]) and where there is no power law ([`super::taylor_step_in_time`]).

use serde::{Deserialize, Serialize};

use super::LinearLaw;
use super::power_law::PowerLaw;
use super::series::{Series, ZERO, curved_part, derivative, power_series, product, value};
use super::slow_manifold::SlowManifold;
use super::taylor_polynomials::{value_and_rate, value_and_rate_from};
use crate::root_finding::bracketed_newton;

/// One Taylor step of a motion: series in sigma, which is time or a regularised time.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct TaylorStep {
    /// Deflection in m at departure.
    pub(super) departed: f64,
    /// Deflection in m: of a linear law, from position zero.
    pub(super) depth: Series,
    /// What rounding took from the deflection at the start, in m: a linear law's alone carries it.
    pub(super) low: f64,
    /// Push per mass in m/s^2.
    pub(super) forcing: Series,
    /// What more there is where sigma is not time itself.
    pub(super) regularized: Option<Box<RegularizedTime>>,
    /// The power law acts.
    pub(super) is_pressed: bool,
    /// How far the series hold, in sigma.
    pub reach: f64,
    /// How far the mass stays beyond the face, in sigma: further on time would run back.
    pub(super) contact: f64,
    /// Length of the step in time, in s.
    pub end: f64,
    /// Where the step ends.
    pub(super) last: StateOnStep,
    pub(super) hertz: PowerLaw,
    /// Damping over mass in 1/s, the power law's left out.
    pub(super) damping: f64,
    /// Stiffness over mass in 1/s^2, the power law's left out.
    pub(super) stiffness: f64,
    /// What a slow motion remembers of its start.
    pub(super) slow_manifold: Option<Box<SlowManifold>>,
    /// Positions, velocities and forcings are counted downwards: the face stands below.
    pub(super) is_mirrored: bool,
}

/// The series of a Taylor step that is made in regularised time.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct RegularizedTime {
    /// Which root: m >= 2.
    pub index: f64,
    /// m-th root of the deflection in m^(1/m).
    pub root: Series,
    /// Velocity in m/s.
    pub velocity: Series,
    /// Time since departure in s.
    pub time: Series,
}

/// A state along a Taylor step, the deflection with its rounding.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct StateOnStep {
    /// Deflection in m.
    pub deflection: f64,
    /// What rounding took from it, in m.
    low: f64,
    /// Velocity in m/s.
    pub velocity: f64,
}

/// What is known of a position beyond its rounded value: the deflection, where it counts from a nonlinear face; else
/// what rounding took from it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct FinePosition {
    /// Deflection in m.
    pub deflection: f64,
    /// Rest in m.
    pub low: f64,
}

impl TaylorStep {
    /// A Taylor step under these laws, all of whose series are still zero.
    pub(super) fn without_motion(flow: &LinearLaw, hertz: &PowerLaw) -> Self {
        Self {
            hertz: *hertz,
            damping: flow.damping(),
            stiffness: flow.modes.stiffness,
            ..Self::default()
        }
    }

    /// Lets a step in time end at `reach`, or a millionth sooner: a length of few digits is added to a time without
    /// rounding, so that equal steps do not drift.
    pub(super) fn end_at(&mut self, reach: f64) {
        let reach = f64::from_bits(reach.to_bits() & (u64::MAX << 32));
        (self.reach, self.contact, self.end) = (reach, reach, reach);
        self.last = self.state_on_step_at(reach);
    }

    /// The sign of positions in the series: -1 if the step is computed with positions counted downwards, else 1.
    pub(super) fn side(&self) -> f64 {
        if self.is_mirrored { -1.0 } else { 1.0 }
    }

    /// True if the mass stands still all along the step.
    pub fn is_still(&self) -> bool {
        self.regularized.is_none() && self.depth[1..] == ZERO[1..]
    }

    /// The step's series in sigma of the velocity in m/s.
    pub(super) fn velocity_series(&self) -> Series {
        match &self.regularized {
            Some(regularized) => regularized.velocity,
            None => derivative(&self.depth),
        }
    }

    /// The step's series in sigma of the time since departure in s.
    pub(super) fn time_in_sigma(&self) -> Series {
        match &self.regularized {
            Some(regularized) => regularized.time,
            None => {
                let mut sigma = ZERO;
                sigma[1] = 1.0;
                sigma
            }
        }
    }

    /// The series in sigma of d(time)/d(sigma); 1 in a step in time.
    pub(super) fn time_rate_series(&self) -> Series {
        derivative(&self.time_in_sigma())
    }

    /// The step's series in sigma of d^n, the n-th power of the deflection, where the power law acts; else zero.
    pub(super) fn powers(&self) -> Series {
        match &self.regularized {
            _ if !self.is_pressed => ZERO,
            Some(regularized) => {
                let steepness = regularized.index * (self.hertz.exponent - 1.0);
                product(&power_series(&regularized.root, steepness), &self.depth)
            }
            None => power_series(&self.depth, self.hertz.exponent),
        }
    }

    /// The sigma that belongs to a time since departure.
    pub fn sigma_after(&self, elapsed: f64) -> f64 {
        if elapsed >= self.end {
            return self.contact;
        }
        let Some(regularized) = &self.regularized else {
            return elapsed;
        };
        if elapsed <= 0.0 {
            return 0.0;
        }
        let begin = (0.0, -elapsed);
        let end = (self.contact, self.end - elapsed);
        let guess = self.contact * (elapsed / self.end);
        bracketed_newton(begin, end, Some(guess), |sigma| {
            let (time, rate) = value_and_rate(&regularized.time, sigma);
            (time - elapsed, rate)
        })
    }

    /// Position in m and velocity in m/s on the step at a time since departure.
    pub fn state_after(&self, elapsed: f64) -> (f64, f64) {
        self.rounded_state(&self.state_on_step_after(elapsed))
    }

    /// Position in m and velocity in m/s on the step at sigma.
    pub fn state_at(&self, sigma: f64) -> (f64, f64) {
        self.rounded_state(&self.state_on_step_at(sigma))
    }

    /// Position in m and velocity in m/s where the mass leaves contact, or else where the step ends.
    pub fn last_state(&self) -> (f64, f64) {
        self.rounded_state(&self.last)
    }

    fn rounded_state(&self, moved: &StateOnStep) -> (f64, f64) {
        let (position, velocity) = (self.hertz.origin + moved.deflection, moved.velocity);
        (self.side() * position, self.side() * velocity)
    }

    fn state_on_step_after(&self, elapsed: f64) -> StateOnStep {
        if elapsed >= self.end {
            self.last
        } else {
            self.state_on_step_at(self.sigma_after(elapsed))
        }
    }

    pub(super) fn state_on_step_at(&self, sigma: f64) -> StateOnStep {
        if let Some(regularized) = &self.regularized {
            return StateOnStep {
                deflection: value(&regularized.root, sigma).powi(regularized.index as i32),
                low: 0.0,
                velocity: value(&regularized.velocity, sigma),
            };
        }
        let start = self.depth[0];
        let (way, velocity) = value_and_rate_from(self.low, &self.depth, sigma);
        // The sum without error of Knuth (1969, 4.2.2, theorem B).
        let sum = start + way;
        let taken = sum - start;
        StateOnStep {
            deflection: sum,
            low: (start - (sum - taken)) + (way - taken),
            velocity,
        }
    }

    /// What is known of the position at the start of the step beyond its rounded value.
    pub fn fine_start_position(&self) -> FinePosition {
        FinePosition {
            deflection: self.departed,
            low: self.low,
        }
    }

    /// What is known of the position on the step at a time since departure beyond its rounded value.
    pub fn fine_position_at(&self, elapsed: f64) -> FinePosition {
        let StateOnStep {
            deflection, low, ..
        } = self.state_on_step_after(elapsed);
        FinePosition { deflection, low }
    }

    /// Forcing per mass in m/s^2 on the step at sigma.
    pub fn forcing_at(&self, sigma: f64) -> f64 {
        self.side() * value(&self.forcing, sigma)
    }

    /// Time since departure on the step at sigma, in s.
    pub fn time_at_sigma(&self, sigma: f64) -> f64 {
        match &self.regularized {
            Some(regularized) => value(&regularized.time, sigma),
            None => sigma,
        }
    }

    /// True if a guard of the position alone, `position` x - `level`, stays below zero throughout [0, span] in sigma,
    /// as its tangent and the sizes of all other terms show.
    pub fn position_guard_stays_below(&self, position: f64, level: f64, span: f64) -> bool {
        let position = self.side() * position;
        let level = level - position * self.hertz.origin;
        let series = match &self.regularized {
            Some(regularized) if level == 0.0 => &regularized.root,
            _ => &self.depth,
        };
        let start = position * (series[0] + self.low) - level;
        let tangent = start + (position * series[1] * span).max(0.0);
        tangent + position.abs() * curved_part(series, span) < 0.0
    }

    /// The guard `position` x + `velocity` v + `forcing` q - `level` as a series in sigma; where it is the distance from
    /// the face itself, that of its root, which has the same sign.
    pub fn guard_series(&self, position: f64, velocity: f64, forcing: f64, level: f64) -> Series {
        let [position, velocity, forcing] =
            [position, velocity, forcing].map(|it| self.side() * it);
        // Seen from the face, a surface at the face is at zero exactly.
        let level = level - position * self.hertz.origin;
        let at_face = level == 0.0 && velocity == 0.0 && forcing == 0.0;
        let mut sum = match &self.regularized {
            Some(regularized) if at_face => regularized.root,
            _ => self.depth,
        };
        for term in &mut sum {
            *term *= position;
        }
        if velocity != 0.0 {
            let rates = self.velocity_series();
            sum = std::array::from_fn(|k| sum[k] + velocity * rates[k]);
        }
        if forcing != 0.0 {
            sum = std::array::from_fn(|k| sum[k] + forcing * self.forcing[k]);
        }
        sum[0] -= level;
        sum[0] += position * self.low;
        sum
    }
}
