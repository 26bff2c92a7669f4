//! The sum of the last bounces on a rigid stop, infinitely many in a finite time.
//!
//! Pressed onto the stop with the acceleration A, a mass that leaves it with the speed w is back after
//! 2 w / A and leaves with R w: the bounces end after T = 2 w / (A (1 - R)). Under dry friction the way
//! out has another acceleration (B) than the way back (A): one bounce then takes w/B + w/sqrt(A B), and the
//! ratio of speeds is q = R sqrt(A/B).
//!
//! What is left out: on the way the accelerations change by at most D = 2 (r T + c w + k h), with r the
//! largest rate of the forcing meanwhile, c and k damping and stiffness per mass, h the height of the first bounce. Each
//! bounce's time and speed change by a factor within 1 +- D / A, so T is wrong by at most D T / A and a
//! speed by D T. The sum is taken only where both are below rounding. Where another law holds on the way
//! back it is taken earlier: there the mass turns at a position that is rounded, which falsifies a bounce
//! of height h by half a rounding over h; below 2^17 roundings the sum is the more exact one.

use serde::{Deserialize, Serialize};

use super::Polynomial;

/// The last bounces on a rigid stop, infinitely many in a finite time, as a geometric series.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Chatter {
    /// Speed in m/s with which it begins, negative on a stop below.
    pub speed: f64,
    /// Time in s until rest.
    pub duration: f64,
    /// Accelerations on the way out and back, in m/s^2.
    accelerations: (f64, f64),
    /// Ratio of the speeds of one bounce and the next.
    ratio: f64,
}

/// Limits below which the last bounces are summed in place of being followed one by one.
struct SummationLimits {
    /// Longest duration of the sum, in drive periods.
    duration: f64,
    /// Height of the first bounce, in roundings of its position, below which it is too rough to be followed where
    /// another law holds on the way back.
    rough_height: f64,
    /// Height of the first bounce, in roundings of its position, below which what a bounce loses is lost in them.
    lost_height: f64,
    /// Largest relative change of the accelerations during the sum.
    change: f64,
}

impl SummationLimits {
    const DEFAULT: Self = Self {
        duration: 1.0 / (1u64 << 26) as f64,
        rough_height: (1u64 << 17) as f64,
        lost_height: (1u64 << 8) as f64,
        change: 1.0 / (1u64 << 10) as f64,
    };
}

/// What presses a bouncing mass onto a rigid stop, per unit of mass.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PressingForces {
    /// Accelerations towards the stop on the way out and back, in m/s^2.
    pub accelerations: (f64, f64),
    /// Bound on the rate of the drive in m/s^3.
    pub drive_rate: f64,
    /// External force per mass from now on, in m/s^2.
    pub forcing: Polynomial,
    /// Damping in 1/s.
    pub damping: f64,
    /// Stiffness in 1/s^2.
    pub stiffness: f64,
    /// Drive period in s.
    pub period: f64,
    /// Rounding in m of the position at which another law takes over; none if one law holds on both ways.
    pub grain: Option<f64>,
}

impl PressingForces {
    /// Bound in m/s^2 on what the forcing of a bouncing mass changes by within `duration`.
    fn forcing_change(&self, duration: f64) -> f64 {
        (self.drive_rate + self.forcing.largest_rate(duration)) * duration
    }
}

