//! Continuation of the orbits of a family along its parameter.

use nalgebra::{DVector, Vector2};

use super::continuation_settings::ContinuationSettings;
use super::equations::{CurveNode, Equations};
use super::newton_corrector::{correct, correct_with_fixed_parameter};
use super::period_map::PeriodMap;
use super::stroboscopic_shooting::{CriticalShooting, Shooting};
use super::{BranchPoint, Family, TestFunction};
use crate::direction::Direction;
use crate::orbit::{Orbit, OrbitError, StroboscopicMap};
use softstop::SceneError;

/// A continuation: follows the orbits of a family over a number of drive periods.
#[derive(Debug)]
pub struct Continuation<'a> {
    pub(super) shooting: Shooting<'a, 1>,
    pub(super) settings: ContinuationSettings,
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
        self.with_shooting(self.shooting.with_section(self.shooting.turn, periods))
    }

    /// This continuation with its section `turn` drive periods after drive angle phi.
    pub(super) fn with_turn(&self, turn: f64) -> Self {
        self.with_shooting(self.shooting.with_section(turn, self.shooting.periods))
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
    ) -> Result<CurveNode<PeriodMap>, OrbitError> {
        let guess = self.shooting.scaled_unknowns(state, [parameter]);
        correct_with_fixed_parameter(&self.shooting, &guess)
    }

    /// The direction of rising or falling parameters, in scaled unknowns.
    pub(super) fn direction_vector(direction: Direction) -> DVector<f64> {
        let way = match direction {
            Direction::Up => 1.0,
            Direction::Down => -1.0,
        };
        DVector::from_vec(vec![0.0, 0.0, way])
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
        let guess = plain
            .shooting
            .scaled_unknowns(near.state(), [near.parameter]);
        let shooting = plain.shooting.with_section(0.0, plain.shooting.periods);
        plain.point_at(&correct(
            &CriticalShooting { shooting, test },
            &guess,
            None,
        )?)
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
    pub(super) fn point_at(&self, node: &CurveNode<PeriodMap>) -> Result<BranchPoint, OrbitError> {
        if self.shooting.turn != 0.0 {
            let at = self.carry_unknowns(&node.at, -self.shooting.turn)?;
            let plain = self.with_turn(0.0);
            let here = plain.shooting.evaluate(&at)?;
            return plain.point_at(&CurveNode { at, here });
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
    pub(super) fn node_at(&self, point: &BranchPoint) -> Result<CurveNode<PeriodMap>, OrbitError> {
        let at = self.unknowns_of(point)?;
        let here = self.shooting.evaluate(&at)?;
        Ok(CurveNode { at, here })
    }
}
