//! Branches that come out of others: orbits of twice the period out of a flip, asymmetric ones out of a pitchfork.

use std::ops::ControlFlow;

use nalgebra::{DVector, Matrix2};

use super::equations::CurveNode;
use super::half_branch::HalfBranch;
use super::newton_corrector::correct;
use super::normal_form::null_vector;
use super::period_map::PeriodMap;
use super::{Branch, BranchEnd, BranchLimits, BranchPoint, Continuation, TestFunction};
use crate::orbit::OrbitError;

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
        doubled.follow_new_branch(flip, (-1.0, 2, BranchEnd::Merged), limits, &mut watch)
    }

    /// The branch along the eigenvector of a critical multiplier of a point, of orbits with so many times its impacts, and why
    /// it ends at the point.
    pub(super) fn follow_new_branch(
        &self,
        point: &BranchPoint,
        (multiplier, times, end): (f64, usize, BranchEnd),
        limits: &BranchLimits,
        watch: &mut dyn FnMut(&BranchPoint) -> ControlFlow<()>,
    ) -> Result<Branch, OrbitError> {
        let (start, along) = self.find_branch_start(point, (multiplier, times))?;
        let way = self.follow_half(start.clone(), &along, limits, watch)?;
        self.join_halves(&start, HalfBranch::empty(end), way)
    }

    /// A node away from a point with a critical multiplier, along its eigenvector, with so many times its impacts, and the
    /// way there: half the period, or its mirror image, leads as clearly away.
    fn find_branch_start(
        &self,
        from: &BranchPoint,
        (multiplier, times): (f64, usize),
    ) -> Result<(CurveNode<PeriodMap>, DVector<f64>), OrbitError> {
        let at = self
            .shooting
            .scaled_unknowns(from.state(), [from.parameter]);
        let away = null_vector(&(from.monodromy.matrix - multiplier * Matrix2::identity()));
        let away = self.shooting.scaled_unknowns(away, [0.0]).normalize();
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
        self.follow_new_branch(
            pitchfork,
            (1.0, 1, BranchEnd::Symmetric),
            limits,
            &mut watch,
        )
    }
}
