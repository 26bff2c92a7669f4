//! Impact sections: orbits seen from a surface at which they begin, and to which their last arc is taken back.

use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::sync::Arc as Shared;

use nalgebra::{DVector, Vector2};

use super::Family;
use super::face::Face;
use super::period_map::{half_way, state_after};
use super::point::Graze;
use super::sequence::Sequence;
use super::shooting::is_symmetric;
use crate::monitor::stop_if;
use crate::orbit::{Monodromy, OrbitError};
use crate::tolerance::{NEAR, ROUNDING};
use softstop::{
    Arc, CheckedScene, Clock, Crossing, CrossingKind, Instant, Observer, Start, Trajectory,
};

/// An impact section of a family: the surface at which its orbits begin and end.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ImpactSection<'a, const N: usize> {
    pub family: &'a dyn Family<N>,
    pub periods: u64,
    /// Crossings of an orbit between its begin and its last arc.
    pub crossings: usize,
    /// The surface.
    pub face: Face,
    /// True of orbits that are their own mirror images: they come back to the mirror image of the surface after half of their
    /// periods.
    pub is_symmetric: bool,
}

/// An orbit seen from an impact section.
#[derive(Debug, Clone)]
pub(crate) struct SectionPoint {
    /// The unknowns that it belongs to.
    pub place: DVector<f64>,
    /// The orbit around from the section.
    pub motion: Shared<Trajectory>,
    /// Jacobian of the map from just before the surface to there; of an orbit that grazes it, as if it were not there.
    pub monodromy: Monodromy,
    /// Before-impact velocities in m/s, that at the surface first; that of a touch is left out.
    pub impacts: Vec<f64>,
    /// How far the velocity at the surface moves the position at the end of the way around, without units.
    pub response: f64,
    /// True if the last arc meets something before it comes back to the surface: there is no such orbit.
    pub is_cut: bool,
}

impl SectionPoint {
    /// What the orbit crosses, as far as that may change along a curve.
    pub fn crossing_sequence(&self) -> Sequence {
        Sequence {
            impacts: self.impacts.len(),
            surfaces: usize::from(self.is_cut),
            ..Sequence::default()
        }
    }
}

/// The error of an orbit that does not cross as often as it should, or of a scene without the surface or the symmetry.
const NO_CROSSING: OrbitError = OrbitError::Diverged {
    residual: f64::INFINITY,
};

impl<'a, const N: usize> ImpactSection<'a, N> {
    /// The section at the surface that an orbit grazes.
    pub fn of_graze(graze: &Graze, (family, periods): (&'a dyn Family<N>, u64)) -> Self {
        Self {
            family,
            periods,
            crossings: match graze.is_symmetric {
                true => graze.crossings / 2,
                false => graze.crossings,
            },
            face: graze.face,
            is_symmetric: graze.is_symmetric,
        }
    }

    /// Unknowns of an orbit at the section: its drive angle and what else it has there, then the parameters, scaled.
    pub fn scaled_unknowns(&self, places: &[f64], parameters: [f64; N]) -> DVector<f64> {
        let scaled = self.family.scaled_parameters(parameters);
        DVector::from_iterator(places.len() + N, places.iter().copied().chain(scaled))
    }

    /// The parameters of these unknowns, which are the last of them.
    pub fn parameters(&self, at: &DVector<f64>) -> [f64; N] {
        self.family.unscaled_parameters(at.as_slice())
    }

    /// The scene with time 0 at the section, where the drive has this angle, and the position of the surface.
    pub fn scene_at(
        &self,
        angle: f64,
        parameters: [f64; N],
    ) -> Result<(CheckedScene, f64), OrbitError> {
        let scene = self.family.scene(parameters)?.at_phase(angle)?;
        if self.is_symmetric && !is_symmetric(&scene) {
            return Err(OrbitError::NotAlike);
        }
        let position = self.face.face_position(&scene).ok_or(NO_CROSSING)?;
        Ok((scene, position))
    }

    /// Carries a motion around from the section: how far it is off when it comes back, scaled, and the motion.
    pub fn carry_around(
        &self,
        scene: &CheckedScene,
        start: Vector2<f64>,
    ) -> Result<(Vector2<f64>, LastArc), OrbitError> {
        let until = match self.is_symmetric {
            true => half_way(scene, self.periods),
            false => Clock::at_cycle(self.periods),
        };
        let around = LastArc::carry_past(scene, start, (self.crossings, until))?;
        let drift = self.scaled_drift(start, around.motion.end.into());
        Ok((drift, around))
    }

    /// How far the end of the way around is from its start, or from the mirror image of that, scaled; of changes of both as well.
    pub fn scaled_drift(&self, start: Vector2<f64>, end: Vector2<f64>) -> Vector2<f64> {
        let side = if self.is_symmetric { -1.0 } else { 1.0 };
        let scales = Vector2::from(self.family.state_scales());
        (side * end - start).component_div(&scales)
    }

    /// The state at time 0 of the family's scene of an orbit that leaves the section with a velocity.
    pub fn state(&self, at: &DVector<f64>, velocity: f64) -> Result<Vector2<f64>, OrbitError> {
        let (angle, parameters) = (at[0], self.parameters(at));
        let phase = self.family.scene(parameters)?.excitation.phase;
        let (scene, position) = self.scene_at(angle, parameters)?;
        let gone = ((angle - phase) / TAU).rem_euclid(self.periods as f64);
        let begin = Vector2::new(position, velocity);
        let (left, half) = (self.periods as f64 - gone, 0.5 * self.periods as f64);
        Ok(match self.is_symmetric && left > half {
            true => -state_after(&scene, begin, left - half)?,
            false => state_after(&scene, begin, left)?,
        })
    }
}

/// A motion whose arc after a number of crossings is carried to the end, whether or not something comes in between.
pub(crate) struct LastArc {
    /// The motion, which ends with that arc.
    pub motion: Trajectory,
    /// True if another surface comes in between, or something else, and not as near to the end as a touch.
    pub is_cut: bool,
    /// Distance of the surface from the middle: on the other side it is the mirror image.
    touched: f64,
    left: usize,
    until: Instant,
    is_found: bool,
}

impl LastArc {
    /// The motion of a scene up to an instant, its last arc carried past what comes in between.
    ///
    /// # Errors
    /// [`OrbitError`] if it does not cross as often, or cannot be computed.
    pub fn carry_past(
        scene: &CheckedScene,
        start: Vector2<f64>,
        (crossings, until): (usize, Instant),
    ) -> Result<Self, OrbitError> {
        let mut motion = scene.motion(start.into())?;
        let mut around = Self {
            motion: Trajectory::empty(scene),
            is_cut: false,
            touched: start.x.abs(),
            left: crossings,
            until,
            is_found: false,
        };
        // What comes after the last crossing of the orbit is not looked at: without the surface the mass may
        // bounce without end.
        motion.advance(until, &mut around)?;
        motion.tell_arc(&mut around);
        around.is_found.then_some(around).ok_or(NO_CROSSING)
    }

