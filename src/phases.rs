//! A scene lowered to the few smooth laws (phases) that it can reach, and the surfaces between them.
//!
//! The positions are cut into layers (free, strip, stop, ...), each with one law for the way forward and, where there
//! is dry friction, another for the way back. Nothing behind this module asks which stop it was.

mod build_phases;
mod layer_plan;
mod layer_stack;
mod mode;
mod phase_id;
mod stop_energy;

use layer_stack::{Layer, Stack};
pub(crate) use mode::RestThreshold;
pub use mode::{Mode, Sticking};
pub use phase_id::{PhaseId, SurfaceId};
pub use stop_energy::{SpringEnergy, StopEnergy};

use std::ops::Index;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::events::Guard;
use crate::flow::{DriveAngle, LinearLaw, Polynomial, PowerLaw};
use crate::scene::Excitation;

/// What a phase is in the machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum PhaseKind {
    /// No contact: x < r.
    Free,
    /// Phase I: the punch deforms and pierces the strip.
    Pierce,
    /// Phase II: the punch moves in the cut against dry friction.
    Cut,
    /// Beyond the clearance where neither strip nor stop acts: the contact damping alone.
    Gap,
    /// Phase III: the stop is pressed.
    Stop,
    /// Beyond where the stop begins, where it would have to pull.
    Released,
    /// Ever faster bounces on a rigid stop that end in rest after a finite time.
    Chatter,
    /// Held by dry friction.
    Stuck,
    /// Held where a stop begins: at a preloaded one by a force below its preload, at a rigid one by any force.
    Resting,
}

/// m x'' + `damping` x' + `stiffness` x = `force` + F0 cos(w t + phi) + f(t).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LawCoefficients {
    /// Damping in N s/m.
    pub damping: f64,
    /// Net stiffness in N/m, the suspension included; may be negative.
    pub stiffness: f64,
    /// Constant force in N.
    pub force: f64,
}

/// One smooth law and what ends it.
#[derive(Debug, Clone, PartialEq)]
pub struct Phase {
    /// The id of this phase.
    pub id: PhaseId,
    /// What the phase is in the machine.
    pub kind: PhaseKind,
    /// The law of the phase, or its linear part.
    pub law: LawCoefficients,
    /// What stop and strip add to the suspension's law.
    pub(crate) contact: LawCoefficients,
    /// The exact flow of the linear law.
    pub flow: LinearLaw,
    /// The nonlinear part of the law.
    pub hertz: Option<PowerLaw>,
    /// The guards that end the phase.
    pub guards: Arc<Vec<Guard>>,
    /// What each guard leads to.
    pub exits: Arc<Vec<Exit>>,
    /// The energy that the stop stores.
    pub store: StopEnergy,
    /// The phase that holds instead while this guard is above zero: contact does not pull.
    pub(crate) released: Option<(PhaseId, Guard)>,
    /// 1 of a stop above and of the free phase, -1 of a stop below, which presses the mass upwards.
    pub side: f64,
}

/// What a guard leads to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// The mass moves on towards the stop through a surface, or hits it.
    Forward(SurfaceId),
    /// The mass moves back through a surface.
    Backward(SurfaceId),
    /// The velocity changes its sign under dry friction.
    Reversal {
        /// The phase at positive velocities.
        forward: PhaseId,
        /// The phase at negative velocities.
        backward: PhaseId,
    },
    /// Another phase takes over where its law gives the same force.
    Switch(PhaseId),
}

/// What lies beyond a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Beyond {
    /// A phase, entered on the way towards the stop.
    Phase(PhaseId),
    /// Nothing that gives way: v+ = -restitution v-.
    Wall {
        /// Newton's coefficient of restitution.
        restitution: f64,
    },
}

/// A position at which the law changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// Position in m.
    pub position: f64,
    /// The phase before it, on the way back.
    pub before: PhaseId,
    /// What lies beyond it.
    pub beyond: Beyond,
    /// What lies beyond it when no strip is fed, if that differs.
    pub beyond_unfed: Option<Beyond>,
    /// 1 if the way towards the stop is upwards, -1 if it is downwards.
    pub side: f64,
    /// True at a clearance: moving on to it is an impact.
    pub is_clearance: bool,
    /// True at the far side of the strip: moving on to it pierces it.
    pub is_far_side: bool,
}

impl Surface {
    /// True if a position is on this surface or beyond.
    pub(crate) fn is_reached(&self, position: f64) -> bool {
        self.side * position >= self.side * self.position
    }
}

/// All phases that a scene can reach.
#[derive(Debug, Clone, PartialEq)]
pub struct Phases {
    /// The phases; the first is the free one.
    pub phases: Vec<Phase>,
    /// The surfaces between them.
    pub surfaces: Arc<[Surface]>,
    /// Amplitude of the drive per mass, F0/m, in m/s^2.
    pub amplitude: f64,
    /// Frequency w of the drive in rad/s.
    pub frequency: f64,
    /// The mass in kg.
    pub mass: f64,
    /// The law of a mass that is held: the drive alone.
    pub(crate) held: LinearLaw,
    fed: Stack,
    unfed: Stack,
    below: Stack,
}

impl Phases {
    /// These phases under another drive.
    pub(crate) fn with_drive(&self, drive: &Excitation) -> Self {
        let mut phases = self.clone();
        (phases.amplitude, phases.frequency) = (drive.amplitude / self.mass, drive.frequency);
        let under_drive = |flow: &LinearLaw| flow.with_drive(phases.amplitude, drive.frequency);
        phases.held = under_drive(&phases.held);
        for index in 0..phases.phases.len() {
            let (before, after) = phases.phases.split_at_mut(index);
            let flow = &mut after[0].flow;
            let like = before.iter().find(|other| other.flow.modes == flow.modes);
            *flow = like.map_or_else(|| under_drive(flow), |like| like.flow);
        }
        phases
    }
}

