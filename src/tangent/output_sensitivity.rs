//! How the outputs of a machine answer to a small change: exact derivatives in one direction, across
//! whatever crossings lie between.

use super::saltation;
use crate::error::MotionError;
use crate::flow::{Polynomial, Variation};
use crate::integrator::{
    Arc, Crossing, CrossingKind, Impact, Instant, Motion, Observer, Simulation, Start,
    contact_peak, force_from_derivatives,
};
use crate::phases::PhaseKind;
use crate::scene::Scene;

/// Share of a peak by which it may miss one that it goes on from, at the beginning of an arc.
const MAX_RELATIVE_PEAK_GAP: f64 = 1e-9;
/// Share of an arc over which the curvature of the contact force at its top is taken.
const RELATIVE_TOP_WIDTH: f64 = 1e-4;

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
    /// Derivatives of time and velocity of the first impact of the stretch; zeros without one.
    pub first: Impact,
    /// Derivatives of time and velocity of its hardest impact.
    pub hardest: Impact,
    /// Derivative of the largest contact force of the stretch, in N; NaN where a peak begins as bounces end.
    pub peak: f64,
    /// Derivative of the integral of the contact force, in N s.
    pub impulse: f64,
    /// Derivative of the work of the force that was asked for, in J.
    pub work: f64,
}

impl Simulation {
    /// The derivatives of the present outputs along a direction of change at the beginning of the last
    /// advance (or where [`Simulation::set_checkpoint`] was called since). Crossings are passed with their
    /// saltation matrices; at a graze, where the derivative does not exist, it is huge. `force` is the part of the external
    /// force whose work is asked for, by its derivatives there as in [`Simulation::set_force`]: value in N, rate in N/s, and so on.
    ///
    /// # Errors
    /// Those of [`Simulation::set_force`]; [`MotionError`] if the stretch cannot be gone through again.
    pub fn sensitivity(
        &self,
        by: &Perturbation,
        force: &[f64],
    ) -> Result<Sensitivity, MotionError> {
        let force = &force_from_derivatives(force)?;
        let (scene, now) = (self.scene(), self.motion());
        let mut motion = self.motion_at_checkpoint();
        let stored = energy_change(scene, &motion, by.position, by.velocity);
        let (from, start) = (motion.now(), motion.state());
        let mut watch = OutputSensitivityRecorder {
            scene,
            from,
            working_force: force,
            force: by.force,
            position: by.position,
            velocity: by.velocity,
            found: Sensitivity::default(),
            forcing: 0.0,
            crossing_delay: 0.0,
            position_integral: 0.0,
            hardest: None,
            peak: 0.0,
            end_rate: None,
        };
        motion.advance_like(now, &mut watch)?;
        if motion.elapsed() > 0.0 {
            motion.tell_arc(&mut watch);
        }
        let (position, velocity) = (watch.position, watch.velocity);
        let mechanical = energy_change(scene, now, position, velocity);
        let (acceleration, contact_force) = watch.force_changes(scene, now);
        let elapsed = motion.clock().elapsed(from, now.now());
        let (position_change, velocity_change) = (position - by.position, velocity - by.velocity);
        // m x'' + b1 x' + k1 x + F = forcing, and the work f x less the integral of f' x; the position does not jump.
        let resisted = scene.stiffness * watch.position_integral
            + scene.damping * position_change
            + scene.mass * velocity_change;
        let end_work = force.value_at(elapsed) * position - force.value() * by.position;
        let travel = now.state().position - start.position;
        Ok(Sensitivity {
            position,
            velocity,
            acceleration,
            contact_force,
            mechanical,
            dissipated: watch.found.supplied - (mechanical - stored),
            impulse: by.force * elapsed - resisted,
            work: watch.found.work + end_work + by.force * travel,
            ..watch.found
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

/// An observer that carries a small change of state and force along a motion.
struct OutputSensitivityRecorder<'a> {
    scene: &'a Scene,
    from: Instant,
    /// The force whose work is asked for.
    working_force: &'a Polynomial,
    force: f64,
    position: f64,
    velocity: f64,
    found: Sensitivity,
    /// Forcing in N at the end of the last arc.
    forcing: f64,
    /// Change in s of the time of the crossing that an arc begins with, if it does.
    crossing_delay: f64,
    /// Change of the integral of the position, in m s.
    position_integral: f64,
    /// Velocity in m/s of the hardest impact so far.
    hardest: Option<f64>,
    /// Largest contact force in N so far.
    peak: f64,
    /// Rate of that force in N/s, if it is the one at the end of the last arc.
    end_rate: Option<f64>,
}

impl Observer for OutputSensitivityRecorder<'_> {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let mass = self.scene.mass;
        let by = Variation {
            position: self.position,
            velocity: self.velocity,
            forcing: self.force / mass,
        };
        let law = arc.phase.map_or(0.0, |phase| phase.law.force / mass);
        self.found.supplied += mass * arc.course.supply_variation(elapsed, by, law);
        self.forcing = mass * (arc.course.forcing_at(elapsed) - law);
        let since = arc.clock.elapsed(self.from, arc.start);
        let span = ((-since).max(0.0), elapsed);
        let force = self.working_force.shifted(since);
        let (position_integral, lost_work) = arc.course.displacement_variation(span, by, &force);
        self.position_integral += position_integral;
        self.found.work -= lost_work;
        let end_rate = self.end_rate.take();
        if arc.kind != PhaseKind::Free && span.0 < elapsed {
            self.record_peak(arc, span, by, end_rate.is_some());
        }
        (self.position, self.velocity) = arc.course.state_variation(elapsed, by);
        // Unless a crossing follows, the next arc goes on with this one.
        self.crossing_delay = 0.0;
    }

    fn crossing(&mut self, crossing: &Crossing) {
        let (v, a) = (crossing.velocity, crossing.acceleration_before);
        self.crossing_delay = match crossing.kind {
            CrossingKind::Surface { .. } | CrossingKind::Rebound { .. } if v != 0.0 => {
                -self.position / v
            }
            CrossingKind::Reversal => -self.velocity / a,
            CrossingKind::Rest => f64::NAN,
            _ => 0.0,
        };
        if let Some(rate) = self.end_rate {
            self.found.peak += rate * self.crossing_delay;
        }
        if let Some(velocity) = crossing.impact_velocity() {
            let side = 1f64.copysign(v);
            let by = Impact {
                time: self.crossing_delay,
                velocity: side * (self.velocity + a * self.crossing_delay),
            };
            if self.hardest.is_none() {
                self.found.first = by;
            }
            if self.hardest.is_none_or(|hardest| velocity > hardest) {
                (self.hardest, self.found.hardest) = (Some(velocity), by);
            }
            (self.found.impact_time, self.found.impact_velocity) = (by.time, by.velocity);
        }
        let jump = v - crossing.velocity_after;
        if jump != 0.0 && crossing.kind != CrossingKind::Rest {
            // The forcing works on another velocity from an impact on that comes later.
            self.found.supplied += self.forcing * jump * self.crossing_delay;
        }
        let after = saltation(crossing) * nalgebra::Vector2::new(self.position, self.velocity);
        (self.position, self.velocity) = (after.x, after.y);
    }
}

impl OutputSensitivityRecorder<'_> {
    /// The change of the contact force where it is largest on an arc, if it is larger there than before, or goes on from
    /// the end of the last arc: at an end of the arc it comes with that.
    fn record_peak(
        &mut self,
        arc: &Arc<'_>,
        (from, to): (f64, f64),
        by: Variation,
        was_at_end: bool,
    ) {
        let (mut time, peak) = contact_peak(self.scene, arc, (from, to));
        let goes_on = time == from && was_at_end;
        let share = if goes_on {
            1.0 - MAX_RELATIVE_PEAK_GAP
        } else {
            1.0
        };
        if peak <= share * self.peak {
            return;
        }
        let rate = |time: f64| self.contact_change(arc, time, by).1;
        // A flat top tells half the digits of its time: a step of Newton's method towards where the rate is zero.
        let width = (RELATIVE_TOP_WIDTH * (to - from))
            .min(time - from)
            .min(to - time);
        let curvature = (rate(time + width) - rate(time - width)) / (2.0 * width);
        if curvature < 0.0 {
            time = (time - rate(time) / curvature).clamp(time - width, time + width);
        }
        let (change, rate) = self.contact_change(arc, time, by);
        self.peak = peak;
        self.found.peak = change;
        if time == from {
            self.found.peak += rate * self.crossing_delay;
        }
        self.end_rate = (time == to).then_some(rate);
    }

