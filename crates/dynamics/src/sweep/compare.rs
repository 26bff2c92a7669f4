//! Where a sweep jumps, and where up and down differ.

use super::{Chain, Settled, Step};
use crate::orbit::ImpactPattern;

/// Change of the largest before-impact velocity from one step to the next, in units of the larger one, that
/// is a jump if the steps before and after change it by less than a share of that.
const LEAP: (f64, f64) = (0.1, 0.2);
/// Difference of the largest before-impact velocities at one value, in units of the larger one, of two motions
/// of the same regime that are not the same.
const APART: f64 = 0.01;

/// A change of the motion from one step to the next that has settled.
#[derive(Debug, Clone, PartialEq)]
pub struct Jump {
    /// Value of the last step before.
    pub from: f64,
    /// Value of the first step after.
    pub to: f64,
    /// What the motion was.
    pub before: Settled,
    /// What it is now.
    pub after: Settled,
    /// Orders of impacts before and after.
    pub orders: [Option<ImpactPattern>; 2],
    /// Largest before-impact velocities in m/s before and after.
    pub velocities: (f64, f64),
}

/// Neighbouring values of the parameter at which the motions up and down differ.
#[derive(Debug, Clone, PartialEq)]
pub struct Coexistence {
    /// Least of them.
    pub from: f64,
    /// Largest.
    pub to: f64,
    /// The motion on the way up.
    pub up: Settled,
    /// The motion on the way down.
    pub down: Settled,
    /// Orders of impacts on the way up and down.
    pub orders: [Option<ImpactPattern>; 2],
}

impl<M> Chain<M> {
    /// Its jumps, in its own order. Steps that have not settled are passed over: a jump goes from the last
    /// settled step before them to the first one after.
    pub fn jumps(&self) -> Vec<Jump> {
        let settled = self
            .steps
            .iter()
            .filter(|step| !step.settled.is_unsettled());
        let settled: Vec<&Step> = settled.collect();
        let jump = |pair: &[&Step]| Jump {
            from: pair[0].value,
            to: pair[1].value,
            before: pair[0].settled,
            after: pair[1].settled,
            orders: [pair[0], pair[1]].map(|step| step.order.clone()),
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
    if !is_like(before, after) {
        return true;
    }
    let change = |a: &Step, b: &Step| (b.hardest() - a.hardest()).abs();
    let leap = change(before, after);
    let is_even = |a: &Step, b: &Step| !is_like(a, b) || change(a, b) < LEAP.1 * leap;
    let earlier = index.checked_sub(1).map(|earlier| steps[earlier]);
    differ(before, after, LEAP.0)
        && earlier.is_none_or(|earlier| is_even(earlier, before))
        && steps
            .get(index + 2)
            .is_none_or(|later| is_even(after, later))
}

/// True if both are of one kind: of the same regime with the same order of impacts, or chaos.
fn is_like(a: &Step, b: &Step) -> bool {
    a.settled.is_like(&b.settled) && a.order == b.order
}

/// True if the motions are of different kinds, or of one regime but not the same.
fn differ(a: &Step, b: &Step, share: f64) -> bool {
    let (low, high) = (a.hardest().min(b.hardest()), a.hardest().max(b.hardest()));
    let periodic = a.settled.regime().is_some();
    !is_like(a, b) || (periodic && high - low > share * high)
}

/// The steps of both at the same values, in rising order.
fn pairs<'a, M>(up: &'a Chain<M>, down: &'a Chain<M>) -> Vec<(&'a Step, &'a Step)> {
    let others = down.rising();
    let other = |value: f64| others.binary_search_by(|step| step.value.total_cmp(&value));
    let ours = up.rising().into_iter();
    ours.filter_map(|step| Some((step, others[other(step.value).ok()?])))
        .collect()
}

/// The ranges in which the same machine moves otherwise on the way up than on the way down; where one of them
/// has not settled, nothing is said.
pub fn hysteresis<M>(up: &Chain<M>, down: &Chain<M>) -> Vec<Coexistence> {
    let mut zones: Vec<Coexistence> = Vec::new();
    let mut open = false;
    for (a, b) in pairs(up, down) {
        let settled = !a.settled.is_unsettled() && !b.settled.is_unsettled();
        let apart = settled && differ(a, b, APART);
        let last = zones.last_mut().filter(|zone| {
            let same = zone.up.is_like(&a.settled) && zone.down.is_like(&b.settled);
            open && apart && same && zone.orders == [a.order.clone(), b.order.clone()]
        });
        match last {
            Some(zone) => zone.to = a.value,
            None if apart => zones.push(Coexistence {
                from: a.value,
                to: a.value,
                up: a.settled,
                down: b.settled,
                orders: [a, b].map(|step| step.order.clone()),
            }),
            None => {}
        }
        open = apart;
    }
    zones
}