impl Index<PhaseId> for Phases {
    type Output = Phase;

    #[inline]
    fn index(&self, phase: PhaseId) -> &Phase {
        &self.phases[phase.index()]
    }
}

impl Index<SurfaceId> for Phases {
    type Output = Surface;

    #[inline]
    fn index(&self, surface: SurfaceId) -> &Surface {
        &self.surfaces[surface.0]
    }
}

impl Phases {
    /// True if a phase is one of those with a strip, false if it is one without; none if it belongs to no stroke.
    pub(crate) fn belongs_to_strip(&self, phase: PhaseId) -> Option<bool> {
        let is_of = |layer: &Layer| {
            let of = |side: PhaseId| {
                let released = self[side].released;
                side == phase || released.is_some_and(|(released, _)| released == phase)
            };
            of(layer.forward) || of(layer.backward)
        };
        let has = |stack: &Stack| stack.layers.iter().any(is_of);
        match (has(&self.fed), has(&self.unfed)) {
            (false, false) => None,
            (is_fed, _) => Some(is_fed),
        }
    }

    /// The phase at this velocity in the layer of a phase, which dry friction may divide in two.
    pub(crate) fn at_velocity(&self, phase: PhaseId, velocity: f64) -> PhaseId {
        let reversal = |exit: &Exit| match *exit {
            Exit::Reversal { forward, .. } if velocity > 0.0 => Some(forward),
            Exit::Reversal { backward, .. } => Some(backward),
            _ => None,
        };
        self[phase].exits.iter().find_map(reversal).unwrap_or(phase)
    }

    /// 1 where a stop above holds the mass, -1 where one below does.
    pub(crate) fn side_of_hold(&self, hold: Sticking) -> f64 {
        let sides = hold.phases().map(|phase| self[phase].side);
        let on_wall = if hold.backward.is_none() { -1.0 } else { 1.0 };
        sides.fold(on_wall, f64::min)
    }

    /// The surfaces of rigid stops, at which the mass can go no further.
    pub(crate) fn walls(&self) -> impl Iterator<Item = &Surface> {
        let walls = [self.fed.wall, self.below.wall].into_iter().flatten();
        walls.map(|wall| &self[wall])
    }

    /// Forcing of drive and external force per mass, in m/s^2.
    pub(crate) fn forcing_per_mass(&self, drive: DriveAngle, force: &Polynomial) -> f64 {
        self.amplitude * drive.cos + force.value() / self.mass
    }

    /// [`Phase::acceleration`] of a phase.
    pub fn acceleration(&self, phase: PhaseId, position: f64, velocity: f64, forcing: f64) -> f64 {
        self[phase].acceleration(position, velocity, forcing, self.mass)
    }
}

impl Phase {
    /// Force of stop and strip on the mass in a phase in N, F in m x'' + b1 x' + k1 x + F = F0 cos(w t):
    /// positive where it presses the mass back.
    pub fn contact_force(&self, position: f64, velocity: f64) -> f64 {
        self.contact.damping * velocity + self.contact.stiffness * position - self.contact.force
            + self.hertz_force(position, velocity)
    }

    fn hertz_force(&self, position: f64, velocity: f64) -> f64 {
        self.hertz
            .map_or(0.0, |hertz| hertz.force(position, velocity))
    }

    /// Acceleration in m/s^2 of any state in this phase under the external force `forcing` per mass.
    pub fn acceleration(&self, position: f64, velocity: f64, forcing: f64, mass: f64) -> f64 {
        let force = self.law.force - self.hertz_force(position, velocity);
        self.flow
            .acceleration(position, velocity, forcing + force / mass)
    }

    /// d(force)/d(position) in N/m and d(force)/d(velocity) in N s/m of spring, damper and stop together.
    pub fn force_derivatives(&self, position: f64, velocity: f64) -> (f64, f64) {
        let (stiffness, damping) = self.hertz_derivatives(position, velocity);
        (self.law.stiffness + stiffness, self.law.damping + damping)
    }

    /// d(force)/d(position) in N/m and d(force)/d(velocity) in N s/m of the [contact force](Self::contact_force).
    pub fn contact_derivatives(&self, position: f64, velocity: f64) -> (f64, f64) {
        let (stiffness, damping) = self.hertz_derivatives(position, velocity);
        let contact = &self.contact;
        (contact.stiffness + stiffness, contact.damping + damping)
    }

    fn hertz_derivatives(&self, position: f64, velocity: f64) -> (f64, f64) {
        let of_hertz = |hertz: PowerLaw| hertz.force_derivatives(position, velocity);
        self.hertz.map_or((0.0, 0.0), of_hertz)
    }

    /// The position without the rounding that would put it beyond a surface that ends the phase.
    pub fn confine_position(&self, position: f64) -> f64 {
        let surfaces = self.guards.iter().filter(|guard| guard.velocity == 0.0);
        surfaces.fold(position, |x, guard| {
            if guard.position > 0.0 {
                x.min(guard.level)
            } else if guard.position < 0.0 {
                x.max(-guard.level)
            } else {
                x
            }
        })
    }

    /// Energy in J that the mass has lost to this phase's springs on the way from one position to
    /// another, the suspension left out.
    pub(crate) fn elastic_work(&self, low: f64, high: f64) -> f64 {
        let force = 0.5 * self.contact.stiffness * (high + low) - self.contact.force;
        let of_hertz = |hertz: PowerLaw| hertz.energy(high) - hertz.energy(low);
        force * (high - low) + self.hertz.map_or(0.0, of_hertz)
    }
}
