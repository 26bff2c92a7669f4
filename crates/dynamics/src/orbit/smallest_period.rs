//! The smallest period of the orbit that a row of stroboscopic states has come to.

use super::Orbit;
use super::recurrence::{motion_size, state_distance};
use crate::tolerance::NEIGHBOUR;
use softstop::{Scene, Start};

/// The period in drive periods of what a row of states comes to that returns after some. Near a flip a motion comes
/// back after twice its orbit's period long before it does after that period: where states a part of the period apart
/// are near to each other, the orbit that Newton's method reaches from the last one decides.
pub(crate) fn smallest_period(scene: &Scene, states: &[Start], periods: usize) -> usize {
    let frequency = scene.excitation.frequency;
    let near = NEIGHBOUR * motion_size(frequency, states);
    let last = states.len() - 1;
    let is_near = |state: &Start| state_distance(frequency, &states[last], state) <= near;
    let mut parts = (1..periods).filter(|part| periods.is_multiple_of(*part));
    if !parts.any(|part| is_near(&states[last - part])) {
        return periods;
    }
    match Orbit::find_periodic(scene, states[last].into(), periods as u64) {
        Ok(orbit) if orbit.is_stable() && is_near(&orbit.state().into()) => orbit.periods as usize,
        _ => periods,
    }
}
