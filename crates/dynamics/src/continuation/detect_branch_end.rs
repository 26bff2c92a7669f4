//! What ends a branch: the end of the parameter's range, a grazing or another border collision just ahead, orbits too unstable.

use super::equations::{CurveNode, Equations, Evaluation, StepEnds};
use super::grazing_test::GrazingTest;
use super::half_branch::HalfBranch;
use super::period_map::PeriodMap;
use super::stepper::Stepper;
use super::stroboscopic_shooting::Shooting;
use super::{
    BorderCollision, BranchEnd, BranchLimits, BranchPoint, Continuation, SpecialKind, SpecialPoint,
    TestFunction,
};
use crate::orbit::OrbitError;
use crate::tolerance::{DIFFERENCE_WIDTH, SAME};

/// Shares of the way to a grazing, back from it, at which a fold or a flip is looked for: down to touches too weak for any step.
const TEST_SEARCH_SHARES: [f64; 6] = [0.5, 0.1, 1e-2, 1e-3, 1e-5, 1e-7];
/// Scaled distances, ahead and behind, at which something is looked for that a branch without a grazing ends in.
const BORDER_DISTANCES: [f64; 4] = [1e-8, 1e-7, 1e-6, 1e-5];
/// Scaled distances ahead at which a rest is looked for, where the orbits of a branch come to lie side by side.
const REST_DISTANCES: [f64; 3] = [1e-4, 1e-3, 1e-2];

