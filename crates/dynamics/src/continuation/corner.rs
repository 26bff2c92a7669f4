//! Corners of a branch: its continuation past one, and the special points on it.
//!
//! At a corner an orbit gains or loses a touch that jumps no force but a derivative (the damper of a stop that sets in, a spring
//! that becomes another): the branch goes on in another direction, and its multipliers jump. (Leine and Nijmeijer 2004, ch. 8:
//! the nonsmooth fold and flip.)

use nalgebra::DVector;

use super::equations::{CurveNode, Equations, StepEnds};
use super::newton_corrector::{correct, curve_tangent};
use super::period_map::PeriodMap;
use super::step_acceptance::same_orientation;
use super::stepper::Stepper;
use super::stroboscopic_shooting::Shooting;
use super::{Continuation, SpecialKind, SpecialPoint, TestFunction};
use crate::orbit::OrbitError;

/// Scaled distances beyond a corner at which the branch is taken up.
const CORNER_DISTANCES: [f64; 4] = [1e-7, 1e-6, 1e-5, 1e-4];
/// How many times as far the branch beyond a corner, and the touch, may lie as they are looked for.
const CORNER_REACH: f64 = 10.0;

impl Continuation<'_> {
    /// A node beyond the corner just ahead, and the direction in which the branch goes on from it. Whether the force jumps
    /// at the touch plays no part: the map is continuous there, so that fixed points go on from it one way alone, which
    /// their index tells, and no other branch comes as near.
    pub(super) fn beyond_corner(
        &self,
        stepper: &Stepper<'_, Shooting<'_, 1>>,
    ) -> Option<(CurveNode<PeriodMap>, DVector<f64>)> {
        let node = &stepper.node;
        CORNER_DISTANCES.into_iter().find_map(|reach| {
            let at = &node.at + reach * &stepper.direction;
            let here = self.shooting.evaluate(&at).ok()?;
            let counts = here.point.counts;
            if counts == node.here.point.counts {
                return None;
            }
            let guess = CurveNode { at, here };
            let (along, _) = curve_tangent(&self.shooting, &guess, &stepper.direction).ok()?;
            [along.clone(), -along].into_iter().find_map(|along| {
                let ahead = &node.at + reach * &along;
                let found = correct(&self.shooting, &ahead, Some(&along)).ok()?;
                let near = (&found.at - &node.at).norm() < CORNER_REACH * reach;
                let goes_on = same_orientation(
                    (&stepper.direction, &node.here.point.monodromy),
                    (&along, &found.here.point.monodromy),
                );
                let is_beyond = found.here.point.counts == counts;
                (near && is_beyond && goes_on).then_some((found, along))
            })
        })
    }

    /// The special points of a corner between two nodes: the touch, and the tests that jump through zero.
    pub(super) fn specials_of_corner(
        &self,
        (from, to): StepEnds<'_, PeriodMap>,
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
        let (touches, _) = self.grazings_near_step((from, to), CORNER_REACH, |_| false)?;
        found.extend(touches.into_iter().map(|(_, special)| special));
        Ok(found)
    }
}
