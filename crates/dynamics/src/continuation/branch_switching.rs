//! Branches that come out of others: orbits of twice the period out of a flip, asymmetric ones out of a pitchfork.
//!
//! An orbit between two stops that are alike is symmetric where x(t + n T/2) = -x(t): a fixed point of half its map P, followed by
//! a mirror, -P(s) = s. Its monodromy matrix is the square of that matrix, -P', of which a multiplier 1 is a fold of symmetric
//! orbits, and a multiplier -1 a pitchfork: two asymmetric orbits come out of it, mirror images of each other.

use std::ops::ControlFlow;

use nalgebra::{DVector, Matrix2};

use super::arclength::{Ends, Equations, Evaluation, Node, correct};
use super::branch::Branch;
use super::follow::{Continuation, is_one_sense};
use super::locate::{along_chord, is_beside};
use super::period_map::PeriodMap;
use super::point::{BranchEnd, BranchLimits, BranchPoint, HalfBranch, SpecialKind, SpecialPoint};
use super::shooting::Shooting;
use super::stepper::{CurveStep, Stepper};
use super::test_function::{TestFunction, null_vector};
use crate::orbit::{Monodromy, OrbitError};
use crate::tolerance::SAME;

/// Scaled distances from a flip or a pitchfork at which the branch that comes out of it is looked for.
const BRANCHING_DISTANCES: [f64; 5] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

