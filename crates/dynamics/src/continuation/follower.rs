//! Orbits of a family followed along its parameter.

use std::ops::ControlFlow;

use nalgebra::{DVector, Vector2};

use super::Family;
use super::arclength::{Equations, Node, correct, correct_at};
use super::locate::locate;
use super::point::BranchPoint;
use super::round::Round;
use super::shooting::{Critical, Shooting};
use super::test::Test;
use super::walker::{LARGEST_STEP, Walker};
use crate::orbit::{Orbit, OrbitError, StroboscopicMap};

/// Scaled distance along a branch to which special points are located.
pub(crate) const WIDTH: f64 = 1e-12;

/// Distance of a point from the chord between its neighbours, as a share of the chord, within which it is taken for
/// a point between them.
const ASIDE: f64 = 0.2;

/// Which way a branch is followed from its start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Heading {
    /// Towards rising parameters.
    Up,
    /// Towards falling parameters.
    Down,
}

/// Follows the orbits of a family over a number of drive periods.
#[derive(Debug)]
pub struct Follower<'a, F> {
    pub(super) shooting: Shooting<'a, F, 1>,
    pub(super) largest: f64,
}

/// A branch seen at another section: a node of it, and the direction in which it goes on.
pub(super) struct Turned<'a, F> {
    pub follower: Follower<'a, F>,
    pub node: Node<Round>,
    pub along: DVector<f64>,
}

impl<'a, F: Family> Follower<'a, F> {
    /// A follower of the orbits of `family` over `periods` drive periods.
    pub fn new(family: &'a F, periods: u64) -> Self {
        Self {
            shooting: Shooting::new(family, periods),
            largest: LARGEST_STEP,
        }
    }

    /// With steps of at most `largest`, in units of the family's scales: for curves without visible
    /// corners.
    #[must_use]
    pub fn with_steps(self, largest: f64) -> Self {
        Self { largest, ..self }
    }

    /// The same for another number of drive periods.
    pub(super) fn over(&self, periods: u64) -> Self {
        let follower = Self::new(self.shooting.family, periods).with_steps(self.largest);
        follower.with_turn(self.shooting.turn)
    }

    /// The same with its section so many drive periods after drive angle phi.
    pub(super) fn with_turn(&self, turn: f64) -> Self {
        let mut shooting = Shooting::new(self.shooting.family, self.shooting.periods);
        shooting.turn = turn.rem_euclid(shooting.periods as f64);
        Self {
            shooting,
            largest: self.largest,
        }
    }

    /// The orbit at `parameter`, stable or not, that Newton's method reaches from a state near it.
    ///
    /// # Errors
    /// [`OrbitError`] if it does not settle.
    pub fn point(&self, parameter: f64, state: Vector2<f64>) -> Result<BranchPoint, OrbitError> {
        self.point_at(&self.start(parameter, state)?)
    }

    pub(super) fn start(
        &self,
        parameter: f64,
        state: Vector2<f64>,
    ) -> Result<Node<Round>, OrbitError> {
        let guess = self.shooting.scaled(state, [parameter]);
        correct_at(&self.shooting, &guess)
    }

    /// The direction of rising or falling parameters.
    pub(super) fn direction(heading: Heading) -> DVector<f64> {
        let way = match heading {
            Heading::Up => 1.0,
            Heading::Down => -1.0,
        };
        DVector::from_vec(vec![0.0, 0.0, way])
    }

    /// The branch of z = 1 motions from an orbit at `parameter`, until `watch` stops it at its last point or `limit` points are there, or until it cannot be followed any
    /// farther even with the smallest step (where the regime ends).
    ///
    /// # Errors
    /// [`OrbitError`] if the start is not on a branch.
    pub fn follow(
        &self,
        start: &Orbit,
        parameter: f64,
        heading: Heading,
        limit: usize,
        mut watch: impl FnMut(&BranchPoint) -> ControlFlow<()>,
    ) -> Result<Vec<BranchPoint>, OrbitError> {
        let node = self.start(parameter, start.state())?;
        let mut points = vec![self.point_at(&node)?];
        let mut turned_at = 0;
        let mut next = Some(self.set_out(node, Self::direction(heading)));
        while let Some(Turned {
            follower,
            node,
            along,
        }) = next
        {
            next = follower.follow_on(
                (node, &along),
                limit,
                (&mut points, &mut turned_at),
                &mut watch,
            )?;
        }
        Ok(points)
    }

