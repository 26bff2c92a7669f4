//! Continuation of the orbits of a family along its parameter.

use std::ops::ControlFlow;

use nalgebra::{DVector, Vector2};

use super::Family;
use super::arclength::{Equations, Node, correct, correct_given};
use super::period_map::PeriodMap;
use super::point::BranchPoint;
use super::settings::ContinuationSettings;
use super::shooting::{Critical, Shooting};
use super::stepper::{CurveStep, Stepper};
use super::test_function::TestFunction;
use crate::direction::Direction;
use crate::orbit::{Monodromy, Orbit, OrbitError, StroboscopicMap};
use crate::tolerance::ROUNDING;
use softstop::SceneError;

/// A continuation: follows the orbits of a family over a number of drive periods.
#[derive(Debug)]
pub struct Continuation<'a> {
    pub(super) shooting: Shooting<'a, 1>,
    pub(super) settings: ContinuationSettings,
}

/// A branch seen at another section: a node of it, and the direction in which it goes on.
pub(super) struct SectionChange<'a> {
    pub continuation: Continuation<'a>,
    pub node: Node<PeriodMap>,
    pub along: DVector<f64>,
}

impl<'a> Continuation<'a> {
    /// A continuation of the orbits of `family` over `periods` drive periods.
    pub fn new(family: &'a dyn Family, periods: u64) -> Self {
        Self {
            shooting: Shooting::new(family, periods),
            settings: ContinuationSettings::default(),
        }
    }

    /// This continuation with steps of at most `largest`, in scaled unknowns: for visibly smooth curves.
    ///
    /// # Errors
    /// Those of [`ContinuationSettings::validate`].
    pub fn with_steps(self, largest: f64) -> Result<Self, SceneError> {
        let settings = ContinuationSettings {
            largest_step: largest,
            ..self.settings
        };
        self.with_settings(settings)
    }

    /// This continuation with other settings.
    ///
    /// # Errors
    /// Those of [`ContinuationSettings::validate`].
    pub fn with_settings(self, settings: ContinuationSettings) -> Result<Self, SceneError> {
        settings.validate()?;
        Ok(Self { settings, ..self })
    }

    /// This continuation by another shooting.
    fn with_shooting(&self, shooting: Shooting<'a, 1>) -> Self {
        Self {
            shooting,
            settings: self.settings,
        }
    }

    /// This continuation over another number of drive periods.
    pub(super) fn over_periods(&self, periods: u64) -> Self {
        self.with_shooting(self.shooting.seen_at(self.shooting.turn, periods))
    }

    /// This continuation with its section so many drive periods after drive angle phi.
    pub(super) fn with_turn(&self, turn: f64) -> Self {
        self.with_shooting(self.shooting.seen_at(turn, self.shooting.periods))
    }

    /// The point of a branch at `parameter` that Newton's method reaches from a state near it, stable or not.
    ///
    /// # Errors
    /// [`OrbitError`] if it does not settle.
    pub fn find_point(
        &self,
        parameter: f64,
        state: Vector2<f64>,
    ) -> Result<BranchPoint, OrbitError> {
        self.point_at(&self.correct_start(parameter, state)?)
    }

    /// The node at a parameter that Newton's method reaches from a state near it.
    pub(super) fn correct_start(
        &self,
        parameter: f64,
        state: Vector2<f64>,
    ) -> Result<Node<PeriodMap>, OrbitError> {
        let guess = self.shooting.scaled(state, [parameter]);
        correct_given(&self.shooting, &guess)
    }

