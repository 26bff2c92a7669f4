//! What a running machine shows.

use super::impact::Impact;
use super::simulation::Simulation;
use super::start::Start;
use crate::flow::Drive;
use crate::phases::PhaseKind;

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
        let (push, push_rate, _) = self.push();
        let (contact_force, acceleration, jerk) = match self.motion.phase() {
            None => (push - self.scene.stiffness * position, 0.0, 0.0),
            Some(phase) => {
                let contact = phase.contact_force(position, velocity);
                let free = self.scene.damping * velocity + self.scene.stiffness * position;
                let acceleration = (push - free - contact) / self.scene.mass;
                let (stiffness, damping) = phase.slopes(position, velocity);
                let resisting = damping * acceleration + stiffness * velocity;
                (
                    contact,
                    acceleration,
                    (push_rate - resisting) / self.scene.mass,
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
    pub fn push(&self) -> (f64, f64, f64) {
        let force = self.motion.force();
        let Drive { cos, sin } = self.motion.clock().drive(self.motion.now());
        let excitation = self.scene.excitation;
        let (amplitude, w) = (excitation.amplitude, excitation.frequency);
        (
            amplitude * cos + force.value(),
            force.rate() - amplitude * w * sin,
            force.derivatives()[2] - amplitude * w * w * cos,
        )
    }

    /// Impacts since the start: crossings of a clearance towards its stop.
    pub fn impact_count(&self) -> u64 {
        self.tallies.counts.impacts
    }

    /// Impacts on a stop below since the start.
    pub fn impact_count_below(&self) -> u64 {
        self.tallies.counts.below
    }

    /// Strips pierced through since the start.
    pub fn pierce_count(&self) -> u64 {
        self.tallies.counts.pierced
    }

    /// The last impact, if there was one.
    pub fn last_impact(&self) -> Option<Impact> {
        let impact = |(instant, velocity)| Impact {
            time: self.time_of(instant),
            velocity,
        };
        self.tallies.counts.last_impact.map(impact).or(self.earlier)
    }

    /// Energies since the start.
    pub fn energy(&self) -> Energy {
        let mut work = self.tallies.counts.work;
        work += self.tallies.work_under_way(&self.motion);
        Energy {
            mechanical: self.motion.mechanical_energy(&self.scene),
            supplied: work.supplied,
            dissipated: work.dissipated,
        }
    }
}
