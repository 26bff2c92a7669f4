//! Points between two neighbours of a branch.

use std::ops::ControlFlow;

use super::chord_and_cubic::along_chord;
use super::equations::{CurveNode, StepEnds};
use super::locate_zero::{locate_zero, solve_zero};
use super::period_map::PeriodMap;
use super::{BranchLimits, BranchPoint, Continuation, MAX_CHORD_DISTANCE, TestFunction};
use crate::orbit::OrbitError;
use crate::tolerance::ROUNDING;

/// Most points that a branch is followed through between two neighbours.
const MAX_WALK_POINTS: usize = 200;

impl Continuation<'_> {
    /// The point between two neighbours of a branch at which a test of the monodromy matrix vanishes.
    ///
    /// # Errors
    /// [`OrbitError`] if a correction fails.
    pub(crate) fn critical_between(
        &self,
        from: &BranchPoint,
        to: &BranchPoint,
        test: TestFunction,
    ) -> Result<BranchPoint, OrbitError> {
        self.find_at_clear_section(from, to, |continuation, ends| {
            continuation.critical_between_nodes(ends, test)
        })
    }

    /// Finds a point between two neighbours of a branch, seen at a section with no crossing near.
    fn find_at_clear_section(
        &self,
        from: &BranchPoint,
        to: &BranchPoint,
        find: impl Fn(&Self, StepEnds<'_, PeriodMap>) -> Result<BranchPoint, OrbitError>,
    ) -> Result<BranchPoint, OrbitError> {
        let ends = (self.node_at(from)?, self.node_at(to)?);
        match self
            .with_clear_section(&ends.0)
            .or_else(|| self.with_clear_section(&ends.1))
        {
            None => find(self, (&ends.0, &ends.1)),
            Some(clear) => find(&clear, (&clear.node_at(from)?, &clear.node_at(to)?)),
        }
    }

    /// The point between two nodes at which a test vanishes.
    fn critical_between_nodes(
        &self,
        ends: StepEnds<'_, PeriodMap>,
        test: TestFunction,
    ) -> Result<BranchPoint, OrbitError> {
        let value = |round: &PeriodMap| test.scaled_value(&round.monodromy);
        let node = solve_zero(&self.shooting, ends, value).or_else(|_| {
            let value = |node: &CurveNode<PeriodMap>| value(&node.here.point);
            locate_zero(&self.shooting, ends, value).map(|(node, _)| node)
        })?;
        self.point_at(&node)
    }

    /// The point between two nodes at a value of the parameter.
    fn point_at_parameter_on_step(
        &self,
        ends: StepEnds<'_, PeriodMap>,
        parameter: f64,
    ) -> Result<BranchPoint, OrbitError> {
        let value = |node: &CurveNode<PeriodMap>| self.shooting.parameters(&node.at)[0] - parameter;
        let (node, _) = locate_zero(&self.shooting, ends, value)?;
        self.point_at(&node)
    }

    /// The point of a branch between two neighbours at a value of the parameter between theirs.
    ///
    /// # Errors
    /// [`OrbitError`] if a correction fails.
    pub(crate) fn point_between(
        &self,
        from: &BranchPoint,
        to: &BranchPoint,
        parameter: f64,
    ) -> Result<BranchPoint, OrbitError> {
        let share = (parameter - from.parameter) / (to.parameter - from.parameter);
        let state = from.state().lerp(&to.state(), share);
        if let Ok(node) = self.correct_start(parameter, state) {
            let point = self.point_at(&node)?;
            if self.is_between((from, to), &point) {
                return Ok(point);
            }
        }
        let located = self.find_at_clear_section(from, to, |continuation, ends| {
            continuation.point_at_parameter_on_step(ends, parameter)
        });
        match located {
            Ok(point) if (point.parameter - parameter).abs() <= ROUNDING * parameter.abs() => {
                Ok(point)
            }
            other => {
                let lost = other.err().unwrap_or(OrbitError::LOST);
                self.follow_to(from, to, parameter).ok_or(lost)
            }
        }
    }

    /// The point between two neighbours, followed from one of them where no guess between them leads to it.
    fn follow_to(
        &self,
        from: &BranchPoint,
        to: &BranchPoint,
        parameter: f64,
    ) -> Option<BranchPoint> {
        [from, to].into_iter().find_map(|end| {
            let limits = BranchLimits {
                range: (parameter.min(end.parameter), parameter.max(end.parameter)),
                points: MAX_WALK_POINTS,
            };
            let go_on = |_: &BranchPoint| ControlFlow::Continue(());
            let branch = self
                .branch(end.parameter, end.state(), &limits, go_on)
                .ok()?;
            let reached = |point: &BranchPoint| {
                point.parameter == parameter && self.is_between((from, to), point)
            };
            branch.points.into_iter().find(reached)
        })
    }

    /// True if a point lies beside the chord between two neighbours of a branch, and on their side of a fold.
    fn is_between(&self, (from, to): (&BranchPoint, &BranchPoint), point: &BranchPoint) -> bool {
        let place = |point: &BranchPoint| {
            self.shooting
                .scaled_unknowns(point.state(), [point.parameter])
        };
        let (begin, way) = (place(from), place(to) - place(from));
        let (along, off) = along_chord((&begin, &way), &place(point));
        let same_side = from.fold_test().signum() * point.fold_test().signum() > 0.0;
        same_side && (0.0..=1.0).contains(&along) && off < MAX_CHORD_DISTANCE * way.norm()
    }
}
