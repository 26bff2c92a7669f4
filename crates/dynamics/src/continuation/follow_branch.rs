//! Follows whole branches of orbits: in both directions, with every special point on the way, to where they end.

use std::ops::ControlFlow;

use nalgebra::{DVector, Vector2};

use super::branch::Branch;
use super::chord_and_cubic::passes_place;
use super::detect_branch_end::lies_beside_others;
use super::equations::{CurveNode, StepEnds};
use super::follow_curve::MIN_LOOP_POINTS;
use super::grazing_test::GrazingTest;
use super::half_branch::HalfBranch;
use super::locate_zero::locate_zero;
use super::period_map::PeriodMap;
use super::stepper::Stepper;
use super::stroboscopic_section::SectionChange;
use super::{BranchEnd, BranchLimits, BranchPoint, Continuation, SpecialKind, SpecialPoint};
use crate::direction::Direction;
use crate::orbit::OrbitError;
use crate::tolerance::SAME;

impl<'a> Continuation<'a> {
    /// The branch through the orbit near a state, towards falling and rising parameters, with every
    /// fold, flip, Neimark-Sacker point, pitchfork and grazing on it. `watch` sees each point as it comes, and the last
    /// one again whenever the next one was not reached by a step.
    ///
    /// # Errors
    /// [`OrbitError`] if there is no orbit to start from.
    pub fn branch(
        &self,
        parameter: f64,
        state: Vector2<f64>,
        limits: &BranchLimits,
        mut watch: impl FnMut(&BranchPoint) -> ControlFlow<()>,
    ) -> Result<Branch, OrbitError> {
        let start = self.correct_start(parameter, state)?;
        let minimal = self.minimal_period(&start);
        if minimal < self.shooting.periods {
            let shorter = self.over_periods(minimal);
            return shorter.branch(parameter, self.shooting.state_at(&start.at), limits, watch);
        }
        let up = self.follow_half(
            start.clone(),
            &Self::direction_vector(Direction::Up),
            limits,
            &mut watch,
        )?;
        let down = match up.end {
            BranchEnd::Closed => HalfBranch::empty(BranchEnd::Closed),
            _ => self.follow_half(
                start.clone(),
                &Self::direction_vector(Direction::Down),
                limits,
                &mut watch,
            )?,
        };
        self.join_halves(&start, down, up)
    }

    /// The drive periods after which an orbit really repeats.
    fn minimal_period(&self, node: &CurveNode<PeriodMap>) -> u64 {
        let periods = self.shooting.periods;
        let returns = |after: &u64| {
            let way =
                node.here.point.trajectory.at_cycle(*after) - self.shooting.state_at(&node.at);
            self.shooting.scaled_unknowns(way, [0.0]).norm() < SAME
        };
        (1..periods)
            .filter(|after| periods.is_multiple_of(*after))
            .find(returns)
            .unwrap_or(periods)
    }

    /// The branch of two halves, joined at their start.
    pub(super) fn join_halves(
        &self,
        start: &CurveNode<PeriodMap>,
        mut down: HalfBranch,
        up: HalfBranch,
    ) -> Result<Branch, OrbitError> {
        down.points.reverse();
        down.specials.reverse();
        down.points.push(self.point_at(start)?);
        down.points.extend(up.points);
        down.specials.extend(up.specials);
        Ok(Branch {
            periods: self.shooting.periods,
            points: down.points,
            specials: down.specials,
            ends: (down.end, up.end),
        })
    }

    /// Follows half a branch, in one direction from a node, from section to section.
    pub(super) fn follow_half(
        &self,
        start: CurveNode<PeriodMap>,
        along: &DVector<f64>,
        limits: &BranchLimits,
        watch: &mut dyn FnMut(&BranchPoint) -> ControlFlow<()>,
    ) -> Result<HalfBranch, OrbitError> {
        let mut way = HalfBranch::empty(BranchEnd::Points);
        let origin = self.point_at(&start)?;
        self.follow_sections((start, along), |continuation, begin| {
            continuation.follow_half_at_section(&mut way, begin, &origin, limits, watch)
        })?;
        Ok(way)
    }