    /// The direction of rising or falling parameters, in scaled unknowns.
    pub(super) fn direction_vector(direction: Direction) -> DVector<f64> {
        let way = match direction {
            Direction::Up => 1.0,
            Direction::Down => -1.0,
        };
        DVector::from_vec(vec![0.0, 0.0, way])
    }

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
            continuation.follow_here(begin, limit, (&mut points, &mut turned_at), &mut watch)
        })?;
        Ok(points)
    }

    /// Follows a branch from section to section, as far as `follow` says at each how it goes on.
    pub(super) fn follow_sections(
        &self,
        begin: (Node<PeriodMap>, &DVector<f64>),
        mut follow: impl FnMut(
            &Self,
            (Node<PeriodMap>, &DVector<f64>),
        ) -> Result<Option<SectionChange<'a>>, OrbitError>,
    ) -> Result<(), OrbitError> {
        let mut next = follow(self, begin)?;
        while let Some(SectionChange {
            continuation,
            node,
            along,
        }) = next
        {
            next = follow(&continuation, (node, &along))?;
        }
        Ok(())
    }

    /// Follows a branch as long as this section serves; then how it goes on, if it does.
    fn follow_here(
        &self,
        (node, along): (Node<PeriodMap>, &DVector<f64>),
        limit: usize,
        (points, turned_at): (&mut Vec<BranchPoint>, &mut usize),
        watch: &mut dyn FnMut(&BranchPoint) -> ControlFlow<()>,
    ) -> Result<Option<SectionChange<'a>>, OrbitError> {
        let sequence = node.here.point.sequence;
        let mut stepper =
            Stepper::new(&self.shooting, node, along, &self.settings)?.with_long_steps();
        while points.len() < limit {
            let continues = |node: &Node<PeriodMap>| node.here.point.sequence.continues(&sequence);
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

    /// Locates the orbit at which a test vanishes, by Newton's method for orbit and parameter together.
    ///
    /// # Errors
    /// [`OrbitError`] if it does not settle.
    pub fn locate(
        &self,
        near: &BranchPoint,
        test: TestFunction,
    ) -> Result<BranchPoint, OrbitError> {
        let plain = self.with_turn(0.0);
        let guess = plain.shooting.scaled(near.state(), [near.parameter]);
        let shooting = plain.shooting.seen_at(0.0, plain.shooting.periods);
        plain.point_at(&correct(&Critical { shooting, test }, &guess, None)?)
    }

    /// The full orbit at a point of a branch.
    ///
    /// # Errors
    /// [`OrbitError`] if the point is not on a z = 1 orbit.
    pub fn orbit_at(&self, point: &BranchPoint) -> Result<Orbit, OrbitError> {
        let scene = self.shooting.family.scene([point.parameter])?;
        let map = StroboscopicMap::new(&scene, self.shooting.periods);
        let passage = map.apply(point.state())?;
        Ok(Orbit::from_map(map.periods(), point.state(), passage))
    }

    /// The point of a branch at a node, as it is seen at drive angle phi.
    ///
    /// # Errors
    /// [`OrbitError`] if it cannot be carried there.
    pub(super) fn point_at(&self, node: &Node<PeriodMap>) -> Result<BranchPoint, OrbitError> {
        if self.shooting.turn != 0.0 {
            let at = self.carry_place(&node.at, -self.shooting.turn)?;
            let plain = self.with_turn(0.0);
            let here = plain.shooting.evaluate(&at)?;
            return plain.point_at(&Node { at, here });
        }
        // A quick node lies one step of Newton's method on from its round; beyond a wall a node lies by rounding alone.
        let (own, start) = (self.shooting.state_at(&node.at), node.here.point.start);
        let is_start = (own - start).norm() <= 4.0 * f64::EPSILON * start.norm();
        let state = if is_start { start } else { own };
        let [parameter] = self.shooting.parameters(&node.at);
        Ok(BranchPoint {
            parameter,
            position: state.x,
            velocity: state.y,
            impacts: node.here.point.impacts.clone(),
            monodromy: node.here.point.monodromy,
        })
    }

    /// The node at a point of a branch, as it is seen at this section.
    pub(super) fn node_at(&self, point: &BranchPoint) -> Result<Node<PeriodMap>, OrbitError> {
        let at = self.place_of(point)?;
        let here = self.shooting.evaluate(&at)?;
        Ok(Node { at, here })
    }
}

/// True if a step has not leapt to another piece of the branch: no test changes much, the sense does not change.
fn is_same_piece(stepper: &Stepper<'_, Shooting<'_, 1>>, step: &CurveStep<PeriodMap>) -> bool {
    let [from, to] = [&stepper.node, &step.node].map(|node| &node.here.point.monodromy);
    TestFunction::change_little(from, to, stepper.settings.max_test_change)
        && same_orientation((&stepper.direction, from), (&step.direction, to))
}

/// True if two tangents of a branch, each with the monodromy matrix there, have one orientation: along a branch the parameter's rate is
/// 1 - tr + det times a factor of constant sign, at corners as well, since that sign is the index of a fixed point of a continuous map.
pub(super) fn same_orientation(
    (from, before): (&DVector<f64>, &Monodromy),
    (to, after): (&DVector<f64>, &Monodromy),
) -> bool {
    let sense =
        |direction: &DVector<f64>, matrix| TestFunction::Fold.scaled_value(matrix) * direction[2];
    is_one_sense(sense(from, before), sense(to, after))
}

/// True if two senses of direction are one, or there is none.
pub(super) fn is_one_sense(from: f64, to: f64) -> bool {
    from * to >= 0.0 || from.abs().min(to.abs()) <= ROUNDING
}
