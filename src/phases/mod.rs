//! The waist of the house: a scene lowered to the few smooth laws that it can reach.
//!
//! The positions are cut into layers (free, strip, stop, ...), each with one law for the way forward
//! and, where there is dry friction, another for the way back. Nothing behind this module asks
//! which stop it was.

mod lower;
mod settle;

pub use settle::Mode;
pub(crate) use settle::Threshold;

use crate::events::Guard;
use crate::flow::Flow;
use crate::scene::Scene;
use serde::{Deserialize, Serialize};

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
    /// Beyond the clearance where no strip lies.
    Gap,
    /// Phase III: the stop is pressed.
    Stop,
    /// Held by dry friction.
    Stuck,
    /// Held at the face of a stop by a force below its preload.
    Resting,
}

/// m x'' + `damping` x' + `stiffness` x = `force` + F0 cos(w t + phi) + f(t).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Law {
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
    /// What it is.
    pub kind: PhaseKind,
    /// Its law.
    pub law: Law,
    /// Its exact flow.
    pub flow: Flow,
    /// Its guards.
    pub guards: Vec<Guard>,
    /// What each guard leads to.
    pub exits: Vec<Exit>,
    /// Energy in J that the stop's spring stores at position x: `stored.0` u + `stored.1` u^2 / 2
    /// with u = x - `stored.2`.
    pub stored: (f64, f64, f64),
}

/// What a guard leads to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// The mass moves on through a surface.
    Forward(usize),
    /// The mass moves back through a surface.
    Backward(usize),
    /// The velocity changes its sign under dry friction.
    Reversal {
        /// The phase of the way forward.
        forward: usize,
        /// The phase of the way back.
        backward: usize,
    },
}

/// A position at which the law changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// Where it is, in m.
    pub position: f64,
    /// The phase below it, on the way back.
    pub below: usize,
    /// The phase above it, on the way forward.
    pub above: usize,
    /// The phase above it when no strip is fed, if that differs.
    pub above_unfed: Option<usize>,
    /// True at the clearance: moving on through it is an impact.
    pub is_clearance: bool,
    /// True at the far side of the strip: moving on through it pierces it.
    pub is_far_side: bool,
}

/// All phases that a scene can reach.
#[derive(Debug, Clone, PartialEq)]
pub struct Phases {
    /// The phases; the first is the free one.
    pub phases: Vec<Phase>,
    /// The surfaces between them.
    pub surfaces: Vec<Surface>,
    /// The drive alone, for a mass that is held.
    pub(crate) held: Flow,
    pub(crate) mass: f64,
    /// The suspension and its damping alone.
    pub(crate) free: Law,
    fed: Vec<Layer>,
    unfed: Vec<Layer>,
}

/// A range of positions with its phases on the way forward and back.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Layer {
    from: f64,
    forward: usize,
    backward: usize,
    /// The surface at `from`.
    surface: usize,
}

impl Scene {
    /// Lowers the scene to its phases. The scene must have passed [`Scene::validate`].
    pub fn phases(&self) -> Phases {
        lower::lower(self)
    }
}

impl Phases {
    /// True if a phase is one of those with a strip.
    pub(crate) fn belongs_to_strip(&self, phase: usize) -> bool {
        let within = |layers: &[Layer]| {
            layers
                .iter()
                .any(|layer| layer.forward == phase || layer.backward == phase)
        };
        within(&self.fed)
    }
}

impl Phase {
    /// Force of stop and strip on the mass in N, F in m x'' + b1 x' + k1 x + F = F0 cos(w t):
    /// positive where it presses the mass back.
    pub fn contact_force(&self, free: &Law, position: f64, velocity: f64) -> f64 {
        (self.law.damping - free.damping) * velocity
            + (self.law.stiffness - free.stiffness) * position
            - self.law.force
    }

    /// The position without the rounding that would put it beyond a surface that ends the phase.
    pub(crate) fn confine(&self, position: f64) -> f64 {
        self.guards.iter().fold(position, |x, guard| {
            if guard.position > 0.0 {
                x.min(guard.level)
            } else if guard.position < 0.0 {
                x.max(-guard.level)
            } else {
                x
            }
        })
    }

    /// Energy in J stored in the stop's spring.
    pub fn stored_energy(&self, position: f64) -> f64 {
        let (force, stiffness, origin) = self.stored;
        let depth = position - origin;
        depth * (force + 0.5 * stiffness * depth)
    }

    /// Acceleration in m/s^2 of a mass at rest under the external force `push` per mass.
    pub(crate) fn acceleration_from_rest(&self, position: f64, push: f64, mass: f64) -> f64 {
        push + self.law.force / mass - self.flow.modes.stiffness * position
    }
}
