//! Recurrence: whether a row of stroboscopic states returns, and after which period.

use crate::tolerance::ROUNDING;
use softstop::Start;

/// Distance within which a state has returned unless it is said otherwise, in units of the motion's size.
pub(crate) const RECURRENCE_DISTANCE: f64 = 1e-4;

/// The return of a row of stroboscopic states: after how many drive periods, and how closely.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Recurrence {
    /// Drive periods after which the states return.
    pub periods: usize,
    /// The largest distance between states so many periods apart, in units of the motion's size.
    pub distance: f64,
}

/// Distance in m/s of two states, positions counted times the drive's frequency in rad/s.
pub(crate) fn state_distance(frequency: f64, a: &Start, b: &Start) -> f64 {
    (frequency * (a.position - b.position)).hypot(a.velocity - b.velocity)
}

/// Squared distance of two states in m^2/s^2, as in [`state_distance`].
fn squared_distance(frequency: f64, a: &Start, b: &Start) -> f64 {
    let (x, v) = (
        frequency * (a.position - b.position),
        a.velocity - b.velocity,
    );
    x * x + v * v
}

/// The size of a motion in m/s: the distance of its farthest state from rest at the origin.
pub(crate) fn motion_size<'a>(frequency: f64, states: impl IntoIterator<Item = &'a Start>) -> f64 {
    let states = states.into_iter();
    let squares = states.map(|state| squared_distance(frequency, state, &Start::REST));
    squares.fold(0.0, f64::max).sqrt()
}

/// The return of a row of states: after the least number of periods for which all of its first half return.
pub(crate) fn find_recurrence(frequency: f64, states: &[Start]) -> Option<Recurrence> {
    find_recurrence_within(frequency, states, RECURRENCE_DISTANCE)
}

/// The return of a row of states as by [`find_recurrence`], with another distance, in units of the motion's size.
pub(crate) fn find_recurrence_within(
    frequency: f64,
    states: &[Start],
    share: f64,
) -> Option<Recurrence> {
    let longest = states.len().checked_sub(1)? / 2;
    let size = motion_size(frequency, states);
    let most = (share * size).powi(2);
    (1..=longest).find_map(|periods| {
        let mut largest = 0.0f64;
        for j in 0..=longest {
            largest = largest.max(squared_distance(
                frequency,
                &states[j],
                &states[j + periods],
            ));
            if largest > most {
                return None;
            }
        }
        let distance = if size > 0.0 {
            largest.sqrt() / size
        } else {
            0.0
        };
        Some(Recurrence { periods, distance })
    })
}

/// Share to which a difference falls within a row if it dies out: of a motion that returned, and of another.
const DECAY_SHARES: (f64, f64) = (0.8, 0.1);
/// How large a difference that dies out may be late in a row, in units of the distance of a return.
const MAX_LATE_GAP: f64 = 10.0;

/// The period of what a row of states settles on; none if it does not.
///
/// That after which its states return or, if they come ever nearer to each other so many periods apart, the
/// least divisor of it: a motion that spirals onto its orbit may come back after several turns before it does
/// after one. If no state has returned yet, the least period after which they come nearer fast. `share`: the distance
/// within which states have returned, in units of the motion's size.
pub(crate) fn find_settled_period(frequency: f64, states: &[Start], share: f64) -> Option<usize> {
    let most = MAX_LATE_GAP * share * motion_size(frequency, states);
    let dies = |apart: usize, ratio: f64| {
        let [first, second] = largest_squared_distances_by_half(frequency, states, apart);
        second < (most * most).min(ratio * ratio * first)
    };
    match find_recurrence_within(frequency, states, share) {
        Some(found) => {
            let divisors = (1..found.periods).filter(|part| found.periods.is_multiple_of(*part));
            let mut dying = divisors.filter(|part| dies(*part, DECAY_SHARES.0));
            Some(dying.next().unwrap_or(found.periods))
        }
        None => (1..=(states.len() - 1) / 4).find(|apart| dies(*apart, DECAY_SHARES.1)),
    }
}

/// True if a row of states returns after so many drive periods in its second half, to rounding.
pub(crate) fn returns_to_rounding(frequency: f64, states: &[Start], periods: usize) -> bool {
    let least = ROUNDING * motion_size(frequency, states);
    largest_squared_distances_by_half(frequency, states, periods)[1] <= least * least
}

/// Largest squared distances of states so many periods apart, in each half of a row.
fn largest_squared_distances_by_half(frequency: f64, states: &[Start], apart: usize) -> [f64; 2] {
    let (ahead, behind) = (&states[apart..], &states[..states.len() - apart]);
    let half = ahead.len() / 2;
    [0..half, half..ahead.len()].map(|half| {
        let pairs = ahead[half.clone()].iter().zip(&behind[half]);
        let squares = pairs.map(|(a, b)| squared_distance(frequency, a, b));
        squares.fold(0.0, f64::max)
    })
}

#[cfg(test)]
mod tests {
    use super::{find_recurrence_within, find_settled_period};
    use softstop::Start;

    /// A spiral onto the origin, a third of a turn and a little more at each step.
    fn spiral(decay: f64) -> Vec<Start> {
        let state = |k: i32| {
            let (sin, cos) = (f64::from(k) * 2.1).sin_cos();
            let size = 1e-4 * decay.powi(k);
            Start::new(1.0 + size * cos, size * sin)
        };
        (0..=24).map(state).collect()
    }

    #[test]
    fn a_spiral_settles_on_its_centre() {
        let states = spiral(0.9);
        let found = find_recurrence_within(1.0, &states, 3e-5).expect("returns");
        assert!(found.periods > 1, "{found:?}");
        assert_eq!(find_settled_period(1.0, &states, 3e-5), Some(1));
        // So it does where it has not come back yet, if it is fast and near.
        let fast = spiral(0.7);
        assert!(find_recurrence_within(1.0, &fast, 1e-5).is_none());
        assert_eq!(find_settled_period(1.0, &fast, 1e-5), Some(1));
    }

    #[test]
    fn a_true_period_is_kept() {
        let angle = |k: usize| (k % 3) as f64 * std::f64::consts::TAU / 3.0;
        let states: Vec<Start> = (0..=24)
            .map(|k| Start::new(angle(k).cos(), angle(k).sin()))
            .collect();
        assert_eq!(find_settled_period(1.0, &states, 1e-4), Some(3));
    }
}
