//! Where the sweeps up and down settle on different motions.

use super::chain::Chain;
use super::sweep_step::SweepStep;
use crate::motion_kind::MotionKind;
use crate::tolerance::SIMILAR;

/// A range of the parameter in which the sweeps up and down settle on different motions: a hysteresis.
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

/// The steps of the sweeps up and down at the same values of the parameter, in rising order.
fn pair_steps<'a>(up: &'a Chain, down: &'a Chain) -> Vec<(&'a SweepStep, &'a SweepStep)> {
    let others = down.rising_steps();
    let other = |value: f64| others.binary_search_by(|step| step.value.total_cmp(&value));
    let ours = up.rising_steps().into_iter();
    ours.filter_map(|step| Some((step, others[other(step.value).ok()?])))
        .collect()
}

/// The ranges of the parameter in which the sweeps of a machine up and down settle on different motions.
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