impl Chatter {
    /// The sum of the bounces that follow once a mass has left a rigid stop with `speed`; none unless they are so low
    /// or so brief that following them one by one tells no more.
    pub fn from_speed(speed: f64, restitution: f64, by: &PressingForces) -> Option<Self> {
        let (limits, (out, back)) = (SummationLimits::DEFAULT, by.accelerations);
        if !(speed > 0.0 && out > 0.0 && back > 0.0) {
            return None;
        }
        let bounce = speed * (1.0 / out + 1.0 / (out * back).sqrt());
        let height = 0.5 * speed * speed / out;
        let weakest = out.min(back);
        let series = |ratio: f64| Self {
            speed,
            duration: bounce / (1.0 - ratio),
            accelerations: (out, back),
            ratio,
        };
        let change = |sum: &Self| {
            2.0 * (by.forcing_change(sum.duration) + by.damping * speed + by.stiffness * height)
        };
        let ratio = restitution * (back / out).sqrt();
        let sum = Some(series(ratio)).filter(|_| ratio < 1.0);
        let exact = |sum: &Self| {
            let close = 0.25 * f64::EPSILON * by.period * weakest;
            sum.duration <= limits.duration * by.period && change(sum) * sum.duration <= close
        };
        let low = |roundings: f64| by.grain.is_some_and(|grain| height <= roundings * grain);
        let rough = |sum: &Self| low(limits.rough_height) && change(sum) <= limits.change * weakest;
        // What is lost in rounding: a series that the forcing outlasts, or else a last bounce.
        let lost = || {
            let steady = |sum: &Self| by.forcing_change(sum.duration) <= limits.change * weakest;
            low(limits.lost_height).then(|| sum.filter(steady).unwrap_or(series(0.0)))
        };
        sum.filter(|sum| exact(sum) || rough(sum)).or_else(lost)
    }

    /// This chatter on a stop above, by 1, or below, by -1.
    pub fn on_side(self, side: f64) -> Self {
        let (out, back) = self.accelerations;
        Self {
            speed: side * self.speed,
            accelerations: (side * out, side * back),
            ..self
        }
    }

    /// Position in m, counted from the stop, and velocity in m/s, `elapsed` seconds after the first bounce has begun.
    pub fn state_after(&self, elapsed: f64) -> (f64, f64) {
        let left = 1.0 - elapsed / self.duration;
        if left <= 0.0 {
            return (0.0, 0.0);
        }
        let bounces = if self.ratio > 0.0 {
            (left.ln() / self.ratio.ln()).floor()
        } else {
            0.0
        };
        let shrunk = self.ratio.powf(bounces);
        let since = (shrunk - left) * self.duration;
        let (out, back) = self.accelerations;
        let speed = shrunk * self.speed;
        let turn = speed / out;
        if since <= turn {
            (since * (0.5 * out * since - speed), out * since - speed)
        } else {
            let since = since - turn;
            let far = -0.5 * speed * turn;
            let way = far + 0.5 * back * since * since;
            (if way * back > 0.0 { 0.0 } else { way }, back * since)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Chatter, Polynomial, PressingForces};

    fn pressed(out: f64, back: f64) -> PressingForces {
        PressingForces {
            accelerations: (out, back),
            drive_rate: 0.3,
            forcing: Polynomial::linear(7.0, -0.2),
            damping: 0.0,
            stiffness: 0.0,
            period: 20.0,
            grain: None,
        }
    }

    #[test]
    fn each_bounce_is_the_one_before_shrunk() {
        let chatter = Chatter::from_speed(1e-9, 0.6, &pressed(2.0, 1.5)).expect("sums");
        let first = 1e-9 * (1.0 / 2.0 + 1.0 / 3f64.sqrt());
        let ratio = 0.6 * (1.5f64 / 2.0).sqrt();
        for share in [0.1, 0.3, 0.7, 0.99] {
            let (x, v) = chatter.state_after(share * first);
            let (y, u) = chatter.state_after(first * (1.0 + ratio * share));
            assert!((y - ratio * ratio * x).abs() < 1e-12 * x.abs());
            assert!((u - ratio * v).abs() < 1e-6 * 1e-9);
        }
        assert_eq!(chatter.state_after(chatter.duration), (0.0, 0.0));
    }

    #[test]
    fn a_rising_bounce_is_not_summed() {
        assert!(Chatter::from_speed(1e-9, 1.0, &pressed(2.0, 2.0)).is_none());
        assert!(Chatter::from_speed(1e-9, 0.6, &pressed(-1e-3, 2.0)).is_none());
        assert!(Chatter::from_speed(1e-3, 0.6, &pressed(2.0, 2.0)).is_none());
    }
}
