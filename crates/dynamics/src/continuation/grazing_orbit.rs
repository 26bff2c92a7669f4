//! Orbits that graze a surface: with the touch at their beginning, all that follows is smooth.
//!
//! Near grazing the map over whole periods has a derivative without bounds (saltation with 1/v), but
//! the orbit that just touches solves a regular system: from rest at a surface at a drive angle, over
//! whole periods back to it, the last arc taken on as if the stop were not there. (Arclength and Newton near
//! grazing: arXiv 2506.18379, arXiv 2510.16218.)

use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector, Vector2};

use super::Family;
use super::arclength::{Equations, Evaluation, Node};
use super::face::Face;
use super::period_map::carry_on;
use super::shooting::round_off;
use crate::orbit::{Monodromy, OrbitError, PassageRecorder};
use softstop::{Arc, Clock, Crossing, Instant, Observer, Scene};

/// Grazing orbits of a family, in unknowns: drive angle of the touch, scaled parameters.
#[derive(Debug)]
pub(crate) struct GrazingOrbit<'a, F, const N: usize> {
    pub family: &'a F,
    pub periods: u64,
    /// Crossings of the orbit, the touch left out.
    pub crossings: usize,
    /// The surface that is touched.
    pub face: Face,
}

/// A grazing orbit.
#[derive(Debug, Clone)]
pub(crate) struct GrazingPoint {
    /// Jacobian of the map as if the stop were not there, from touch to touch.
    pub monodromy: Monodromy,
    /// Before-impact velocities in m/s, that of the touch left out.
    pub impacts: Vec<f64>,
}

/// The orbit does not cross as often as it should, or there is no such surface.
const LOST: OrbitError = OrbitError::Diverged {
    residual: f64::INFINITY,
};

impl<F: Family<N>, const N: usize> GrazingOrbit<'_, F, N> {
    pub fn scaled(&self, angle: f64, parameters: [f64; N]) -> DVector<f64> {
        let spans = self.family.parameter_scales();
        let scaled = parameters
            .iter()
            .zip(spans)
            .map(|(value, span)| value / span);
        DVector::from_iterator(1 + N, [angle].into_iter().chain(scaled))
    }

    pub fn parameters(&self, at: &DVector<f64>) -> [f64; N] {
        let spans = self.family.parameter_scales();
        std::array::from_fn(|index| at[1 + index] * spans[index])
    }

    /// The scene with time 0 at the touch, and the state there.
    fn scene(&self, at: &DVector<f64>) -> Result<(Scene, Vector2<f64>), OrbitError> {
        let mut scene = self.family.scene(self.parameters(at))?;
        scene.excitation.phase = at[0];
        let position = self.face.position(&scene).ok_or(LOST)?;
        Ok((scene, Vector2::new(position, 0.0)))
    }

    /// How far a motion from a touch is from it after its periods, scaled, and what an observer has seen on the way.
    fn around<O: Observer + Default>(
        &self,
        scene: &Scene,
        touch: Vector2<f64>,
    ) -> Result<(DVector<f64>, O), OrbitError> {
        let mut motion = scene.motion(touch.into())?;
        let until = Clock::at_cycle(self.periods);
        let mut watch = LastArc::new(*motion.clock(), self.crossings, until, O::default());
        // What comes after the last crossing of the orbit is not looked at: without the touch the mass may
        // bounce without end.
        motion.advance(until, &mut watch)?;
        motion.tell_arc(&mut watch);
        let drift = watch.found.ok_or(LOST)? - touch;
        let [length, speed] = self.family.state_scales();
        let residual = DVector::from_vec(vec![drift.x / length, drift.y / speed]);
        Ok((residual, watch.seen))
    }

    /// The state of a grazing orbit at time 0 of its family's scene.
    pub fn state(&self, node: &Node<GrazingPoint>) -> Result<Vector2<f64>, OrbitError> {
        let parameters = self.parameters(&node.at);
        let phase = self.family.scene(parameters)?.excitation.phase;
        let (scene, touch) = self.scene(&node.at)?;
        let turn = std::f64::consts::TAU;
        let touched = ((node.at[0] - phase) / turn).rem_euclid(self.periods as f64);
        let mut motion = scene.motion(touch.into())?;
        let clock = *motion.clock();
        let duration = (self.periods as f64 - touched) * clock.period();
        for period in 1..=duration.div_euclid(clock.period()) as u64 {
            carry_on(&mut motion, Clock::at_cycle(period), &mut ())?;
        }
        carry_on(&mut motion, clock.instant(duration), &mut ())?;
        Ok(motion.state().into())
    }
}

impl<F: Family<N>, const N: usize> Equations for GrazingOrbit<'_, F, N> {
    type Point = GrazingPoint;
    const EXACT: usize = 0;

    fn evaluate(&self, at: &DVector<f64>) -> Result<Evaluation<GrazingPoint>, OrbitError> {
        let (scene, touch) = self.scene(at)?;
        let (residual, seen) = self.around::<PassageRecorder>(&scene, touch)?;
        let monodromy = Monodromy::from(&seen.tangent);
        let impacts = seen.impacts.iter();
        let impacts = impacts.map(|it| it.before_impact_velocity).collect();
        Ok(Evaluation {
            residual,
            tolerance: round_off(&scene, &touch, &monodromy, self.family.state_scales()),
            point: GrazingPoint { monodromy, impacts },
        })
    }

    fn beside(
        &self,
        _: &GrazingPoint,
        at: &DVector<f64>,
    ) -> Result<(DVector<f64>, bool), OrbitError> {
        let (scene, touch) = self.scene(at)?;
        Ok((self.around::<()>(&scene, touch)?.0, true))
    }

    fn jacobian(&self, _: &Evaluation<GrazingPoint>, slopes: &DMatrix<f64>) -> DMatrix<f64> {
        slopes.clone()
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
}

impl<O: Observer> LastArc<O> {
    pub fn new(clock: Clock, crossings: usize, until: Instant, seen: O) -> Self {
        Self {
            clock,
            left: crossings,
            until,
            seen,
            found: None,
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
