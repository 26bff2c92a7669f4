//! What keeps a step along a branch from missing anything, and what ends a branch that no step can follow.

use super::Family;
use super::arclength::{Node, Stride, Walker};
use super::follower::Follower;
use super::graze::Approach;
use super::point::Special;
use super::round::{Round, grazes_gently};
use super::shooting::Shooting;
use super::test::Test;
use super::way::{End, Limits, Way};
use crate::orbit::OrbitError;

/// Largest change of a test function per step.
const LARGEST_CHANGE: f64 = 0.3;
/// Smallest share that a step may leave of the distance to grazing, while that is more than `NEAR`
/// (scaled).
const SHARE_LEFT: f64 = 0.3;
const NEAR: f64 = 1e-4;
/// Length of the steps up to which a grazing orbit is looked for ahead: nothing else is on so short a way.
const CLOSE: f64 = 1e-3;
/// Scaled distance within which a branch that cannot be followed is taken to end in the grazing ahead: multipliers grow
/// as the reciprocal of the distance, and no step is short enough for them.
const AHEAD: f64 = 1e-2;
/// Length of the steps from which on all changes are taken.
pub(super) const SHORT: f64 = 1e-5;

impl<F: Family> Follower<'_, F> {
    /// Ends a branch that cannot be followed any farther: in the grazing just ahead, at the end of the range just
    /// ahead (of values that no machine can have beyond), or lost.
    pub(super) fn give_up(
        &self,
        way: &mut Way,
        walker: &Walker<'_, Shooting<'_, F, 1>>,
        approach: &Approach,
        limits: &Limits,
        error: OrbitError,
    ) {
        if way.grazes(self.graze_within(AHEAD, walker, approach)) {
            return;
        }
        if let Some(node) = self.bound_at(&walker.node, limits) {
            way.end = match self.point_at(&node) {
                Ok(point) => {
                    way.points.push(point);
                    End::Range
                }
                Err(error) => End::Lost(error),
            };
            return;
        }
        way.end = End::Lost(error);
    }

    /// True if nothing can be missed on a step.
    pub(super) fn may_take(
        &self,
        walker: &Walker<'_, Shooting<'_, F, 1>>,
        stride: &Stride<Round>,
        (now, ahead): (&Approach, &Approach),
    ) -> bool {
        let (from, to) = (&walker.node.here.point, &stride.node.here.point);
        let same = from.sequence == to.sequence;
        if walker.step < SHORT {
            return same;
        }
        let gentle = self.is_gentle(&stride.node);
        let change = |test: Test| (test.value(&from.monodromy) - test.value(&to.monodromy)).abs();
        Test::ALL.iter().all(|test| change(*test) < LARGEST_CHANGE)
            && (gentle || (same && ahead.leaves(now, SHARE_LEFT, NEAR)))
    }

    pub(super) fn is_gentle(&self, node: &Node<Round>) -> bool {
        let scene = self.shooting.scene(&node.at);
        scene.is_ok_and(|scene| grazes_gently(&scene))
    }

    /// The grazing within the next step, if there is one.
    pub(super) fn graze_ahead(
        &self,
        walker: &Walker<'_, Shooting<'_, F, 1>>,
        approach: &Approach,
    ) -> Option<Special> {
        if walker.step > CLOSE {
            return None;
        }
        self.graze_within(2.0 * walker.step, walker, approach)
    }

    /// The grazing ahead within a scaled distance, if there is one.
    fn graze_within(
        &self,
        reach: f64,
        walker: &Walker<'_, Shooting<'_, F, 1>>,
        approach: &Approach,
    ) -> Option<Special> {
        approach.grazes(&self.shooting).into_iter().find(|special| {
            let Ok(at) = self.place(&special.point) else {
                return false;
            };
            let way = at - &walker.node.at;
            way.norm() < reach && way.dot(&walker.direction) > 0.5 * way.norm()
        })
    }
}
