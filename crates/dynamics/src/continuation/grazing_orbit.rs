//! Grazing orbits, which touch a surface: with the touch at their beginning, all that follows is smooth.
//!
//! Near grazing the map over whole periods has a derivative without bounds (saltation with 1/v), but
//! the orbit that just touches solves a regular system: from rest at a surface at a drive angle, over
//! whole periods back to it, the last arc taken on as if the stop were not there. (Arclength and Newton near
//! grazing: arXiv 2506.18379, arXiv 2510.16218.)

use nalgebra::{DVector, Vector2};

use super::Family;
use super::arclength::{Equations, Evaluation, Node};
use super::impact_section::{ImpactSection, SectionPoint};
use super::point::Graze;
use super::shooting::round_off;
use crate::orbit::{Monodromy, OrbitError};

/// Grazing orbits of a family, in unknowns: drive angle of the touch, scaled parameters.
#[derive(Debug)]
pub(crate) struct GrazingOrbit<'a, F, const N: usize> {
    /// The surface that is touched, and the crossings of the orbit, the touch left out.
    pub section: ImpactSection<'a, F, N>,
}

impl<F: Family<N>, const N: usize> GrazingOrbit<'_, F, N> {
    /// The touch of a grazing orbit, as of a crossing that dies.
    pub fn graze_at(&self, node: &Node<SectionPoint>) -> Graze {
        Graze {
            angle: node.at[0],
            impacts: node.here.point.impacts.len(),
            dies: true,
            face: self.section.face,
            crossings: self.section.crossings,
        }
    }

    /// Response of a grazing orbit: how far the velocity at a touch moves the position at the next, without units.
    pub fn touch_response(&self, point: &SectionPoint) -> f64 {
        let [length, speed] = self.section.family.state_scales();
        point.monodromy.m12 * speed / length
    }
}

impl<F: Family<N>, const N: usize> Equations for GrazingOrbit<'_, F, N> {
    type Point = SectionPoint;

    fn evaluate(&self, at: &DVector<f64>) -> Result<Evaluation<SectionPoint>, OrbitError> {
        let (scene, position) = self.section.scene_at(at[0], self.section.parameters(at))?;
        let touch = Vector2::new(position, 0.0);
        let (drift, around) = self.section.carry_around(&scene, touch)?;
        let monodromy = Monodromy::from(&around.motion.tangent());
        let impacts = around.motion.impacts();
        let impacts = impacts.map(|it| it.before_impact_velocity).collect();
        let sizes = self.section.family.state_scales();
        Ok(Evaluation {
            residual: DVector::from_column_slice(drift.as_slice()),
            tolerance: round_off(&scene, &touch, &monodromy, sizes),
            point: SectionPoint {
                monodromy,
                impacts,
                is_cut: false,
            },
        })
    }

    fn residual(&self, at: &DVector<f64>) -> Result<DVector<f64>, OrbitError> {
        let (scene, position) = self.section.scene_at(at[0], self.section.parameters(at))?;
        let touch = Vector2::new(position, 0.0);
        let (drift, _) = self.section.carry_around(&scene, touch)?;
        Ok(DVector::from_column_slice(drift.as_slice()))
    }
}
