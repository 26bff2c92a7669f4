//! Orbits seen from a surface: they begin there, and their last arc is taken back to it as if the surface were not there.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use nalgebra::{DVector, Vector2};

use super::Family;
use super::face::Face;
use super::period_map::carry_through;
use super::point::Graze;
use super::sequence::Sequence;
use crate::orbit::{Monodromy, OrbitError};
use softstop::{Arc, Clock, Crossing, Instant, Observer, Scene};

/// Where orbits of a family begin and end: at a surface.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ImpactSection<'a, F, const N: usize> {
    pub family: &'a F,
    pub periods: u64,
    /// Crossings of an orbit between its begin and its last arc.
    pub crossings: usize,
    /// The surface.
    pub face: Face,
}

/// An orbit seen from a surface.
#[derive(Debug, Clone)]
pub(crate) struct SectionPoint {
    /// Jacobian of the map from just before the surface to there; of an orbit that grazes it, as if it were not there.
    pub monodromy: Monodromy,
    /// Before-impact velocities in m/s, that at the surface first; that of a touch is left out.
    pub impacts: Vec<f64>,
    /// True if an orbit that does not graze meets the surface before its last arc comes back to it.
    pub is_cut: bool,
}

impl SectionPoint {
    /// What the orbit crosses, as far as that may change along a curve.
    pub fn sequence(&self) -> Sequence {
        Sequence {
            impacts: self.impacts.len(),
            surfaces: usize::from(self.is_cut),
            ..Sequence::default()
        }
    }
}

/// The orbit does not cross as often as it should, or there is no such surface.
const NO_CROSSING: OrbitError = OrbitError::Diverged {
    residual: f64::INFINITY,
};

impl<'a, F: Family<N>, const N: usize> ImpactSection<'a, F, N> {
    /// The surface that an orbit grazes.
    pub fn at(graze: &Graze, (family, periods): (&'a F, u64)) -> Self {
        Self {
            family,
            periods,
            crossings: graze.crossings,
            face: graze.face,
        }
    }

    /// Unknowns of an orbit: its drive angle at the section and what else it has there, then the parameters, scaled.
    pub fn unknowns(&self, places: &[f64], parameters: [f64; N]) -> DVector<f64> {
        let scaled = parameters.into_iter().zip(self.family.parameter_scales());
        let scaled = scaled.map(|(value, scale)| value / scale);
        DVector::from_iterator(places.len() + N, places.iter().copied().chain(scaled))
    }

    /// The parameters, which are the last of the unknowns.
    pub fn parameters(&self, at: &DVector<f64>) -> [f64; N] {
        let scales = self.family.parameter_scales();
        std::array::from_fn(|index| at[at.len() - N + index] * scales[index])
    }

    /// The scene with time 0 at the section, where the drive has this angle, and the position of the surface.
    pub fn scene(&self, angle: f64, parameters: [f64; N]) -> Result<(Scene, f64), OrbitError> {
        let mut scene = self.family.scene(parameters)?;
        scene.excitation.phase = angle;
        let position = self.face.position(&scene).ok_or(NO_CROSSING)?;
        Ok((scene, position))
    }

    /// How far a motion from a state at the section is from it after its periods, in units of the family's scales, and what
    /// an observer has seen on the way.
    pub fn around<O: Observer + Default>(
        &self,
        scene: &Scene,
        start: Vector2<f64>,
    ) -> Result<(Vector2<f64>, LastArc<O>), OrbitError> {
        let mut motion = scene.motion(start.into())?;
        let until = Clock::at_cycle(self.periods);
        let mut watch = LastArc::new(*motion.clock(), self.crossings, until, O::default());
        // What comes after the last crossing of the orbit is not looked at: without the surface the mass may
        // bounce without end.
        motion.advance(until, &mut watch)?;
        motion.tell_arc(&mut watch);
        let drift = watch.found.ok_or(NO_CROSSING)? - start;
        let [length, speed] = self.family.state_scales();
        Ok((Vector2::new(drift.x / length, drift.y / speed), watch))
    }

    /// The state at time 0 of the family's scene of an orbit with these unknowns, that leaves the section with a velocity.
    pub fn state(&self, at: &DVector<f64>, velocity: f64) -> Result<Vector2<f64>, OrbitError> {
        let (angle, parameters) = (at[0], self.parameters(at));
        let phase = self.family.scene(parameters)?.excitation.phase;
        let (scene, position) = self.scene(angle, parameters)?;
        let gone = ((angle - phase) / TAU).rem_euclid(self.periods as f64);
        let mut motion = scene.motion(Vector2::new(position, velocity).into())?;
        let clock = *motion.clock();
        let duration = (self.periods as f64 - gone) * clock.period();
        carry_through(&mut motion, clock.instant(duration), &mut ())?;
        Ok(motion.state().into())
    }
}

/// Takes the arc after a number of crossings on to the end, whether or not something comes in between, and lets another
/// observer see the motion so.
pub(crate) struct LastArc<O> {
    clock: Clock,
    left: usize,
    until: Instant,
    pub seen: O,
    /// State in the end.
    pub found: Option<Vector2<f64>>,
    /// True if something comes in between, more than rounding before the end.
    pub is_cut: bool,
}

/// Share of the last arc that rounding may leave of it.
const ROUNDING: f64 = 1e-6;

impl<O: Observer> LastArc<O> {
    pub fn new(clock: Clock, crossings: usize, until: Instant, seen: O) -> Self {
        Self {
            clock,
            left: crossings,
            until,
            seen,
            found: None,
            is_cut: false,
        }
    }

    /// Takes an arc on to the end. A series holds no farther than its law: another arc goes on from its end. A mass that is held
    /// touches nothing: it gives no end.
    fn extend(&mut self, arc: &Arc<'_>, lasts: f64) {
        let elapsed = self.clock.elapsed(arc.start, self.until);
        if lasts < elapsed && arc.course.is_series() {
            return self.seen.arc(arc, lasts);
        }
        if arc.course.is_held() {
            return;
        }
        let drive = self.clock.drive(self.until);
        let (position, velocity) = arc.course.at(elapsed, drive);
        self.seen.arc(arc, elapsed);
        self.is_cut = lasts < (1.0 - ROUNDING) * elapsed;
        self.found = Some(Vector2::new(position, velocity));
    }
}

impl<O: Observer> Observer for LastArc<O> {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        match (self.left, self.found) {
            (0, None) => self.extend(arc, elapsed),
            (0, Some(_)) => {}
            _ => self.seen.arc(arc, elapsed),
        }
    }

    fn crossing(&mut self, crossing: &Crossing) {
        if self.found.is_none() {
            self.seen.crossing(crossing);
            self.left = self.left.saturating_sub(1);
        }
    }

    fn progress(&mut self, _: u64) -> ControlFlow<()> {
        if self.found.is_some() {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}
