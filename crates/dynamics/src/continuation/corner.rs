//! Corners of a branch: values at which the state at drive angle phi lies on a surface.
//!
//! The orbit crosses the surface as before, only at drive angle phi. But where the force jumps there, so does the
//! acceleration, and the state at that angle changes its direction along the branch; at a rigid wall it jumps
//! from before the impact to after it. No short step of a smooth curve leads over that. Seen at another drive angle
//! the same branch is smooth: there the orbit is found at a value just beyond, and then looked at where
//! it was left.

use std::f64::consts::TAU;

use nalgebra::{DVector, Vector2};

use super::Family;
use super::arclength::{Equations, Node, Stride, Walker, correct, tangent};
use super::caution::SHORT;
use super::face::Face;
use super::follower::Follower;
use super::round::{Round, carry_on};
use super::shooting::Shooting;
use crate::orbit::OrbitError;
use softstop::{Clock, MotionError, Scene};

/// Distance of the surface, in units of the step that fails before it, within which it is the reason.
const REACH: f64 = 10.0;
/// Scaled distances beyond it at which the branch is looked for: far from where differences see both sides.
const BEYOND: [f64; 3] = [1e-3, 1e-2, 1e-4];
/// Drive angles at which the branch is smooth, from phi on: one of them is off all surfaces.
const TURNS: [f64; 3] = [0.5 * TAU, 0.25 * TAU, 0.75 * TAU];

/// A family with another drive angle at time 0.
struct Turned<'a, F> {
    family: &'a F,
    angle: f64,
}

impl<F: Family> Family for Turned<'_, F> {
    fn scene(&self, parameters: [f64; 1]) -> Result<Scene, MotionError> {
        let mut scene = self.family.scene(parameters)?;
        scene.excitation.phase += self.angle;
        Ok(scene)
    }

    fn state_scales(&self) -> [f64; 2] {
        self.family.state_scales()
    }

    fn parameter_scales(&self) -> [f64; 1] {
        self.family.parameter_scales()
    }
}

impl<F: Family> Follower<'_, F> {
    /// A node beyond the surface at which a walker cannot go on; none if there is none.
    pub(super) fn over_corner(
        &self,
        walker: &Walker<'_, Shooting<'_, F, 1>>,
    ) -> Option<Stride<Round>> {
        if walker.step > SHORT {
            return None;
        }
        let scene = self.shooting.scene(&walker.node.at).ok()?;
        let (face, gap) = self.face_ahead(walker, &scene)?;
        let wall = scene.wall().map(|wall| wall.position);
        let rebounds = face.position(&scene) == wall;
        let mut found = TURNS
            .into_iter()
            .flat_map(|angle| BEYOND.map(|beyond| (angle, beyond)))
            .filter_map(|(angle, beyond)| {
                let away = gap + beyond.copysign(walker.direction[0]);
                self.beyond(walker, angle, away).ok()
            });
        let node = found.find(|node| {
            let same = node.here.point.sequence == walker.node.here.point.sequence;
            let way = node.at[0] - walker.node.at[0];
            same && (rebounds || way * walker.direction[0] > 0.0)
        })?;
        // The position goes on evenly, unless it is thrown back.
        let mut along = DVector::zeros(node.at.len());
        along[0] = node.at[0] - walker.node.at[0];
        let onward = tangent(&self.shooting, &node, &along.normalize()).ok()?;
        Some(Stride::onto(node, onward))
    }

    /// The surface just ahead and its scaled distance.
    fn face_ahead(
        &self,
        walker: &Walker<'_, Shooting<'_, F, 1>>,
        scene: &Scene,
    ) -> Option<(Face, f64)> {
        let gap = |face: Face| {
            let gap = self.shooting.scaled_position(face.position(scene)?) - walker.node.at[0];
            let is_ahead = gap * walker.direction[0] >= 0.0 && gap.abs() < REACH * walker.step;
            is_ahead.then_some((face, gap))
        };
        let faces = Face::ALL.into_iter().filter_map(gap);
        faces.min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
    }

    /// The orbit a scaled distance of the position on, found at another drive angle.
    fn beyond(
        &self,
        walker: &Walker<'_, Shooting<'_, F, 1>>,
        angle: f64,
        away: f64,
    ) -> Result<Node<Round>, OrbitError> {
        let periods = self.shooting.periods;
        let family = Turned {
            family: self.shooting.family,
            angle,
        };
        let turned = Shooting::<_, 1>::new(&family, periods);
        let share = angle / TAU;
        let state = self.shooting.state(&walker.node.at);
        let there = after(&self.shooting.scene(&walker.node.at)?, state, share)?;
        let mut guess = turned.scaled(there, self.shooting.parameters(&walker.node.at));
        guess[2] += away * walker.direction[2] / walker.direction[0];
        let mut axis = DVector::zeros(guess.len());
        axis[2] = 1.0;
        let found = correct(&turned, &guess, Some(&axis))?;
        let rest = periods as f64 - share;
        let back: Vector2<f64> = after(&turned.scene(&found.at)?, turned.state(&found.at), rest)?;
        let at = self.shooting.scaled(back, turned.parameters(&found.at));
        let here = self.shooting.evaluate(&at)?;
        Ok(Node { at, here })
    }
}

/// The state so many drive periods after time 0.
fn after(scene: &Scene, state: Vector2<f64>, periods: f64) -> Result<Vector2<f64>, MotionError> {
    let mut motion = scene.motion(state.into())?;
    for period in 1..=periods as u64 {
        carry_on(&mut motion, Clock::at_cycle(period), &mut ())?;
    }
    let clock = *motion.clock();
    carry_on(
        &mut motion,
        clock.instant(periods * clock.period()),
        &mut (),
    )?;
    Ok(motion.state().into())
}
