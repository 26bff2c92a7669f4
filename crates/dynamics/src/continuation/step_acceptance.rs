//! Whether a step of a branch may be taken: whether nothing was missed on it, and its end lies on the same piece of the branch.

use nalgebra::DVector;

use super::equations::{CurveNode, StepEnds};
use super::grazing_test::GrazingTest;
use super::period_map::PeriodMap;
use super::stepper::{CurveStep, Stepper};
use super::stroboscopic_shooting::Shooting;
use super::{Continuation, TestFunction};
use crate::orbit::Monodromy;
use crate::tolerance::ROUNDING;

/// Scaled gap between the halves of an orbit below which it merges with one of half its period.
const MERGING_GAP: f64 = 0.05;

impl Continuation<'_> {
    /// True if nothing can be missed on a step of a branch.
    pub(super) fn may_take_step(
        &self,
        stepper: &Stepper<'_, Shooting<'_, 1>>,
        step: &CurveStep<PeriodMap>,
        (now, ahead): (&GrazingTest, &GrazingTest),
    ) -> bool {
        let (from, to) = (&stepper.node.here.point, &step.node.here.point);
        let same = from.counts.has_same_jumps(&to.counts)
            // Beyond, rounding decides on which side of a grazing an orbit is.
            && self.shooting.monodromy_norm(&to.monodromy) * f64::EPSILON.sqrt() < 1.0
            && !self.comes_to_rest((&stepper.node, &step.node))
            && (same_orientation(
                (&stepper.direction, &from.monodromy),
                (&step.direction, &to.monodromy),
            ) || self.same_symmetric_orientation(stepper, step));
        let settings = &self.settings;
        if stepper.step < settings.crawling_step {
            return same;
        }
        TestFunction::change_little(&from.monodromy, &to.monodromy, settings.max_test_change)
            && same
            && ahead.keeps_share_of_distances(
                now,
                settings.min_distance_left,
                settings.border_distance,
            )
            && !now.may_graze_twice(ahead, stepper.step)
    }

    /// True if a mass that is held on the way slips so much less after a step that rounding tells its orbits apart.
    fn comes_to_rest(&self, (from, to): StepEnds<'_, PeriodMap>) -> bool {
        let after = self.fold_test_while_held(to);
        let [before, there] = [from, to].map(|node| &node.here.point.monodromy);
        after < self.settings.border_distance
            && after < TestFunction::Fold.scaled_value(before).abs()
            && !TestFunction::Fold.passes_zero(before, there)
    }

    /// True if directions at both ends of a step between symmetric orbits, which turn at no pitchfork, may be one.
    fn same_symmetric_orientation(
        &self,
        stepper: &Stepper<'_, Shooting<'_, 1>>,
        step: &CurveStep<PeriodMap>,
    ) -> bool {
        let half = |node| self.shooting.symmetric_half_period(node);
        let (Some(from), Some(to)) = (half(&stepper.node), half(&step.node)) else {
            return false;
        };
        // 1 - tr + det of the mirrored half round.
        is_same_sign(
            TestFunction::Flip.scaled_value(&from) * stepper.direction[2],
            TestFunction::Flip.scaled_value(&to) * step.direction[2],
        )
    }

    /// Size of the fold test of an orbit with a mass that is held on the way; infinite for others, above twice the distance
    /// of a border, and near a merging. It falls where the mass slips ever less: what it slips by then changes with the square
    /// of what is left, and Newton's method settles on orbits that no longer slip.
    pub(super) fn fold_test_while_held(&self, node: &CurveNode<PeriodMap>) -> f64 {
        let map = &node.here.point;
        let fold = TestFunction::Fold.scaled_value(&map.monodromy).abs();
        let merges = || {
            let gap = self.merging_gap(node);
            gap.is_some_and(|gap| gap.norm() < MERGING_GAP)
        };
        match map.counts.holds > 0 && fold < 2.0 * self.settings.border_distance && !merges() {
            true => fold,
            false => f64::INFINITY,
        }
    }
}

/// True if a step has not leapt to another piece of the branch: no test changes much, the sense does not change.
pub(super) fn is_same_piece(
    stepper: &Stepper<'_, Shooting<'_, 1>>,
    step: &CurveStep<PeriodMap>,
) -> bool {
    let [from, to] = [&stepper.node, &step.node].map(|node| &node.here.point.monodromy);
    TestFunction::change_little(from, to, stepper.settings.max_test_change)
        && same_orientation((&stepper.direction, from), (&step.direction, to))
}

/// True if two tangents of a branch, each with the monodromy matrix there, have one orientation: along a branch the parameter's rate is
/// 1 - tr + det times a factor of constant sign, at corners as well, since that sign is the index of a fixed point of a continuous map.
pub(super) fn same_orientation(
    (from, before): (&DVector<f64>, &Monodromy),
    (to, after): (&DVector<f64>, &Monodromy),
) -> bool {
    let sense =
        |direction: &DVector<f64>, matrix| TestFunction::Fold.scaled_value(matrix) * direction[2];
    is_same_sign(sense(from, before), sense(to, after))
}

/// True if two values have one sign, or either is zero to rounding.
fn is_same_sign(from: f64, to: f64) -> bool {
    from * to >= 0.0 || from.abs().min(to.abs()) <= ROUNDING
}
