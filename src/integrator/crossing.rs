//! Crossings: the instants at which one law ends and the next begins, and what happens there.

use serde::{Deserialize, Serialize};

use super::clock::Instant;

/// What happens at a crossing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CrossingKind {
    /// A surface is passed.
    Surface {
        /// Onwards (towards the stop) rather than back.
        forward: bool,
        /// It is an impact: a clearance is passed onwards.
        impact: bool,
        /// A strip has been pierced through.
        pierces: bool,
    },
    /// A rigid stop is hit.
    Rebound {
        /// It is an impact: the stop stands at a clearance.
        impact: bool,
        /// A strip has been pierced through.
        pierces: bool,
    },
    /// The velocity passes zero under dry friction.
    Reversal,
    /// Contact ceases or begins to press, without a jump of the force.
    Switch,
    /// Ever faster bounces on a rigid stop come to their end. The velocity before is the speed with
    /// which the last, summed ones began.
    Rest,
    /// A held mass is let go.
    Release,
}

impl CrossingKind {
    /// True if the crossing is an impact.
    pub const fn is_impact(self) -> bool {
        matches!(
            self,
            Self::Surface { impact: true, .. } | Self::Rebound { impact: true, .. }
        )
    }

    /// True if a strip has been pierced through at the crossing.
    pub const fn pierces(self) -> bool {
        matches!(
            self,
            Self::Surface { pierces: true, .. } | Self::Rebound { pierces: true, .. }
        )
    }
}

/// A crossing: an exact instant with the states on both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// When it happens.
    pub instant: Instant,
    /// What happens.
    pub kind: CrossingKind,
    /// Position in m.
    pub position: f64,
    /// Velocity before in m/s.
    pub velocity: f64,
    /// Velocity after in m/s.
    pub velocity_after: f64,
    /// Acceleration before in m/s^2.
    pub acceleration_before: f64,
    /// Acceleration after in m/s^2.
    pub acceleration_after: f64,
}

impl Crossing {
    /// Kinetic energy in J that a mass loses at the crossing: at a rebound, or when its bounce counts as rest.
    pub fn lost_energy(&self, mass: f64) -> f64 {
        // What summed bounces lose they lose on their way.
        if self.kind == CrossingKind::Rest {
            return 0.0;
        }
        let after = self.velocity_after * self.velocity_after;
        0.5 * mass * (self.velocity * self.velocity - after)
    }

    /// True if a strip has been pierced through at the crossing.
    pub fn pierces(&self) -> bool {
        self.kind.pierces()
    }

    /// The before-impact velocity in m/s towards the stop, if this is an impact; [`Crossing::velocity`] has its sign.
    pub fn impact_velocity(&self) -> Option<f64> {
        self.kind.is_impact().then_some(self.velocity.abs())
    }
}

/// An impact, its time counted from the start of the simulation.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Impact {
    /// Time in s.
    pub time: f64,
    /// Before-impact velocity in m/s.
    pub velocity: f64,
}