    /// Extends an arc to the end, a series no farther than its law; a mass that is held gives no end.
    fn extend_arc(&mut self, arc: &Arc<'_>, lasts: f64) {
        let elapsed = arc.clock.elapsed(arc.start, self.until);
        if lasts < elapsed && arc.course.is_series() || arc.course.is_held() {
            return self.motion.arc(arc, lasts);
        }
        self.motion.arc(arc, elapsed);
        let (position, velocity) = arc.course.state_at(elapsed, arc.clock.drive(self.until));
        self.motion.end = Start::new(position, velocity);
        self.is_cut = lasts < (1.0 - NEAR) * elapsed;
        self.is_found = true;
    }
}

impl Observer for LastArc {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        match (self.left, self.is_found) {
            (0, false) => self.extend_arc(arc, elapsed),
            (0, true) => {}
            _ => self.motion.arc(arc, elapsed),
        }
    }

    fn crossing(&mut self, crossing: &Crossing) {
        if self.is_found {
            let is_at_surface = matches!(
                crossing.kind,
                CrossingKind::Surface { .. } | CrossingKind::Rebound { .. }
            );
            let scale = self.motion.scene.scales().length + self.touched;
            let apart = (crossing.position.abs() - self.touched).abs();
            self.is_cut |= is_at_surface && apart > ROUNDING * scale;
        } else {
            self.motion.crossing(crossing);
            self.left = self.left.saturating_sub(1);
        }
    }

    fn progress(&mut self, _: u64) -> ControlFlow<()> {
        stop_if(self.is_found)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;
    use softstop::{Clock, Piercing, Ratios};

    use super::LastArc;

    /// Without drive and damping a mass that leaves the stop from rest is back after the natural period, through the strip
    /// 1e-6 before the stop: it is cut unless that counts as a crossing of the orbit.
    #[test]
    fn a_strip_right_before_the_stop_cuts() {
        let mut scene = Ratios::loaded().at_frequency(1.0).scene().expect("valid");
        scene.piercing = Some(Piercing {
            thickness: 1e-6,
            travel: 0.0,
            ..Piercing::PAPER
        });
        (scene.excitation.amplitude, scene.damping) = (0.0, 0.0);
        scene.contact_damping = 0.0;
        let start = Vector2::new(scene.stop_position(), 0.0);
        let scene = scene.check().expect("valid");
        for (crossings, is_cut) in [(1, true), (2, false)] {
            let around = LastArc::carry_past(&scene, start, (crossings, Clock::at_cycle(1)));
            assert_eq!(around.expect("a motion").is_cut, is_cut, "{crossings}");
        }
    }
}
