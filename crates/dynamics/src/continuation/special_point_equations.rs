//! The systems of equations whose solutions are curves of special points in two parameters.

use nalgebra::{DVector, Vector2};

use super::crossing_counts::CrossingCounts;
use super::equations::{CurveNode, Equations};
use super::impact_section_orbit::ImpactSectionOrbit;
use super::impact_section_system::ImpactSectionSystem;
use super::newton_corrector::correct;
use super::period_map::PeriodMap;
use super::stroboscopic_shooting::CriticalShooting;
use super::{CodimensionTwo, CurvePoint, Family, TestFunction};
use crate::orbit::{Monodromy, OrbitError};

/// A system whose solutions are special points in two parameters, its last two unknowns: it makes a curve.
pub(super) trait SpecialPointEquations: Equations {
    /// The machines of the curve of special points, and the drive periods of its orbits.
    fn family_and_periods(&self) -> (&dyn Family<2>, u64);
    /// The test that vanishes on the curve of special points; none on one of grazing.
    fn critical_test(&self) -> Option<TestFunction>;
    /// The state of the special orbit at time 0 for these unknowns.
    fn state_at(&self, at: &DVector<f64>) -> Result<Vector2<f64>, OrbitError>;
    /// The before-impact velocities of the orbit of a point, its Jacobian, and what it crosses.
    fn orbit_of(point: &Self::Point) -> (&[f64], Monodromy, CrossingCounts);

    /// Values of the two parameters of these unknowns of a special point.
    fn parameters(&self, at: &DVector<f64>) -> [f64; 2] {
        let (family, _) = self.family_and_periods();
        family.unscaled_parameters(at.as_slice())
    }

    /// The point of the curve at a node.
    fn curve_point(&self, node: &CurveNode<Self::Point>) -> Result<CurvePoint, OrbitError> {
        let state = self.state_at(&node.at)?;
        let (impacts, monodromy, _) = Self::orbit_of(&node.here.point);
        Ok(CurvePoint {
            parameters: self.parameters(&node.at),
            position: state.x,
            velocity: state.y,
            impacts: impacts.to_vec(),
            monodromy,
        })
    }

    /// The test of resonant grazing at a node of a curve of grazing; none on other curves.
    fn resonance_test(&self, node: &CurveNode<Self::Point>) -> Option<(CodimensionTwo, f64)> {
        let _ = node;
        None
    }

    /// The resonant grazing in which a curve of grazings ends within a step from a node, if it does.
    fn resonant_grazing_within_step(
        &self,
        node: &CurveNode<Self::Point>,
        step: &DVector<f64>,
    ) -> Option<(CodimensionTwo, CurvePoint)> {
        let _ = (node, step);
        None
    }
}

impl SpecialPointEquations for CriticalShooting<'_, 2> {
    fn family_and_periods(&self) -> (&dyn Family<2>, u64) {
        (self.shooting.family, self.shooting.periods)
    }

    fn critical_test(&self) -> Option<TestFunction> {
        Some(self.test)
    }

    fn state_at(&self, at: &DVector<f64>) -> Result<Vector2<f64>, OrbitError> {
        Ok(self.shooting.state_at(at))
    }

    fn orbit_of(round: &PeriodMap) -> (&[f64], Monodromy, CrossingCounts) {
        (&round.impacts, round.monodromy, round.counts)
    }
}

impl SpecialPointEquations for ImpactSectionSystem<'_, 2> {
    fn family_and_periods(&self) -> (&dyn Family<2>, u64) {
        (self.family, self.periods)
    }

    fn critical_test(&self) -> Option<TestFunction> {
        self.critical_test()
    }

    fn state_at(&self, at: &DVector<f64>) -> Result<Vector2<f64>, OrbitError> {
        self.state(at)
    }

    fn orbit_of(point: &ImpactSectionOrbit) -> (&[f64], Monodromy, CrossingCounts) {
        (&point.impacts, point.monodromy, point.crossing_counts())
    }

    fn resonance_test(
        &self,
        node: &CurveNode<ImpactSectionOrbit>,
    ) -> Option<(CodimensionTwo, f64)> {
        if self.critical_test().is_some() {
            return None;
        }
        let scene = self.scene_at(0.0, self.parameters(&node.at));
        let is_hard = scene.is_ok_and(|(scene, _)| self.surface.has_square_root(&scene));
        let value = node.here.point.response;
        let kind = CodimensionTwo::ResonantGrazing(self.grazing_touch_at(node));
        Some((kind, if is_hard { value } else { 0.0 }))
    }

    fn resonant_grazing_within_step(
        &self,
        node: &CurveNode<ImpactSectionOrbit>,
        step: &DVector<f64>,
    ) -> Option<(CodimensionTwo, CurvePoint)> {
        self.critical_test()?;
        let (velocity, change) = (node.at[1], step[1]);
        if velocity + change > 0.0 {
            return None;
        }
        let (resonant, guess) =
            self.resonant_grazing_system(&(&node.at - step * (velocity / change)));
        let found = correct(&resonant, &guess, None).ok()?;
        let is_near = (&found.at - node.at.clone().remove_row(1)).norm() <= step.norm();
        let kind = CodimensionTwo::ResonantGrazing(resonant.grazing_touch_at(&found));
        let point = is_near.then(|| resonant.curve_point(&found).ok());
        Some((kind, point.flatten()?))
    }
}
