//! Orbits seen from a surface at which they begin, and to which their last arc is taken back.

use std::ops::ControlFlow;
use std::sync::Arc as Shared;

use nalgebra::{DVector, Vector2};

use super::crossing_counts::CrossingCounts;
use crate::monitor::stop_if;
use crate::orbit::{Monodromy, OrbitError};
use crate::tolerance::{NEAR, ROUNDING};
use softstop::{Arc, CheckedScene, Crossing, CrossingKind, Instant, Observer, Start, Trajectory};

/// An orbit seen from an impact section.
#[derive(Debug, Clone)]
pub(crate) struct ImpactSectionOrbit {
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

impl ImpactSectionOrbit {
    /// What the orbit crosses, as far as that may change along a curve.
    pub fn crossing_counts(&self) -> CrossingCounts {
        CrossingCounts {
            impacts: self.impacts.len(),
            surface_crossings: usize::from(self.is_cut),
            ..CrossingCounts::default()
        }
    }
}

/// The error of an orbit that does not cross as often as it should, or of a scene without the surface or the symmetry.
pub(super) const NO_CROSSING: OrbitError = OrbitError::Diverged {
    residual: f64::INFINITY,
};

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
    use softstop::{Clock, Ratios, Strip};

    use super::LastArc;

    /// Without drive and damping a mass that leaves the stop from rest is back after the natural period, through the strip
    /// 1e-6 before the stop: it is cut unless that counts as a crossing of the orbit.
    #[test]
    fn a_strip_right_before_the_stop_cuts() {
        let mut scene = Ratios::loaded().at_frequency(1.0).scene().expect("valid");
        scene.piercing = Some(Strip {
            thickness: 1e-6,
            travel: 0.0,
            ..Strip::PAPER
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