    /// The beginning of a branch, seen at this section.
    pub(super) fn set_out(&self, node: Node<Round>, along: DVector<f64>) -> Turned<'a, F> {
        Turned {
            follower: self.with_turn(self.shooting.turn),
            node,
            along,
        }
    }

    /// Follows a branch as long as this section serves; then how it goes on, if it does.
    fn follow_on(
        &self,
        (node, along): (Node<Round>, &DVector<f64>),
        limit: usize,
        (points, turned_at): (&mut Vec<BranchPoint>, &mut usize),
        watch: &mut impl FnMut(&BranchPoint) -> ControlFlow<()>,
    ) -> Result<Option<Turned<'a, F>>, OrbitError> {
        let sequence = node.here.point.sequence;
        let mut walker = Walker::new(&self.shooting, node, along, self.largest)?.quick();
        while points.len() < limit {
            match walker.attempt() {
                Ok(stride) if stride.node.here.point.sequence.goes_on(&sequence) => {
                    walker.take(stride);
                    let point = self.point_at(&walker.node)?;
                    let ends = watch(&point).is_break();
                    points.push(point);
                    if ends {
                        break;
                    }
                }
                _ => {
                    if *turned_at != points.len()
                        && let Some(turned) = self.turned(&walker.node, &walker.direction)
                    {
                        *turned_at = points.len();
                        return Ok(Some(turned));
                    }
                    if !walker.shorten() {
                        break;
                    }
                }
            }
        }
        Ok(None)
    }

    /// The point between two neighbours at which `test` changes its sign.
    ///
    /// # Errors
    /// [`OrbitError`] if a correction fails.
    pub fn locate(
        &self,
        from: &BranchPoint,
        to: &BranchPoint,
        test: impl Fn(&BranchPoint) -> f64,
    ) -> Result<BranchPoint, OrbitError> {
        let ends = (self.node_at(from)?, self.node_at(to)?);
        match self.clear_of(&ends.0).or_else(|| self.clear_of(&ends.1)) {
            None => self.locate_between((&ends.0, &ends.1), test),
            Some(clear) => clear.locate_between((&clear.node_at(from)?, &clear.node_at(to)?), test),
        }
    }

    fn locate_between(
        &self,
        ends: (&Node<Round>, &Node<Round>),
        test: impl Fn(&BranchPoint) -> f64,
    ) -> Result<BranchPoint, OrbitError> {
        let value = |node: &Node<Round>| self.point_at(node).map_or(f64::NAN, |point| test(&point));
        let (node, _) = locate(&self.shooting, ends, WIDTH, value)?;
        self.point_at(&node)
    }

    /// The point between two neighbours at a value of the parameter between theirs.
    ///
    /// # Errors
    /// [`OrbitError`] if a correction fails.
    pub fn between(
        &self,
        from: &BranchPoint,
        to: &BranchPoint,
        parameter: f64,
    ) -> Result<BranchPoint, OrbitError> {
        let ends = [from, to].map(|end| self.shooting.scaled(end.state(), [end.parameter]));
        let way = &ends[1] - &ends[0];
        let share = (parameter - from.parameter) / (to.parameter - from.parameter);
        let state = from.state().lerp(&to.state(), share);
        if let Ok(node) = self.start(parameter, state) {
            let along = way.dot(&(&node.at - &ends[0])) / way.norm_squared();
            let off = &node.at - &ends[0] - along * &way;
            let point = self.point_at(&node)?;
            let same_side = from.fold_test().signum() * point.fold_test().signum() > 0.0;
            if same_side && (0.0..=1.0).contains(&along) && off.norm() < ASIDE * way.norm() {
                return Ok(point);
            }
        }
        self.locate(from, to, |point| point.parameter - parameter)
    }

    /// The orbit at which a test vanishes, by Newton's method for orbit and parameter together.
    ///
    /// # Errors
    /// [`OrbitError`] if it does not settle.
    pub fn critical(&self, near: &BranchPoint, test: Test) -> Result<BranchPoint, OrbitError> {
        let critical = Critical {
            shooting: Shooting::<F, 1>::new(self.shooting.family, self.shooting.periods),
            test,
        };
        let guess = critical.shooting.scaled(near.state(), [near.parameter]);
        let plain = self.with_turn(0.0);
        plain.point_at(&correct(&critical, &guess, None)?)
    }

    /// The full orbit at a point.
    ///
    /// # Errors
    /// [`OrbitError`] if the point is not on a z = 1 orbit.
    pub fn orbit(&self, point: &BranchPoint) -> Result<Orbit, OrbitError> {
        let scene = self.shooting.family.scene([point.parameter])?;
        let map = StroboscopicMap::new(&scene, self.shooting.periods)?;
        let passage = map.apply(point.state())?;
        Orbit::on(&scene, &map, point.state(), &passage)
    }

    /// A node as it is seen at drive angle phi.
    ///
    /// # Errors
    /// [`OrbitError`] if it cannot be carried there.
    pub(super) fn point_at(&self, node: &Node<Round>) -> Result<BranchPoint, OrbitError> {
        if self.shooting.turn != 0.0 {
            let at = self.carried(&node.at, -self.shooting.turn)?;
            let plain = self.with_turn(0.0);
            let here = plain.shooting.evaluate(&at)?;
            return plain.point_at(&Node { at, here });
        }
        let state = node.here.point.start;
        let [parameter] = self.shooting.parameters(&node.at);
        Ok(BranchPoint {
            parameter,
            position: state.x,
            velocity: state.y,
            impacts: node.here.point.impacts.clone(),
            monodromy: node.here.point.monodromy,
        })
    }

    pub(super) fn node_at(&self, point: &BranchPoint) -> Result<Node<Round>, OrbitError> {
        let at = self.place(point)?;
        let here = self.shooting.evaluate(&at)?;
        Ok(Node { at, here })
    }
}