    /// Follows half a branch as long as this section serves; then how it goes on, if it does.
    fn follow_half_at_section(
        &self,
        way: &mut HalfBranch,
        (start, along): (CurveNode<PeriodMap>, &DVector<f64>),
        origin: &BranchPoint,
        limits: &BranchLimits,
        watch: &mut dyn FnMut(&BranchPoint) -> ControlFlow<()>,
    ) -> Result<Option<SectionChange<'a>>, OrbitError> {
        let origin = self.unknowns_of(origin)?;
        let mut grazing_test = GrazingTest::of_node(&self.shooting, &start);
        let mut stepper = Stepper::new(&self.shooting, start, along, &self.settings)?;
        // Since the last corner, if one was passed.
        let mut goes_on = true;
        let lost = loop {
            if way.points.len() >= limits.points {
                return Ok(None);
            }
            if stepper.is_crawling() {
                break OrbitError::LOST;
            }
            let step = stepper.attempt_step().and_then(|step| {
                let ahead = GrazingTest::of_node(&self.shooting, &step.node);
                if !self.may_take_step(&stepper, &step, (&grazing_test, &ahead)) {
                    return Err(OrbitError::LOST);
                }
                let ends = (&stepper.node, &step.node);
                let specials = self.specials_on_step(ends)?;
                let end = self.record_step(way, ends, specials, &origin, limits)?;
                Ok((step, ahead, end))
            });
            match step {
                Ok((step, ahead, end)) => {
                    grazing_test = ahead.with_losses_on_step(&grazing_test, stepper.step);
                    stepper.step_to(step);
                    goes_on = true;
                    let stopped = way
                        .points
                        .last()
                        .is_some_and(|point| watch(point).is_break());
                    if let Some(end) = end.or(stopped.then_some(BranchEnd::Stopped)) {
                        way.end = end;
                        return Ok(None);
                    }
                }
                Err(error) => {
                    if watch(&self.point_at(&stepper.node)?).is_break() {
                        way.end = BranchEnd::Stopped;
                        return Ok(None);
                    }
                    if way.turned_at != Some(way.points.len())
                        && let Some(turned) = self.turn_section(&stepper.node, &stepper.direction)
                    {
                        way.turned_at = Some(way.points.len());
                        return Ok(Some(turned));
                    }
                    if way.end_in_grazing(self.grazing_end_ahead(&stepper, &grazing_test)) {
                        return Ok(None);
                    }
                    if stepper.shorten_step() {
                        continue;
                    }
                    let Some((node, along)) = self.beyond_corner(&stepper).filter(|_| goes_on)
                    else {
                        break error;
                    };
                    let step = (&stepper.node, &node);
                    let beyond = self.specials_of_corner(step).and_then(|specials| {
                        let ahead = GrazingTest::of_node(&self.shooting, &node);
                        let end = self.record_step(way, step, specials, &origin, limits)?;
                        let mut next =
                            Stepper::new(&self.shooting, node.clone(), &along, &self.settings)?;
                        next.step = self.settings.crawling_step;
                        Ok((end, ahead, next))
                    });
                    let (end, ahead, next) = match beyond {
                        Ok(beyond) => beyond,
                        Err(error) => break error,
                    };
                    if let Some(end) = end {
                        way.end = end;
                        return Ok(None);
                    }
                    (grazing_test, stepper, goes_on) = (ahead, next, false);
                }
            }
        };
        self.end_branch(way, &stepper, &grazing_test, limits, lost);
        Ok(None)
    }

    /// Records the end of a step and the special points on it, unless that fails; why the branch ends, if it does.
    fn record_step(
        &self,
        way: &mut HalfBranch,
        (from, to): StepEnds<'_, PeriodMap>,
        mut specials: Vec<SpecialPoint>,
        origin: &DVector<f64>,
        limits: &BranchLimits,
    ) -> Result<Option<BranchEnd>, OrbitError> {
        let closes =
            way.points.len() >= MIN_LOOP_POINTS && passes_place(&self.shooting, (from, to), origin);
        let bound = self.range_end_passed((from, to), limits);
        let merged = match bound {
            None => self.merging_point((from, to))?,
            Some(_) => None,
        };
        let (last, end) = match (bound, merged) {
            (Some((_, true)), _) => return Ok(Some(BranchEnd::Range)),
            (Some((bound, false)), _) => {
                let test =
                    |node: &CurveNode<PeriodMap>| self.shooting.parameters(&node.at)[0] - bound;
                let (node, _) = locate_zero(&self.shooting, (from, to), test)?;
                let counts = node.here.point.counts;
                let is_end =
                    |end: &&CurveNode<PeriodMap>| end.here.point.counts.has_same_jumps(&counts);
                if ![from, to].iter().any(is_end) {
                    return Err(OrbitError::LOST);
                }
                // Scaled unknowns may round its last digit.
                let parameter = bound;
                let last = BranchPoint {
                    parameter,
                    ..self.point_at(&node)?
                };
                (last, Some(BranchEnd::Range))
            }
            (None, Some((point, end))) => {
                // Beyond, the orbits are those before, half a period later, or have no gap.
                let gap_at = |node: &CurveNode<PeriodMap>| {
                    let gap = self.merging_gap(node);
                    gap.map_or(0.0, |gap| gap.norm())
                };
                let begins = gap_at(from);
                specials.retain(|special| {
                    let is_grazing = matches!(special.kind, SpecialKind::Grazing(_));
                    let gap = self
                        .node_at(&special.point)
                        .map_or(0.0, |node| gap_at(&node));
                    is_grazing && (SAME * begins..=begins).contains(&gap)
                });
                (point, Some(end))
            }
            (None, None) => (self.point_at(to)?, closes.then_some(BranchEnd::Closed)),
        };
        let special = specials.last().map(|special| &special.point);
        if let Some(before) = special.or(way.points.last())
            && [before, &last].map(lies_beside_others) == [true; 2]
        {
            return Err(OrbitError::NotIsolated);
        }
        let (low, high) = limits.range;
        specials.retain(|special| (low..=high).contains(&special.point.parameter));
        way.points
            .extend(specials.iter().map(|special| special.point.clone()));
        way.specials.extend(specials);
        way.points.push(last);
        Ok(end)
    }
}
