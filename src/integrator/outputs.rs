//! What a running machine shows, and the rates of that: how it goes on from the present time.

use std::f64::consts::TAU;

use super::crossing::Impact;
use super::simulation::Simulation;
use super::start::Start;
use crate::events::Guard;
use crate::flow::DriveAngle;
use crate::phases::{Mode, PhaseKind};

/// Outputs at the present time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Sample {
    /// Position in m.
    pub position: f64,
    /// Velocity in m/s.
    pub velocity: f64,
    /// Acceleration in m/s^2.
    pub acceleration: f64,
    /// Jerk in m/s^3.
    pub jerk: f64,
    /// F in m x'' + b1 x' + k1 x + F = F0 cos(w t + phi) + f, in N: positive where stop or strip
    /// press the mass back, negative where a stop below does; what contact adds to the damping b1 is part of it.
    pub contact_force: f64,
    /// What the mass does.
    pub phase: PhaseKind,
}

/// Energies in J since the start; supplied = dissipated + change of mechanical.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Energy {
    /// Kinetic, suspension and loaded stop.
    pub mechanical: f64,
    /// Work of drive, external force and tuning.
    pub supplied: f64,
    /// Work lost in dampers, strip and friction.
    pub dissipated: f64,
}

impl Simulation {
    /// Outputs at the present time.
    pub fn sample(&self) -> Sample {
        let Start { position, velocity } = self.motion.state();
        let (forcing, forcing_rate, _) = self.forcing();
        let (contact_force, acceleration, jerk) = match self.motion.phase() {
            None => (forcing - self.scene.stiffness * position, 0.0, 0.0),
            Some(phase) => {
                let contact = phase.contact_force(position, velocity);
                let free = self.scene.damping * velocity + self.scene.stiffness * position;
                let acceleration = (forcing - free - contact) / self.scene.mass;
                let (stiffness, damping) = phase.force_derivatives(position, velocity);
                let resisting = damping * acceleration + stiffness * velocity;
                (
                    contact,
                    acceleration,
                    (forcing_rate - resisting) / self.scene.mass,
                )
            }
        };
        Sample {
            position,
            velocity,
            acceleration,
            jerk,
            contact_force,
            phase: self.motion.kind(),
        }
    }

    /// Drive and external force now, in N, with their first and second derivative.
    pub fn forcing(&self) -> (f64, f64, f64) {
        let force = self.motion.force();
        let DriveAngle { cos, sin } = self.motion.clock().drive(self.motion.now());
        let excitation = self.scene.excitation;
        let (amplitude, w) = (excitation.amplitude, excitation.frequency);
        (
            amplitude * cos + force.value(),
            force.rate() - amplitude * w * sin,
            force.derivatives()[2] - amplitude * w * w * cos,
        )
    }

    /// The drive angle in rad; it begins anew below 2 pi where frequency or phase are set.
    pub fn drive_angle(&self) -> f64 {
        TAU.mul_add(self.motion.now().cycles, self.reduced_drive_angle())
    }

    /// The drive angle in rad without the whole turns since it began, which would take digits of it.
    pub fn reduced_drive_angle(&self) -> f64 {
        let (clock, now) = (self.motion.clock(), self.motion.now());
        self.scene.excitation.frequency * now.offset + clock.phase
    }

    /// True while bounces on a rigid stop are summed up to their end.
    pub fn is_chattering(&self) -> bool {
        matches!(self.motion.mode, Mode::Chattering(_))
    }

    /// Impacts since the start: crossings of a clearance towards its stop.
    pub fn impact_count(&self) -> u64 {
        self.counts.impacts
    }

    /// Impacts on a stop below since the start.
    pub fn impact_count_below(&self) -> u64 {
        self.counts.below
    }

    /// Strips pierced through since the start.
    pub fn pierce_count(&self) -> u64 {
        self.counts.pierced
    }

    /// The last impact, if there was one.
    pub fn last_impact(&self) -> Option<Impact> {
        let impact = |(instant, velocity)| Impact {
            time: self.time_of(instant),
            velocity,
        };
        self.counts.last_impact.map(impact).or(self.earlier)
    }

    /// Mechanical energy now; energies supplied and dissipated, impacts on rigid stops among it, since the start, in J.
    pub fn energy(&self) -> Energy {
        let mut work = self.counts.work;
        work += self.work_under_way();
        Energy {
            mechanical: self.motion.mechanical_energy(&self.scene),
            supplied: work.supplied,
            dissipated: work.dissipated,
        }
    }

    /// Rates of the outputs at the present time. While the mass bounces faster than can be told they are
    /// those of the rest that it comes to.
    pub fn rates(&self) -> Rates {
        let (forcing, rate, curvature) = self.forcing();
        let Some(phase) = self.motion.phase() else {
            return Rates {
                contact_force: (rate, curvature),
                ..Rates::default()
            };
        };
        let scene = &self.scene;
        let Start { position, velocity } = self.motion.state();
        let Sample {
            acceleration, jerk, ..
        } = self.sample();
        let (x, v, a) = (position, velocity, acceleration);
        // The law of force along the motion: F' = K v + C a, F'' = K a + C j + K' v + C' a.
        let (stiffness, damping) = phase.force_derivatives(x, v);
        let (stiffening, coupling) = phase
            .hertz
            .map_or((0.0, 0.0), |hertz| hertz.curvatures(x, v));
        let bending = stiffening * v * v + 2.0 * coupling * v * a;
        let resisting = stiffness * a + damping * jerk + bending;
        let snap = (curvature - resisting) / scene.mass;

        let (k, b) = (scene.stiffness, scene.damping);
        let contact_force = (
            rate - scene.mass * jerk - b * a - k * v,
            curvature - scene.mass * snap - b * jerk - k * a,
        );
        let store = self.motion.store();
        let elastic = k * x + store.force_at(x);
        let pull = scene.mass * a + elastic;
        let mechanical = (
            pull * v,
            (scene.mass * jerk + (k + store.stiffness_at(x)) * v) * v + pull * a,
        );
        let supplied = (forcing * v, rate * v + forcing * a);
        Rates {
            snap,
            contact_force,
            mechanical,
            supplied,
            dissipated: (supplied.0 - mechanical.0, supplied.1 - mechanical.1),
        }
    }

    /// How far the state is from the ends of the present law, as shares of what a `length` in m amounts to; < 0 beyond one.
    pub fn guard_margins(&self, length: f64) -> impl Iterator<Item = f64> {
        let rate = self.scene.excitation.frequency;
        self.motion.guard_values().map(move |(guard, value)| {
            let Guard {
                position,
                velocity,
                forcing,
                ..
            } = guard;
            let weight = position.abs() + rate * (velocity.abs() + rate * forcing.abs());
            -value / (weight * length)
        })
    }
}

/// First and second time derivative of an output.
pub type Rate = (f64, f64);

/// Rates of the outputs that [`Sample`] and [`Energy`](super::Energy) hold, beyond those that are
/// outputs themselves. Right at a crossing they are those after it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Rates {
    /// Fourth derivative of the position, in m/s^4.
    pub snap: f64,
    /// Rates of the contact force, in N/s and N/s^2.
    pub contact_force: Rate,
    /// Rates of the mechanical energy, in W and W/s.
    pub mechanical: Rate,
    /// Rates of the energy supplied, in W and W/s.
    pub supplied: Rate,
    /// Rates of the energy dissipated, in W and W/s.
    pub dissipated: Rate,
}