impl Continuation<'_> {
    /// Follows the branch of orbits of twice the period from a flip of these orbits on, along the critical eigenvector.
    ///
    /// # Errors
    /// [`OrbitError::Diverged`] if there is no such branch near the point.
    pub fn double_period(
        &self,
        flip: &BranchPoint,
        limits: &BranchLimits,
        mut watch: impl FnMut(&BranchPoint) -> ControlFlow<()>,
    ) -> Result<Branch, OrbitError> {
        let doubled = self.over_periods(2 * self.shooting.periods);
        doubled.branch_from(flip, (-1.0, 2, BranchEnd::Merged), limits, &mut watch)
    }

    /// The branch along the eigenvector of a critical multiplier of a point, of orbits with so many times its impacts, and why
    /// it ends at the point.
    pub(super) fn branch_from(
        &self,
        point: &BranchPoint,
        (multiplier, times, end): (f64, usize, BranchEnd),
        limits: &BranchLimits,
        watch: &mut dyn FnMut(&BranchPoint) -> ControlFlow<()>,
    ) -> Result<Branch, OrbitError> {
        let (start, along) = self.branch_off(point, (multiplier, times))?;
        let way = self.follow_half(start.clone(), &along, limits, watch)?;
        self.join_halves(&start, HalfBranch::empty(end), way)
    }

    /// A node away from a point with a critical multiplier, along its eigenvector, with so many times its impacts, and the
    /// way there: half the period, or its mirror image, leads as clearly away.
    fn branch_off(
        &self,
        from: &BranchPoint,
        (multiplier, times): (f64, usize),
    ) -> Result<(Node<PeriodMap>, DVector<f64>), OrbitError> {
        let at = self.shooting.scaled(from.state(), [from.parameter]);
        let away = null_vector(&(from.monodromy.matrix - multiplier * Matrix2::identity()));
        let away = self.shooting.scaled(away, [0.0]).normalize();
        for distance in BRANCHING_DISTANCES {
            let guess = &at + distance * &away;
            let Ok(node) = correct(&self.shooting, &guess, Some(&away)) else {
                continue;
            };
            let along: DVector<f64> = &node.at - &at;
            let fold = TestFunction::Fold.scaled_value(&node.here.point.monodromy);
            // Beyond, the new branch may have flipped itself.
            let near = along.norm() < 2.0 * distance && fold.abs() < 0.5;
            let gap = self.merging_gap(&node);
            let leads_away = gap.is_some_and(|gap| gap.norm() > 0.5 * distance);
            if near && leads_away && node.here.point.impacts.len() == times * from.impacts.len() {
                return Ok((node, along));
            }
        }
        Err(OrbitError::LOST)
    }

    /// Scaled distance of half an orbit's period from the mirror image of its start; none if it cannot be symmetric.
    pub(super) fn mirror_gap(&self, node: &Node<PeriodMap>) -> Option<DVector<f64>> {
        let half = self.shooting.half_period(&node.here.point)?;
        (half.asymmetry.norm() >= SAME).then_some(half.asymmetry)
    }

    /// True if directions at both ends of a step between symmetric orbits, which turn at no pitchfork, may be one.
    pub(super) fn keeps_symmetric_sense(
        &self,
        stepper: &Stepper<'_, Shooting<'_, 1>>,
        step: &CurveStep<PeriodMap>,
    ) -> bool {
        let half = |node| self.shooting.symmetric_half_period(node);
        let (Some(from), Some(to)) = (half(&stepper.node), half(&step.node)) else {
            return false;
        };
        // 1 - tr + det of the mirrored half round.
        is_one_sense(
            TestFunction::Flip.scaled_value(&from) * stepper.direction[2],
            TestFunction::Flip.scaled_value(&to) * step.direction[2],
        )
    }

    /// The pitchfork of symmetric orbits on a step and its share of the way, if there is one.
    pub(super) fn pitchfork_on_step(
        &self,
        (from, to): Ends<'_, PeriodMap>,
    ) -> Result<Option<(f64, SpecialPoint)>, OrbitError> {
        let half = |node| self.shooting.symmetric_half_period(node);
        let (Some(a), Some(b)) = (half(from), half(to)) else {
            return Ok(None);
        };
        if !TestFunction::Fold.passes_zero(&a, &b) {
            return Ok(None);
        }
        let [a, b] = [a, b].map(|half| TestFunction::Fold.scaled_value(&half));
        let way = &to.at - &from.at;
        let node = self.pitchfork(&(&from.at + a / (a - b) * &way))?;
        let (share, _) = along_chord((&from.at, &way), &node.at);
        if !(0.0..=1.0).contains(&share) || !is_beside((&from.at, &way), &node.at) {
            return Err(OrbitError::LOST);
        }
        let (kind, point) = (SpecialKind::Pitchfork, self.point_at(&node)?);
        Ok(Some((share, SpecialPoint { kind, point })))
    }

    /// The node of the pitchfork near a place.
    pub(super) fn pitchfork(&self, near: &DVector<f64>) -> Result<Node<PeriodMap>, OrbitError> {
        let at = correct(&Pitchfork(&self.shooting), near, None)?.at;
        let here = self.shooting.evaluate(&at)?;
        Ok(Node { at, here })
    }

    /// Follows the branch of asymmetric orbits from a pitchfork of symmetric ones on, along the critical eigenvector;
    /// the other one is its mirror image, half a drive period later.
    ///
    /// # Errors
    /// [`OrbitError::Diverged`] if there is no such branch near the point.
    pub fn branch_asymmetric(
        &self,
        pitchfork: &BranchPoint,
        limits: &BranchLimits,
        mut watch: impl FnMut(&BranchPoint) -> ControlFlow<()>,
    ) -> Result<Branch, OrbitError> {
        self.branch_from(
            pitchfork,
            (1.0, 1, BranchEnd::Symmetric),
            limits,
            &mut watch,
        )
    }
}

/// The equations of a pitchfork: symmetric orbits with a multiplier -1 of the mirrored half period.
struct Pitchfork<'a, 'b>(&'b Shooting<'a, 1>);

impl Equations for Pitchfork<'_, '_> {
    type Point = Monodromy;

    fn evaluate(&self, at: &DVector<f64>) -> Result<Evaluation<Monodromy>, OrbitError> {
        let map = self.0.evaluate(at)?.point;
        let half = self.0.half_period(&map).ok_or(OrbitError::LOST)?;
        let symmetric = Evaluation {
            residual: half.asymmetry.rows(0, 2).into_owned(),
            tolerance: half.tolerance,
            point: half.monodromy,
        };
        Ok(symmetric.with_test(TestFunction::Fold.scaled_value(&half.monodromy)))
    }
}
