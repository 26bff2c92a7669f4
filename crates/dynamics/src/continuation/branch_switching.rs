//! Period doubling: from a flip to the orbits of twice the period.

use std::ops::ControlFlow;

use nalgebra::{DVector, Matrix2};

use super::arclength::{Node, correct};
use super::branch::Branch;
use super::follow::Continuation;
use super::half_branch::{End, HalfBranch, Limits};
use super::normal_form::null_vector;
use super::period_map::PeriodMap;
use super::point::BranchPoint;
use super::test_function::TestFunction;
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
        limits: &Limits,
        mut watch: impl FnMut(&BranchPoint) -> ControlFlow<()>,
    ) -> Result<Branch, OrbitError> {
        let doubled = self.over_periods(2 * self.shooting.periods);
        doubled.branch_from(flip, (-1.0, 2, End::Merged), limits, &mut watch)
    }

    /// The branch along the eigenvector of a critical multiplier of a point, of orbits with so many times its impacts, and why
    /// it ends at the point.
    pub(super) fn branch_from(
        &self,
        point: &BranchPoint,
        (multiplier, times, end): (f64, usize, End),
        limits: &Limits,
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
}
