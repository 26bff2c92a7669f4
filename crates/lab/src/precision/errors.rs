//! Errors of a solution: end, impact times and velocities, relative to the size of the motion.

use crate::methods::{Solution, Task};
use serde::Serialize;
use softstop::{Impact, Instant, MotionError};

/// The size of a motion, by which its errors are divided.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Scale {
    /// Largest distance from 0, in m.
    pub position: f64,
    /// Largest speed, in m/s.
    pub velocity: f64,
    /// Period of the drive, in s.
    pub period: f64,
}

/// Samples of a period that the size is taken from.
const SAMPLES: u64 = 64;

impl Scale {
    /// The size of a task's motion, in whole parts of a 64th of a period.
    ///
    /// # Errors
    /// [`MotionError`] if the task has no motion.
    pub fn of(task: &Task) -> Result<Self, MotionError> {
        let mut motion = task.scene.motion(task.start)?;
        let period = task.scene.period();
        let (mut position, mut velocity) = (0.0_f64, 0.0_f64);
        for sample in 0..=(task.periods * SAMPLES as f64).ceil() as u64 {
            let cycles = (sample / SAMPLES) as f64;
            let offset = (sample % SAMPLES) as f64 / SAMPLES as f64 * period;
            motion.advance(Instant { cycles, offset }, &mut ())?;
            let state = motion.state();
            position = position.max(state.position.abs());
            velocity = velocity.max(state.velocity.abs());
        }
        let or_one = |size: f64| if size > 0.0 { size } else { 1.0 };
        Ok(Self {
            position: or_one(position),
            velocity: or_one(velocity),
            period,
        })
    }

    /// Impacts so slow are not compared, in m/s: how many bounces of a chatter without end are told one
    /// by one is a matter of choice.
    pub fn slowest(&self) -> f64 {
        1e-6 * self.velocity
    }

    /// The impacts that are compared.
    pub fn told(&self, impacts: &[Impact]) -> Vec<Impact> {
        let fast = |impact: &&Impact| impact.velocity.abs() > self.slowest();
        impacts.iter().filter(fast).copied().collect()
    }
}

/// The errors of a solution, relative to the motion's size.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Errors {
    /// Of the state at the end: the root of the sum of the squares of position's and velocity's.
    pub end: f64,
    /// Of the times of impacts that have their match, the largest one, in drive periods.
    pub impact_time: Option<f64>,
    /// Of their before-impact velocities, the largest one.
    pub impact_velocity: Option<f64>,
    /// Impacts that were found less those that are.
    pub impact_difference: i64,
}

impl Errors {
    /// The errors of a solution against the true one.
    pub fn between(found: &Solution, truth: &Solution, scale: &Scale) -> Self {
        let position = (found.end.0 - truth.end.0) / scale.position;
        let velocity = (found.end.1 - truth.end.1) / scale.velocity;
        let (ours, true_ones) = (scale.told(&found.impacts), scale.told(&truth.impacts));
        let pairs = matches(&ours, &true_ones);
        let times = pairs
            .iter()
            .map(|(a, b)| (a.time - b.time).abs() / scale.period);
        let velocities = pairs.iter();
        let velocities = velocities.map(|(a, b)| (a.velocity - b.velocity).abs() / scale.velocity);
        Self {
            end: position.hypot(velocity),
            impact_time: times.reduce(f64::max),
            impact_velocity: velocities.reduce(f64::max),
            impact_difference: ours.len() as i64 - true_ones.len() as i64,
        }
    }

    /// The largest of all, and infinite if impacts are missing or invented.
    pub fn worst(&self) -> f64 {
        if self.impact_difference != 0 {
            return f64::INFINITY;
        }
        let impacts = [self.impact_time, self.impact_velocity];
        impacts.into_iter().flatten().fold(self.end, f64::max)
    }
}

/// Impacts that belong together: one by one if there are as many, else those that are nearest to each
/// other in time from both sides.
fn matches(found: &[Impact], truth: &[Impact]) -> Vec<(Impact, Impact)> {
    if found.len() == truth.len() {
        return found.iter().copied().zip(truth.iter().copied()).collect();
    }
    let mutual = |impact: &Impact| {
        let other = nearest(truth, impact.time)?;
        let back = nearest(found, other.time)?;
        (back.time == impact.time).then_some((*impact, other))
    };
    found.iter().filter_map(mutual).collect()
}

/// The impact nearest to a time; impacts are in order of time.
fn nearest(impacts: &[Impact], time: f64) -> Option<Impact> {
    let after = impacts.partition_point(|impact| impact.time < time);
    let around = [after.checked_sub(1), Some(after)];
    let candidates = around.into_iter().flatten();
    let candidates = candidates.filter_map(|index| impacts.get(index).copied());
    candidates.min_by(|a, b| (a.time - time).abs().total_cmp(&(b.time - time).abs()))
}

#[cfg(test)]
mod tests {
    use super::{Errors, Impact, Scale, Solution};
    use approx::assert_abs_diff_eq;

    const SCALE: Scale = Scale {
        position: 10.0,
        velocity: 4.0,
        period: 2.0,
    };

    fn solution(end: (f64, f64), impacts: &[(f64, f64)]) -> Solution {
        let impact = |&(time, velocity): &(f64, f64)| Impact { time, velocity };
        Solution {
            end,
            impacts: impacts.iter().map(impact).collect(),
            ..Solution::default()
        }
    }

    #[test]
    fn errors_are_relative_to_the_motion() {
        let truth = solution((1.0, 2.0), &[(0.5, 3.0), (2.5, 3.0)]);
        let found = solution((1.3, 2.16), &[(0.52, 3.0), (2.5, 2.6)]);
        let errors = Errors::between(&found, &truth, &SCALE);
        assert_abs_diff_eq!(errors.end, 0.05, epsilon = 1e-15);
        let [time, velocity] =
            [errors.impact_time, errors.impact_velocity].map(Option::unwrap_or_default);
        assert_abs_diff_eq!(time, 0.01, epsilon = 1e-15);
        assert_abs_diff_eq!(velocity, 0.1, epsilon = 1e-15);
        assert_eq!((errors.impact_difference, errors.worst()), (0, velocity));
    }

    #[test]
    fn a_missed_impact_leaves_the_others_matched() {
        let truth = solution((0.0, 0.0), &[(0.5, 3.0), (1.5, 3.0), (2.5, 2.0)]);
        let found = solution((0.0, 0.0), &[(0.5, 3.0), (2.5, 2.0)]);
        let errors = Errors::between(&found, &truth, &SCALE);
        let expected = Errors {
            end: 0.0,
            impact_time: Some(0.0),
            impact_velocity: Some(0.0),
            impact_difference: -1,
        };
        assert_eq!((errors, errors.worst()), (expected, f64::INFINITY));
    }

    #[test]
    fn the_end_of_a_chatter_is_not_compared() {
        let truth = solution((0.0, 0.0), &[(0.5, 3.0), (1.5, 1e-9)]);
        let found = solution((0.0, 0.0), &[(0.5, 3.0)]);
        assert_eq!(Errors::between(&found, &truth, &SCALE).worst(), 0.0);
    }
}