    /// Change of the force in N that a stop presses with at a time of an arc, and its rate in N/s.
    fn contact_change(&self, arc: &Arc<'_>, time: f64, by: Variation) -> (f64, f64) {
        let Scene {
            mass,
            stiffness,
            damping,
            ..
        } = *self.scene;
        let (position, velocity) = arc.course.state_variation(time, by);
        let Some(phase) = arc.phase else {
            let rate = mass * arc.course.forcing_rate_at_rest(time);
            return (
                arc.side * (self.force - stiffness * position),
                arc.side * rate,
            );
        };
        let Start {
            position: x,
            velocity: v,
        } = arc.at(time);
        let forcing = mass * arc.course.forcing_at(time) - phase.law.force;
        let acceleration =
            (forcing - stiffness * x - damping * v - phase.contact_force(x, v)) / mass;
        let (by_x, by_v) = phase.contact_derivatives(x, v);
        (
            arc.side * (by_x * position + by_v * velocity),
            arc.side * (by_x * v + by_v * acceleration),
        )
    }

    /// Changes of acceleration and contact force.
    fn force_changes(&self, scene: &Scene, motion: &Motion) -> (f64, f64) {
        let Some(phase) = motion.phase() else {
            return (0.0, self.force - scene.stiffness * self.position);
        };
        let Start { position, velocity } = motion.state();
        let (stiffness, damping) = phase.force_derivatives(position, velocity);
        let resisting = stiffness * self.position + damping * self.velocity;
        let free = scene.stiffness * self.position + scene.damping * self.velocity;
        ((self.force - resisting) / scene.mass, resisting - free)
    }
}
