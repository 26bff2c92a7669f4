//! Where a sweep jumps, and where up and down differ.

use super::{Chain, Step};
use crate::motion::MotionKind;

/// Change of the largest before-impact velocity from one step to the next, in units of the larger one, that
/// is a jump if the steps before and after change it by less than a share of that.
const LEAP: (f64, f64) = (0.1, 0.2);
/// Difference of the largest before-impact velocities at one value, in units of the larger one, of two motions
/// of the same regime that are not the same.
const APART_SHARE: f64 = 0.01;

/// A change of the motion from one step to the next that has settled.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Jump {
    /// Value of the last step before.
    pub from: f64,
    /// Value of the first step after.
    pub to: f64,
    /// What the motion was.
    pub before: MotionKind,
    /// What it is now.
    pub after: MotionKind,
    /// Largest before-impact velocities in m/s before and after.
    pub velocities: (f64, f64),
}

/// Neighbouring values of the parameter at which the motions up and down differ.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Coexistence {
    /// Least of them.
    pub from: f64,
    /// Largest.
    pub to: f64,
    /// The motion on the way up.
    pub up: MotionKind,
    /// The motion on the way down.
    pub down: MotionKind,
}

impl Chain {
    /// Its jumps, in its own order. Steps that have not settled are passed over: a jump goes from the last
    /// settled step before them to the first one after.
    pub fn jumps(&self) -> Vec<Jump> {
        let settled: Vec<&Step> = self.steps.iter().filter(|step| step.is_settled()).collect();
        let jump = |pair: &[&Step]| Jump {
            from: pair[0].value,
            to: pair[1].value,
            before: pair[0].motion.clone(),
            after: pair[1].motion.clone(),
            velocities: (pair[0].hardest(), pair[1].hardest()),
        };
        let pairs = settled.windows(2).enumerate();
        let jumps = pairs.filter(|(index, _)| leaps(&settled, *index));
        jumps.map(|(_, pair)| jump(pair)).collect()
    }
}

/// True if the step after this one is another motion: of another kind or, of one regime, hit much harder or less
/// hard than the course before and after leads to.
fn leaps(steps: &[&Step], index: usize) -> bool {
    let (before, after) = (steps[index], steps[index + 1]);
    if before.motion != after.motion {
        return true;
    }
    let change = |a: &Step, b: &Step| (b.hardest() - a.hardest()).abs();
    let leap = change(before, after);
    let is_even = |a: &Step, b: &Step| a.motion != b.motion || change(a, b) < LEAP.1 * leap;
    let earlier = index.checked_sub(1).map(|earlier| steps[earlier]);
    differ(before, after, LEAP.0)
        && earlier.is_none_or(|earlier| is_even(earlier, before))
        && steps
            .get(index + 2)
            .is_none_or(|later| is_even(after, later))
}

/// True if the motions are of different kinds, or of one regime but not the same.
fn differ(a: &Step, b: &Step, share: f64) -> bool {
    let (low, high) = (a.hardest().min(b.hardest()), a.hardest().max(b.hardest()));
    let repeats = a.motion.periods().is_some();
    a.motion != b.motion || (repeats && high - low > share * high)
}

/// The steps of both at the same values, in rising order.
fn pairs<'a>(up: &'a Chain, down: &'a Chain) -> Vec<(&'a Step, &'a Step)> {
    let others = down.rising();
    let other = |value: f64| others.binary_search_by(|step| step.value.total_cmp(&value));
    let ours = up.rising().into_iter();
    ours.filter_map(|step| Some((step, others[other(step.value).ok()?])))
        .collect()
}

/// The ranges in which the same machine moves otherwise on the way up than on the way down; where one of them
/// has not settled, nothing is said.
pub fn hysteresis(up: &Chain, down: &Chain) -> Vec<Coexistence> {
    let mut zones: Vec<Coexistence> = Vec::new();
    let mut open = false;
    for (a, b) in pairs(up, down) {
        let apart = a.is_settled() && b.is_settled() && differ(a, b, APART_SHARE);
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
