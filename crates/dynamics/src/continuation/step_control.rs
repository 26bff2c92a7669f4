//! Step control of a branch: what keeps a step from missing anything, and what ends a branch that no step can follow.
//!
//! At a corner an orbit gains or loses a touch that jumps no force but a derivative (the damper of a stop that sets in, a spring
//! that becomes another): the branch goes on in another direction, and its multipliers jump. (Leine and Nijmeijer 2004, ch. 8:
//! the nonsmooth fold and flip.)

use nalgebra::DVector;

use super::arclength::{Ends, Equations, Evaluation, Node, correct, curve_tangent};
use super::follow::{Continuation, same_orientation};
use super::grazing_test::GrazingTest;
use super::period_map::PeriodMap;
use super::point::{
    BorderCollision, BranchEnd, BranchLimits, HalfBranch, SpecialKind, SpecialPoint,
};
use super::shooting::Shooting;
use super::stepper::{CurveStep, Stepper};
use super::test_function::TestFunction;
use crate::orbit::OrbitError;
use crate::tolerance::{DIFFERENCE_WIDTH, SAME};

/// Shares of the way to a grazing, back from it, at which a fold or a flip is looked for: down to touches too weak for any step.
const TEST_SEARCH_SHARES: [f64; 6] = [0.5, 0.1, 1e-2, 1e-3, 1e-5, 1e-7];
/// Scaled distances, ahead and behind, at which something is looked for that a branch without a grazing ends in.
const BORDER_DISTANCES: [f64; 4] = [1e-8, 1e-7, 1e-6, 1e-5];
/// Scaled distances ahead at which a rest is looked for, where the orbits of a branch come to lie side by side.
const REST_DISTANCES: [f64; 3] = [1e-4, 1e-3, 1e-2];

/// Scaled gap between the halves of an orbit below which it merges with one of half its period.
const MERGING_GAP: f64 = 0.05;

