//! How the outputs of a machine answer to a small change: exact derivatives in one direction, across
//! whatever crossings lie between.

use super::saltation;
use crate::error::MotionError;
use crate::flow::Variation;
use crate::integrator::{Arc, Crossing, CrossingKind, Motion, Observer, Simulation, Start};
use crate::scene::Scene;

/// A small change of state and external force at the beginning of the last advance: the direction of [`Sensitivity`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Perturbation {
    /// Change of the position, in m.
    pub position: f64,
    /// Change of the velocity, in m/s.
    pub velocity: f64,
    /// Change of the external force from there on, in N.
    pub force: f64,
}

/// The derivatives of the present outputs along the direction.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Sensitivity {
    /// Derivative of the position, in m.
    pub position: f64,
    /// Derivative of the velocity, in m/s.
    pub velocity: f64,
    /// Derivative of the acceleration, in m/s^2.
    pub acceleration: f64,
    /// Derivative of the contact force, in N.
    pub contact_force: f64,
    /// Derivative of the mechanical energy, in J.
    pub mechanical: f64,
    /// Derivative of the energy supplied, in J.
    pub supplied: f64,
    /// Derivative of the energy dissipated, in J.
    pub dissipated: f64,
    /// Derivative of the time of the last impact, in s; 0 if it was before the last advance.
    pub impact_time: f64,
    /// Derivative of its before-impact velocity, in m/s.
    pub impact_velocity: f64,
}

impl Simulation {
    /// The derivatives of the present outputs along a direction of change at the beginning of the last
    /// advance (or where [`Simulation::set_checkpoint`] was called since). Crossings are passed with their
    /// saltation matrices; at a graze, where the derivative does not exist, it is huge.
    ///
    /// # Errors
    /// [`MotionError`] if the stretch cannot be gone through again.
    pub fn sensitivity(&self, by: &Perturbation) -> Result<Sensitivity, MotionError> {
        let (scene, now) = (self.scene(), self.motion());
        let mut motion = self.motion_at_checkpoint();
        let stored = energy_change(scene, &motion, by.position, by.velocity);
        let mut watch = SensitivityRecorder {
            mass: scene.mass,
            force: by.force,
            position: by.position,
            velocity: by.velocity,
            ..SensitivityRecorder::default()
        };
        motion.advance_like(now, &mut watch)?;
        if motion.elapsed() > 0.0 {
            motion.tell_arc(&mut watch);
        }
        let mechanical = energy_change(scene, now, watch.position, watch.velocity);
        let (acceleration, contact_force) = watch.force_changes(scene, now);
        Ok(Sensitivity {
            position: watch.position,
            velocity: watch.velocity,
            acceleration,
            contact_force,
            mechanical,
            supplied: watch.supplied,
            dissipated: watch.supplied - (mechanical - stored),
            impact_time: watch.impact.0,
            impact_velocity: watch.impact.1,
        })
    }
}

/// Change in J of the mechanical energy with that of the state.
fn energy_change(scene: &Scene, motion: &Motion, position: f64, velocity: f64) -> f64 {
    let Start {
        position: x,
        velocity: v,
    } = motion.state();
    let elastic = scene.stiffness * x + motion.store().force_at(x);
    scene.mass * v * velocity + elastic * position
}

/// Carries a change along a motion.
#[derive(Debug, Default)]
struct SensitivityRecorder {
    mass: f64,
    force: f64,
    position: f64,
    velocity: f64,
    supplied: f64,
    /// Push in N at the end of the last arc.
    forcing: f64,
    /// Changes of the time and the velocity of the last impact.
    impact: (f64, f64),
}

impl Observer for SensitivityRecorder {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let by = Variation {
            position: self.position,
            velocity: self.velocity,
            forcing: self.force / self.mass,
        };
        let law = arc.phase.map_or(0.0, |phase| phase.law.force / self.mass);
        self.supplied += self.mass * arc.course.supply_variation(elapsed, by, law);
        self.forcing = self.mass * (arc.course.forcing_at(elapsed) - law);
        (self.position, self.velocity) = arc.course.state_variation(elapsed, by);
    }

    fn crossing(&mut self, crossing: &Crossing) {
        let (v, a) = (crossing.velocity, crossing.acceleration_before);
        let later = match crossing.kind {
            CrossingKind::Surface { .. } | CrossingKind::Rebound { .. } if v != 0.0 => {
                -self.position / v
            }
            _ => 0.0,
        };
        if crossing.impact_velocity().is_some() {
            let side = 1f64.copysign(v);
            self.impact = (later, side * (self.velocity + a * later));
        }
        // The forcing works on another velocity from an impact on that comes later.
        self.supplied += self.forcing * (v - crossing.velocity_after) * later;
        let after = saltation(crossing) * nalgebra::Vector2::new(self.position, self.velocity);
        (self.position, self.velocity) = (after.x, after.y);
    }
}

impl SensitivityRecorder {
    /// Changes of acceleration and contact force.
    fn force_changes(&self, scene: &Scene, motion: &Motion) -> (f64, f64) {
        let Some(phase) = motion.phase() else {
            return (0.0, self.force - scene.stiffness * self.position);
        };
        let Start { position, velocity } = motion.state();
        let (stiffness, damping) = phase.slopes(position, velocity);
        let resisting = stiffness * self.position + damping * self.velocity;
        let free = scene.stiffness * self.position + scene.damping * self.velocity;
        ((self.force - resisting) / self.mass, resisting - free)
    }
}