impl Continuation<'_> {
    /// The end of the range beyond which a step leads, and whether the step begins there, or beyond it by rounding.
    pub(super) fn range_end_passed(
        &self,
        (from, to): StepEnds<'_, PeriodMap>,
        limits: &BranchLimits,
    ) -> Option<(f64, bool)> {
        let (low, high) = limits.range;
        let [before, now] = [from, to].map(|node| self.shooting.parameters(&node.at)[0]);
        let bound = now.clamp(low, high);
        let is_at = (before - bound) * (now - bound) >= 0.0;
        (bound != now).then_some((bound, is_at))
    }

    /// The orbit at the end of the range that a node has reached.
    pub(super) fn range_end_reached(
        &self,
        node: &CurveNode<PeriodMap>,
        limits: &BranchLimits,
    ) -> Option<CurveNode<PeriodMap>> {
        let (low, high) = limits.range;
        let state = self.shooting.state_at(&node.at);
        let reached = |bound: &f64| {
            let at = self.shooting.scaled_unknowns(state, [*bound]);
            (at - &node.at).norm() < self.settings.border_distance
        };
        let bound = [low, high].into_iter().find(reached)?;
        let found = self.correct_start(bound, state).ok()?;
        let events = |node: &CurveNode<PeriodMap>| node.here.point.counts.event_counts();
        (events(&found) == events(node)).then_some(found)
    }

    /// Ends a branch that cannot be followed any farther: where its orbit is one of half its period, in the grazing just ahead,
    /// at the end of the range just ahead (of values that no machine can have beyond), at too unstable an orbit, or lost.
    pub(super) fn end_branch(
        &self,
        way: &mut HalfBranch,
        stepper: &Stepper<'_, Shooting<'_, 1>>,
        grazing_test: &GrazingTest,
        limits: &BranchLimits,
        error: OrbitError,
    ) {
        // It begins right beside such an orbit, too.
        let may_merge = self.shooting.periods.is_multiple_of(2) && !way.points.is_empty();
        let gap = self.merging_gap(&stepper.node).filter(|_| may_merge);
        if gap.is_some_and(|gap| gap.norm() < SAME) {
            way.end = BranchEnd::Merged;
            return;
        }
        let reach = self.settings.newton_reach;
        if way.end_in_grazing(self.grazing_within(reach, stepper, grazing_test)) {
            return;
        }
        if let Some(node) = self.range_end_reached(&stepper.node, limits) {
            way.end = match self.point_at(&node) {
                Ok(point) => {
                    way.points.push(point);
                    BranchEnd::Range
                }
                Err(error) => BranchEnd::Lost(error),
            };
            return;
        }
        let dies = grazing_test
            .dies_closer_than(self.settings.border_distance)
            .then_some(BorderCollision::Surface);
        way.end = match self.border_ahead(stepper, &error).or(dies) {
            Some(border) => BranchEnd::Border(border),
            None if self
                .shooting
                .monodromy_norm(&stepper.node.here.point.monodromy)
                * DIFFERENCE_WIDTH
                > 1.0 =>
            {
                BranchEnd::Unstable
            }
            None => BranchEnd::Lost(error),
        };
    }

    /// The border collision just ahead of a node, or just behind it, as where a corner was passed beyond which no orbit
    /// goes on. A mass that slips ever less along the branch comes to be held for good.
    fn border_ahead(
        &self,
        stepper: &Stepper<'_, Shooting<'_, 1>>,
        error: &OrbitError,
    ) -> Option<BorderCollision> {
        let node = &stepper.node;
        let border = |reach: f64| {
            let there = &node.at + reach * &stepper.direction;
            let beyond = self.shooting.evaluate(&there).ok()?;
            node.here.point.counts.border_to(&beyond.point.counts)
        };
        let is_lost = !matches!(error, OrbitError::Motion(_));
        let slips_little = || is_lost && self.fold_test_while_held(node).is_finite();
        let behind = BORDER_DISTANCES.map(|reach| -reach);
        let mut near = BORDER_DISTANCES.into_iter().chain(behind);
        let held = || {
            let mut far = REST_DISTANCES.into_iter().filter_map(border);
            far.find(|border| *border == BorderCollision::Rest)
        };
        near.find_map(border)
            .or_else(|| held().filter(|_| *error == OrbitError::NotIsolated))
            .or_else(|| slips_little().then_some(BorderCollision::Rest))
    }

    /// The grazing within the next step that leads no further, if there is one. Where an impact dies that no rest follows,
    /// a multiplier grows without bounds: from a stable orbit on, the branch folds or flips before, on shorter steps.
    pub(super) fn grazing_end_ahead(
        &self,
        stepper: &Stepper<'_, Shooting<'_, 1>>,
        grazing_test: &GrazingTest,
    ) -> Option<SpecialPoint> {
        if stepper.step > self.settings.doubtful_step {
            return None;
        }
        let round = &stepper.node.here.point;
        let never_rests = round.counts.rests == 0 && round.counts.holds == 0;
        let turns_unstable = never_rests && round.monodromy.is_stable();
        let ends = |special: &SpecialPoint| match special.kind {
            SpecialKind::Grazing(graze) => {
                let goes_on = grazing_test.is_force_continuous(graze.surface)
                    || graze.dies && turns_unstable
                    || self.folds_or_flips_before(special, stepper);
                !goes_on
            }
            SpecialKind::Critical(_) | SpecialKind::Pitchfork => false,
        };
        self.grazing_within(2.0 * stepper.step, stepper, grazing_test)
            .filter(ends)
    }

    /// True if the branch folds or flips between a node and a grazing: right before it multipliers grow without bounds, and a
    /// flipped orbit may come back through both. Motions beside the grazing orbit tell, as the fold may lie beyond it.
    fn folds_or_flips_before(
        &self,
        special: &SpecialPoint,
        stepper: &Stepper<'_, Shooting<'_, 1>>,
    ) -> bool {
        let Ok(at) = self.unknowns_of(&special.point) else {
            return false;
        };
        let (from, way) = (&stepper.node.here.point, &at - &stepper.node.at);
        let passes = |share: &f64| {
            let beside = self.shooting.evaluate(&(&at - *share * &way));
            beside.is_ok_and(|Evaluation { point, .. }| {
                let ends = (&from.monodromy, &point.monodromy);
                let tests = [TestFunction::Fold, TestFunction::Flip];
                from.counts == point.counts
                    && tests.iter().any(|test| test.passes_zero(ends.0, ends.1))
            })
        };
        TEST_SEARCH_SHARES.iter().any(passes)
    }

    /// The grazing ahead of a node within a scaled distance, if there is one.
    fn grazing_within(
        &self,
        reach: f64,
        stepper: &Stepper<'_, Shooting<'_, 1>>,
        grazing_test: &GrazingTest,
    ) -> Option<SpecialPoint> {
        let is_ahead = |special: &&SpecialPoint| {
            let Ok(at) = self.unknowns_of(&special.point) else {
                return false;
            };
            let way = at - &stepper.node.at;
            way.norm() < reach && way.dot(&stepper.direction) > 0.5 * way.norm()
        };
        let mut grazes = grazing_test.grazing_orbits(&self.shooting).iter();
        grazes.find(is_ahead).cloned()
    }
}

/// True if a point may be one of many that lie side by side at one value of the parameter, as a fold is, too, which is alone.
pub(super) fn lies_beside_others(point: &BranchPoint) -> bool {
    TestFunction::Fold.vanishes_at(&point.monodromy)
}
