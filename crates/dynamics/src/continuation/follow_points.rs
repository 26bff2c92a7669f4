//! Following the points of a branch in one direction in few long steps, without its special points.

use std::ops::ControlFlow;

use nalgebra::DVector;

use super::equations::CurveNode;
use super::period_map::PeriodMap;
use super::step_acceptance::is_same_piece;
use super::stepper::Stepper;
use super::stroboscopic_section::SectionChange;
use super::{BranchPoint, Continuation};
use crate::direction::Direction;
use crate::orbit::{Orbit, OrbitError};

impl<'a> Continuation<'a> {
    /// Follows the branch of z = 1 motions from an orbit at `parameter`, until `watch` stops it, `limit` points are
    /// there, or it cannot be followed any farther even with the smallest step (where the regime ends).
    ///
    /// # Errors
    /// [`OrbitError`] if the start is not on a branch.
    pub fn follow_points(
        &self,
        start: &Orbit,
        parameter: f64,
        direction: Direction,
        limit: usize,
        mut watch: impl FnMut(&BranchPoint) -> ControlFlow<()>,
    ) -> Result<Vec<BranchPoint>, OrbitError> {
        let node = self.correct_start(parameter, start.state())?;
        let mut points = vec![self.point_at(&node)?];
        let mut turned_at = 0;
        let along = Self::direction_vector(direction);
        self.follow_sections((node, &along), |continuation, begin| {
            continuation.follow_points_at_section(
                begin,
                limit,
                (&mut points, &mut turned_at),
                &mut watch,
            )
        })?;
        Ok(points)
    }

    /// Follows a branch as long as this section serves; then how it goes on, if it does.
    fn follow_points_at_section(
        &self,
        (node, along): (CurveNode<PeriodMap>, &DVector<f64>),
        limit: usize,
        (points, turned_at): (&mut Vec<BranchPoint>, &mut usize),
        watch: &mut dyn FnMut(&BranchPoint) -> ControlFlow<()>,
    ) -> Result<Option<SectionChange<'a>>, OrbitError> {
        let counts = node.here.point.counts;
        let mut stepper =
            Stepper::new(&self.shooting, node, along, &self.settings)?.with_long_steps();
        while points.len() < limit {
            let continues = |node: &CurveNode<PeriodMap>| node.here.point.counts.continues(&counts);
            let step = stepper.attempt_step().ok();
            let step = step.filter(|step| continues(&step.node) && is_same_piece(&stepper, step));
            let taken = step.and_then(|step| {
                let beyond = self.node_beyond_flips((&stepper.node, &step.node)).ok()?;
                let is_whole = beyond.as_ref().is_none_or(|(_, node)| continues(node));
                is_whole.then_some((beyond, step))
            });
            if let Some((beyond, step)) = taken {
                stepper.step_to(step);
                let beyond = beyond.iter().map(|(_, node)| node);
                for node in beyond.chain([&stepper.node]) {
                    let point = self.point_at(node)?;
                    let ends = watch(&point).is_break();
                    points.push(point);
                    if ends {
                        return Ok(None);
                    }
                }
                continue;
            }
            if *turned_at != points.len()
                && let Some(turned) = self.turn_section(&stepper.node, &stepper.direction)
            {
                *turned_at = points.len();
                return Ok(Some(turned));
            }
            if !stepper.shorten_step() {
                break;
            }
        }
        Ok(None)
    }
}
