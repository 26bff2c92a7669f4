//! Whether a row of stroboscopic states repeats.

use crate::integrator::Start;

/// Distance within which a state has returned, in units of the motion's size.
const RETURN: f64 = 1e-4;

/// A motion that returns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Return {
    /// Drive periods after which it does.
    pub periods: usize,
    /// The largest distance between states so many periods apart, in units of the motion's size.
    pub distance: f64,
}

/// Distance in m/s of two states, positions counted times the drive's frequency in rad/s.
pub(crate) fn distance(frequency: f64, a: &Start, b: &Start) -> f64 {
    (frequency * (a.position - b.position)).hypot(a.velocity - b.velocity)
}

/// The size of a motion in m/s: its largest state.
pub(crate) fn size<'a>(frequency: f64, states: impl IntoIterator<Item = &'a Start>) -> f64 {
    let zero = Start {
        position: 0.0,
        velocity: 0.0,
    };
    let sizes = states
        .into_iter()
        .map(|state| distance(frequency, state, &zero));
    sizes.fold(0.0, f64::max)
}

/// The least number of drive periods, up to half of the row's length, after which each state of the first
/// half of the row returns.
pub(crate) fn returns(frequency: f64, states: &[Start]) -> Option<Return> {
    returns_within(frequency, states, RETURN)
}

/// The same with another distance, in units of the motion's size.
pub(crate) fn returns_within(frequency: f64, states: &[Start], share: f64) -> Option<Return> {
    let longest = states.len().checked_sub(1)? / 2;
    let size = size(frequency, states);
    (1..=longest).find_map(|periods| {
        let mut largest = 0.0f64;
        for j in 0..=longest {
            largest = largest.max(distance(frequency, &states[j], &states[j + periods]));
            if largest > share * size {
                return None;
            }
        }
        let distance = if size > 0.0 { largest / size } else { 0.0 };
        Some(Return { periods, distance })
    })
}

/// Share of its first size to which a difference must have fallen to count as one that dies out, and how large it
/// may still be, in units of the distance within which states have returned.
const DYING: (f64, f64) = (0.8, 10.0);

/// The period of what a row of states that returns after `periods` drive periods settles on: that, or the least
/// divisor of it so many periods apart of which the states come ever nearer to each other. A motion that spirals
/// onto its orbit may come back after several turns before it does after one. `share`: the distance within
/// which states have returned, in units of the motion's size.
pub(crate) fn settles_on(frequency: f64, states: &[Start], periods: usize, share: f64) -> usize {
    let largest = DYING.1 * share * size(frequency, states);
    let divisors = (1..periods).filter(|part| periods.is_multiple_of(*part));
    let mut dying = divisors.filter(|part| dies_out(frequency, states, *part, largest));
    dying.next().unwrap_or(periods)
}

/// True if states a number of periods apart come nearer to each other from the first half of a row to the second,
/// and are no farther apart than `most` in the end.
fn dies_out(frequency: f64, states: &[Start], apart: usize, most: f64) -> bool {
    let gaps: Vec<f64> = states
        .iter()
        .zip(&states[apart..])
        .map(|(a, b)| distance(frequency, a, b))
        .collect();
    let (first, second) = gaps.split_at(gaps.len() / 2);
    let largest = |gaps: &[f64]| gaps.iter().copied().fold(0.0, f64::max);
    largest(second) < most.min(DYING.0 * largest(first))
}

#[cfg(test)]
mod tests {
    use super::{returns_within, settles_on};
    use crate::integrator::Start;

    /// A spiral onto the origin, a third of a turn and a little more at each step.
    fn spiral(decay: f64) -> Vec<Start> {
        let state = |k: i32| {
            let (sin, cos) = (f64::from(k) * 2.1).sin_cos();
            let size = 1e-4 * decay.powi(k);
            Start {
                position: 1.0 + size * cos,
                velocity: size * sin,
            }
        };
        (0..=24).map(state).collect()
    }

    #[test]
    fn a_spiral_settles_on_its_centre() {
        let states = spiral(0.9);
        let found = returns_within(1.0, &states, 3e-5).expect("returns");
        assert!(found.periods > 1, "{found:?}");
        assert_eq!(settles_on(1.0, &states, found.periods, 3e-5), 1);
    }

    #[test]
    fn a_true_period_is_kept() {
        let angle = |k: usize| (k % 3) as f64 * std::f64::consts::TAU / 3.0;
        let states: Vec<Start> = (0..=24)
            .map(|k| Start {
                position: angle(k).cos(),
                velocity: angle(k).sin(),
            })
            .collect();
        assert_eq!(settles_on(1.0, &states, 3, 1e-4), 3);
    }
}
