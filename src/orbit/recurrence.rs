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