impl Continuation<'_> {
    /// Ends a branch that cannot be followed any farther: where its orbit is one of half its period, in the grazing just ahead,
    /// at the end of the range just ahead (of values that no machine can have beyond), at an orbit that is too unstable, or
    /// lost.
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
        if way.end_in_grazing(self.graze_within(reach, stepper, grazing_test)) {
            return;
        }
        if let Some(node) = self.bound_at(&stepper.node, limits) {
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
            .dies_within(self.settings.border_distance)
            .then_some(BorderCollision::Surface);
        way.end = match self.border_ahead(stepper, &error).or(dies) {
            Some(border) => BranchEnd::Border(border),
            None if self.shooting.growth(&stepper.node.here.point.monodromy) * DIFFERENCE_WIDTH
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
            node.here.point.sequence.border_to(&beyond.point.sequence)
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

    /// True if nothing can be missed on a step of a branch.
    pub(super) fn may_take_step(
        &self,
        stepper: &Stepper<'_, Shooting<'_, 1>>,
        step: &CurveStep<PeriodMap>,
        (now, ahead): (&GrazingTest, &GrazingTest),
    ) -> bool {
        let (from, to) = (&stepper.node.here.point, &step.node.here.point);
        let same = from.sequence.has_same_jumps(&to.sequence)
            // Beyond, rounding decides on which side of a grazing an orbit is.
            && self.shooting.growth(&to.monodromy) * f64::EPSILON.sqrt() < 1.0
            && !self.comes_to_rest((&stepper.node, &step.node))
            && (same_orientation(
                (&stepper.direction, &from.monodromy),
                (&step.direction, &to.monodromy),
            ) || self.keeps_symmetric_sense(stepper, step));
        let settings = &self.settings;
        if stepper.step < settings.crawling_step {
            return same;
        }
        TestFunction::change_little(&from.monodromy, &to.monodromy, settings.max_test_change)
            && same
            && ahead.may_step(now, settings.min_distance_left, settings.border_distance)
            && !now.may_graze_twice(ahead, stepper.step)
    }

    /// True if a mass that is held on the way slips so much less after a step that rounding tells its orbits apart.
    fn comes_to_rest(&self, (from, to): Ends<'_, PeriodMap>) -> bool {
        let after = self.fold_test_while_held(to);
        let [before, there] = [from, to].map(|node| &node.here.point.monodromy);
        after < self.settings.border_distance
            && after < TestFunction::Fold.scaled_value(before).abs()
            && !TestFunction::Fold.passes_zero(before, there)
    }

    /// Size of the fold test of an orbit with a mass that is held on the way; infinite for others, above twice the distance
    /// of a border, and near a merging. It falls where the mass slips ever less: what it slips by then changes with the square
    /// of what is left, and Newton's method settles on orbits that no longer slip.
    fn fold_test_while_held(&self, node: &Node<PeriodMap>) -> f64 {
        let map = &node.here.point;
        let fold = TestFunction::Fold.scaled_value(&map.monodromy).abs();
        let merges = || {
            let gap = self.merging_gap(node);
            gap.is_some_and(|gap| gap.norm() < MERGING_GAP)
        };
        match map.sequence.holds > 0 && fold < 2.0 * self.settings.border_distance && !merges() {
            true => fold,
            false => f64::INFINITY,
        }
    }

    /// The grazing within the next step that leads no further, if there is one. Where an impact dies that no rest follows,
    /// a multiplier grows without bounds: from a stable orbit on, the branch folds or flips before, on shorter steps.
    pub(super) fn graze_ahead(
        &self,
        stepper: &Stepper<'_, Shooting<'_, 1>>,
        grazing_test: &GrazingTest,
    ) -> Option<SpecialPoint> {
        if stepper.step > self.settings.doubtful_step {
            return None;
        }
        let round = &stepper.node.here.point;
        let never_rests = round.sequence.rests == 0 && round.sequence.holds == 0;
        let turns_unstable = never_rests && round.monodromy.is_stable();
        let ends = |special: &SpecialPoint| match special.kind {
            SpecialKind::Grazing(graze) => {
                let goes_on = grazing_test.is_gentle(graze.face)
                    || graze.dies && turns_unstable
                    || self.folds_or_flips_before(special, stepper);
                !goes_on
            }
            SpecialKind::Critical(_) | SpecialKind::Pitchfork => false,
        };
        self.graze_within(2.0 * stepper.step, stepper, grazing_test)
            .filter(ends)
    }

    /// True if the branch folds or flips between a node and a grazing: right before it multipliers grow without bounds, and a
    /// flipped orbit may come back through both. Motions beside the grazing orbit tell, as the fold may lie beyond it.
    fn folds_or_flips_before(
        &self,
        special: &SpecialPoint,
        stepper: &Stepper<'_, Shooting<'_, 1>>,
    ) -> bool {
        let Ok(at) = self.place_of(&special.point) else {
            return false;
        };
        let (from, way) = (&stepper.node.here.point, &at - &stepper.node.at);
        let passes = |share: &f64| {
            let beside = self.shooting.evaluate(&(&at - *share * &way));
            beside.is_ok_and(|Evaluation { point, .. }| {
                let ends = (&from.monodromy, &point.monodromy);
                let tests = [TestFunction::Fold, TestFunction::Flip];
                from.sequence == point.sequence
                    && tests.iter().any(|test| test.passes_zero(ends.0, ends.1))
            })
        };
        TEST_SEARCH_SHARES.iter().any(passes)
    }

    /// The grazing ahead of a node within a scaled distance, if there is one.
    fn graze_within(
        &self,
        reach: f64,
        stepper: &Stepper<'_, Shooting<'_, 1>>,
        grazing_test: &GrazingTest,
    ) -> Option<SpecialPoint> {
        let is_ahead = |special: &&SpecialPoint| {
            let Ok(at) = self.place_of(&special.point) else {
                return false;
            };
            let way = at - &stepper.node.at;
            way.norm() < reach && way.dot(&stepper.direction) > 0.5 * way.norm()
        };
        let mut grazes = grazing_test.grazing_orbits(&self.shooting).iter();
        grazes.find(is_ahead).cloned()
    }

    /// A node beyond the corner just ahead, and the direction in which the branch goes on from it. Whether the force jumps
    /// at the touch plays no part: the map is continuous there, so that fixed points go on from it one way alone, which
    /// their index tells, and no other branch comes as near.
    pub(super) fn beyond_corner(
        &self,
        stepper: &Stepper<'_, Shooting<'_, 1>>,
    ) -> Option<(Node<PeriodMap>, DVector<f64>)> {
        let node = &stepper.node;
        CORNER_DISTANCES.into_iter().find_map(|reach| {
            let at = &node.at + reach * &stepper.direction;
            let here = self.shooting.evaluate(&at).ok()?;
            let sequence = here.point.sequence;
            if sequence == node.here.point.sequence {
                return None;
            }
            let guess = Node { at, here };
            let (along, _) = curve_tangent(&self.shooting, &guess, &stepper.direction).ok()?;
            [along.clone(), -along].into_iter().find_map(|along| {
                let ahead = &node.at + reach * &along;
                let found = correct(&self.shooting, &ahead, Some(&along)).ok()?;
                let near = (&found.at - &node.at).norm() < CORNER_REACH * reach;
                let goes_on = same_orientation(
                    (&stepper.direction, &node.here.point.monodromy),
                    (&along, &found.here.point.monodromy),
                );
                let is_beyond = found.here.point.sequence == sequence;
                (near && is_beyond && goes_on).then_some((found, along))
            })
        })
    }

    /// The special points of a corner between two nodes: the touch, and the tests that jump through zero.
    pub(super) fn specials_of_corner(
        &self,
        (from, to): Ends<'_, PeriodMap>,
    ) -> Result<Vec<SpecialPoint>, OrbitError> {
        let (a, b) = (&from.here.point.monodromy, &to.here.point.monodromy);
        let mut found = Vec::new();
        for test in TestFunction::ALL
            .into_iter()
            .filter(|test| test.passes_zero(a, b))
        {
            let (kind, point) = (SpecialKind::Critical(test), self.point_at(from)?);
            found.push(SpecialPoint { kind, point });
        }
        let (touches, _) = self.grazes_of_ends((from, to), CORNER_REACH, |_| false)?;
        found.extend(touches.into_iter().map(|(_, special)| special));
        Ok(found)
    }
}

/// Scaled distances beyond a corner at which the branch is taken up.
const CORNER_DISTANCES: [f64; 4] = [1e-7, 1e-6, 1e-5, 1e-4];
/// How many times as far the branch beyond a corner, and the touch, may lie as they are looked for.
const CORNER_REACH: f64 = 10.0;
