//! Where a sweep jumps, and where up and down differ.

use super::{Chain, Step};
use crate::motion::MotionKind;

/// Change of the largest before-impact velocity from one step of a sweep to the next, in units of the larger one, that
/// is a jump if the steps before and after change it by less than a share of that.
const JUMP_SHARES: (f64, f64) = (0.1, 0.2);
/// Difference of largest velocities, in units of the larger, from which motions of one regime are two.
const COEXISTENCE_SHARE: f64 = 0.01;

/// A jump of a sweep: a change of the settled motion from one step to the next.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Jump {
    /// Parameter value of the last step before the jump.
    pub from: f64,
    /// Parameter value of the first step after the jump.
    pub to: f64,
    /// The motion before the jump.
    pub before: MotionKind,
    /// The motion after the jump.
    pub after: MotionKind,
    /// Largest before-impact velocities in m/s before and after the jump.
    pub velocities: (f64, f64),
}

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

impl Chain {
    /// The jumps of a sweep, in its own order: from a settled step to the next one, however many lie between.
    pub fn find_jumps(&self) -> Vec<Jump> {
        let settled: Vec<&Step> = self.steps.iter().filter(|step| step.is_settled()).collect();
        let jump = |pair: &[&Step]| Jump {
            from: pair[0].value,
            to: pair[1].value,
            before: pair[0].motion.clone(),
            after: pair[1].motion.clone(),
            velocities: (pair[0].hardest_impact(), pair[1].hardest_impact()),
        };
        let pairs = settled.windows(2).enumerate();
        let jumps = pairs.filter(|(index, _)| is_jump(&settled, *index));
        jumps.map(|(_, pair)| jump(pair)).collect()
    }
}

/// True if the sweep jumps after a step: to another kind of motion, or to one hit much harder or less hard.
fn is_jump(steps: &[&Step], index: usize) -> bool {
    let (before, after) = (steps[index], steps[index + 1]);
    if before.motion != after.motion {
        return true;
    }
    let change = |a: &Step, b: &Step| (b.hardest_impact() - a.hardest_impact()).abs();
    let leap = change(before, after);
    let is_even = |a: &Step, b: &Step| a.motion != b.motion || change(a, b) < JUMP_SHARES.1 * leap;
    let earlier = index.checked_sub(1).map(|earlier| steps[earlier]);
    are_different(before, after, JUMP_SHARES.0)
        && earlier.is_none_or(|earlier| is_even(earlier, before))
        && steps
            .get(index + 2)
            .is_none_or(|later| is_even(after, later))
}

/// True if the motions of two steps are of different kinds, or of one regime but not the same.
fn are_different(a: &Step, b: &Step, share: f64) -> bool {
    let (low, high) = (
        a.hardest_impact().min(b.hardest_impact()),
        a.hardest_impact().max(b.hardest_impact()),
    );
    let repeats = a.motion.periods().is_some();
    a.motion != b.motion || (repeats && high - low > share * high)
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
        let apart = a.is_settled() && b.is_settled() && are_different(a, b, COEXISTENCE_SHARE);
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
