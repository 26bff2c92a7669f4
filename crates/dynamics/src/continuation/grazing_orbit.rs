//! Orbits that graze a surface: with the touch at their beginning, all that follows is smooth.
//!
//! Near grazing the map over whole periods has a derivative without bounds (saltation with 1/v), but
//! the orbit that just touches solves a regular system: from rest at a surface at a drive angle, over
//! whole periods back to it, the last arc taken on as if the stop were not there. (Arclength and Newton near
//! grazing: arXiv 2506.18379, arXiv 2510.16218.)

use nalgebra::{DMatrix, DVector, Vector2};

use super::Family;
use super::arclength::{Equations, Evaluation, Node};
use super::impact_section::ImpactSection;
use super::point::Graze;
use super::shooting::round_off;
use crate::orbit::{Monodromy, OrbitError, PassageRecorder};

/// Grazing orbits of a family, in unknowns: drive angle of the touch, scaled parameters.
#[derive(Debug)]
pub(crate) struct GrazingOrbit<'a, F, const N: usize> {
    /// The surface that is touched, and the crossings of the orbit, the touch left out.
    pub section: ImpactSection<'a, F, N>,
}

/// A grazing orbit.
#[derive(Debug, Clone)]
pub(crate) struct GrazingPoint {
    /// Jacobian of the map as if the stop were not there, from touch to touch.
    pub monodromy: Monodromy,
    /// Before-impact velocities in m/s, that of the touch left out.
    pub impacts: Vec<f64>,
}

impl<F: Family<N>, const N: usize> GrazingOrbit<'_, F, N> {
    pub fn scaled(&self, angle: f64, parameters: [f64; N]) -> DVector<f64> {
        let spans = self.section.family.parameter_scales();
        let scaled = parameters
            .iter()
            .zip(spans)
            .map(|(value, span)| value / span);
        DVector::from_iterator(1 + N, [angle].into_iter().chain(scaled))
    }

    pub fn parameters(&self, at: &DVector<f64>) -> [f64; N] {
        let spans = self.section.family.parameter_scales();
        std::array::from_fn(|index| at[1 + index] * spans[index])
    }

    /// The state at time 0 of the family's scene.
    pub fn state(&self, at: &DVector<f64>) -> Result<Vector2<f64>, OrbitError> {
        self.section.state(at[0], 0.0, self.parameters(at))
    }

    /// The touch, as of a crossing that dies.
    pub fn graze(&self, node: &Node<GrazingPoint>) -> Graze {
        Graze {
            angle: node.at[0],
            impacts: node.here.point.impacts.len(),
            dies: true,
            face: self.section.face,
            crossings: self.section.crossings,
        }
    }

    /// How far the velocity at a touch moves the position at the next, without units.
    pub fn recurrence(&self, point: &GrazingPoint) -> f64 {
        let [length, speed] = self.section.family.state_scales();
        point.monodromy.m12 * speed / length
    }
}

impl<F: Family<N>, const N: usize> Equations for GrazingOrbit<'_, F, N> {
    type Point = GrazingPoint;
    const EXACT: usize = 0;

    fn evaluate(&self, at: &DVector<f64>) -> Result<Evaluation<GrazingPoint>, OrbitError> {
        let (scene, position) = self.section.scene(at[0], self.parameters(at))?;
        let touch = Vector2::new(position, 0.0);
        let (drift, around) = self.section.around::<PassageRecorder>(&scene, touch)?;
        let monodromy = Monodromy::from(&around.seen.tangent);
        let impacts = around.seen.impacts.iter();
        let impacts = impacts.map(|it| it.before_impact_velocity).collect();
        let sizes = self.section.family.state_scales();
        Ok(Evaluation {
            residual: DVector::from_column_slice(drift.as_slice()),
            tolerance: round_off(&scene, &touch, &monodromy, sizes),
            point: GrazingPoint { monodromy, impacts },
        })
    }

    fn beside(
        &self,
        _: &GrazingPoint,
        at: &DVector<f64>,
    ) -> Result<(DVector<f64>, bool), OrbitError> {
        let (scene, position) = self.section.scene(at[0], self.parameters(at))?;
        let (drift, _) = self
            .section
            .around::<()>(&scene, Vector2::new(position, 0.0))?;
        Ok((DVector::from_column_slice(drift.as_slice()), true))
    }

    fn jacobian(&self, _: &Evaluation<GrazingPoint>, slopes: &DMatrix<f64>) -> DMatrix<f64> {
        slopes.clone()
    }
}
