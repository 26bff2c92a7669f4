//! Coexistence: where the sweeps up and down differ.

use super::chain::Chain;
use super::step::Step;
use crate::motion::MotionKind;
use crate::tolerance::SIMILAR;

/// A range of the parameter in which the motions of the sweeps up and down differ.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Coexistence {
    /// Least value of the range.
    pub from: f64,
    /// Largest value of the range.
    pub to: f64,
    /// The motion of the sweep up.
    pub up: MotionKind,
    /// The motion of the sweep down.
    pub down: MotionKind,
}

/// The steps of the sweeps up and down at the same values, in rising order.
fn pair_steps<'a>(up: &'a Chain, down: &'a Chain) -> Vec<(&'a Step, &'a Step)> {
    let others = down.rising_steps();
    let other = |value: f64| others.binary_search_by(|step| step.value.total_cmp(&value));
    let ours = up.rising_steps().into_iter();
    ours.filter_map(|step| Some((step, others[other(step.value).ok()?])))
        .collect()
}

/// The hysteresis of two sweeps: ranges in which a machine's settled motions on the way up and down differ.
pub fn find_coexistences(up: &Chain, down: &Chain) -> Vec<Coexistence> {
    let mut zones: Vec<Coexistence> = Vec::new();
    let mut open = false;
    for (a, b) in pair_steps(up, down) {
        let apart = a.is_settled() && b.is_settled() && a.differs_from(b, SIMILAR);
        let last = zones
            .last_mut()
            .filter(|zone| open && apart && zone.up == a.motion && zone.down == b.motion);
        match last {
            Some(zone) => zone.to = a.value,
            None if apart => zones.push(Coexistence {
                from: a.value,
                to: a.value,
                up: a.motion.clone(),
                down: b.motion.clone(),
            }),
            None => {}
        }
        open = apart;
    }
    zones
}
