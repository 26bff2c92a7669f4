//! Where the orbits of a branch merge: with those of half their period at a flip, or into symmetric ones at a pitchfork.

use nalgebra::DVector;

use super::equations::{CurveNode, StepEnds};
use super::locate_zero::locate_zero;
use super::period_map::PeriodMap;
use super::{BranchEnd, BranchPoint, Continuation, TestFunction};
use crate::orbit::{Monodromy, OrbitError};
use crate::tolerance::{NEAR, SAME};

impl Continuation<'_> {
    /// The flip at which an orbit becomes one of half as many periods, or the pitchfork at which it becomes symmetric,
    /// and why the branch ends there, if it does on a step: half the period leads to the other side of it.
    pub(super) fn merging_point(
        &self,
        (from, to): StepEnds<'_, PeriodMap>,
    ) -> Result<Option<(BranchPoint, BranchEnd)>, OrbitError> {
        let periods = self.shooting.periods;
        let is_even = periods.is_multiple_of(2);
        let (Some(a), Some(b)) = (self.merging_gap(from), self.merging_gap(to)) else {
            return Ok(None);
        };
        if a.dot(&b) >= 0.0 && b.norm() > NEAR * a.norm() {
            return Ok(None);
        }
        let share = a.norm() / (a.norm() + b.norm());
        let way = &to.at - &from.at;
        let at = &from.at + share * &way;
        // Where an impact passes drive angle phi the gaps change their sides, too: what is found then lies elsewhere.
        let is_near = |place: &DVector<f64>| (place - &at).norm() <= way.norm();
        if !is_even {
            let node = self.pitchfork(&at).ok().filter(|it| is_near(&it.at));
            let point = node.and_then(|node| self.point_at(&node).ok());
            return Ok(point.map(|point| (point, BranchEnd::Symmetric)));
        }
        let continuation = self.over_periods(periods / 2);
        let [parameter] = self.shooting.parameters(&at);
        let found = continuation
            .find_point(parameter, self.shooting.state_at(&at))
            .and_then(|near| continuation.locate(&near, TestFunction::Flip));
        let beside = |flip: &BranchPoint| self.unknowns_of(flip).is_ok_and(|place| is_near(&place));
        let Some(flip) = found.ok().filter(beside) else {
            // Right beside grazing Newton's method does not settle on the flip: the gap vanishes there nevertheless.
            let left = |node: &CurveNode<PeriodMap>| self.merging_gap(node).map(|gap| gap.dot(&a));
            let value = |node: &CurveNode<PeriodMap>| left(node).unwrap_or(f64::NAN);
            let Ok((node, _)) = locate_zero(&self.shooting, (from, to), value) else {
                return Ok(None);
            };
            let gap = self.merging_gap(&node);
            if gap.is_none_or(|gap| gap.norm() >= NEAR * a.norm().max(b.norm())) {
                return Ok(None);
            }
            // So it does on the orbit without the touch.
            return match node.here.point.counts == from.here.point.counts {
                true => Ok(Some((self.point_at(&node)?, BranchEnd::Merged))),
                false => Err(OrbitError::LOST),
            };
        };
        let twice = BranchPoint {
            impacts: flip.impacts.repeat(2),
            monodromy: Monodromy::product(&[flip.monodromy; 2]),
            ..flip
        };
        Ok(Some((twice, BranchEnd::Merged)))
    }

    /// Scaled gap that closes where an orbit merges: from a state to that after half the periods, or to its mirror image; none
    /// where there is neither, or the orbit is its own mirror image already.
    pub(super) fn merging_gap(&self, node: &CurveNode<PeriodMap>) -> Option<DVector<f64>> {
        let periods = self.shooting.periods;
        if !periods.is_multiple_of(2) {
            let half = self.shooting.mirrored_half_period(&node.here.point)?;
            return (half.asymmetry.norm() >= SAME).then_some(half.asymmetry);
        }
        let half = node.here.point.trajectory.at_cycle(periods / 2);
        let way = half - self.shooting.state_at(&node.at);
        Some(self.shooting.scaled_unknowns(way, [0.0]))
    }
}
