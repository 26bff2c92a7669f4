//! Orbits between two stops that are alike: where x(t + n T/2) = -x(t) ceases to hold.
//!
//! Such an orbit is a fixed point of half its map P, followed by a mirror: -P(s) = s. Its monodromy matrix is the square of that
//! matrix, -P', of which a multiplier 1 is a fold of symmetric orbits, and a multiplier -1 a pitchfork: two asymmetric orbits
//! come out of it, mirror images of each other.

use std::ops::ControlFlow;

use nalgebra::DVector;

use super::arclength::{Ends, Equations, Evaluation, Node, correct};
use super::branch::Branch;
use super::follow::{Continuation, is_one_sense};
use super::half_branch::{End, Limits};
use super::locate::{along_chord, is_beside};
use super::period_map::PeriodMap;
use super::point::{BranchPoint, Special, SpecialKind};
use super::shooting::Shooting;
use super::stepper::{CurveStep, Stepper};
use super::test_function::TestFunction;
use crate::orbit::{Monodromy, OrbitError};
use crate::tolerance::SAME;

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

impl Continuation<'_> {
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
    pub(super) fn pitchfork_between(
        &self,
        (from, to): Ends<'_, PeriodMap>,
    ) -> Result<Option<(f64, Special)>, OrbitError> {
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
        Ok(Some((share, Special { kind, point })))
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
        limits: &Limits,
        mut watch: impl FnMut(&BranchPoint) -> ControlFlow<()>,
    ) -> Result<Branch, OrbitError> {
        self.branch_from(pitchfork, (1.0, 1, End::Symmetric), limits, &mut watch)
    }
}
