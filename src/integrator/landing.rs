//! What a crossing leads to: state, mode and kind right after it.

use super::motion::{Motion, Start};
use super::observer::CrossingKind;
use crate::events::Found;
use crate::phases::{Exit, Law, Mode, Surface};

/// State, mode and kind of a crossing, right after it.
pub(super) struct Landing {
    pub state: Start,
    pub mode: Mode,
    pub kind: CrossingKind,
}

impl Motion {
    /// The surface that a guard watches, if it watches one.
    pub(super) fn surface_of(&self, guard: usize) -> Option<usize> {
        let Mode::Moving(phase) = self.mode else {
            return None;
        };
        match self.phases.phases[phase].exits[guard] {
            Exit::Forward(surface) | Exit::Backward(surface) => Some(surface),
            Exit::Reversal { .. } => None,
        }
    }

    /// State and mode right after a crossing.
    pub(super) fn land(&self, found: &Found, push: f64) -> Landing {
        let phase = match self.mode {
            Mode::Moving(phase) => phase,
            Mode::Held { forward, backward } => {
                let phase = if found.guard == 0 { forward } else { backward };
                let state = Start {
                    position: found.position,
                    velocity: 0.0,
                };
                let mode = Mode::Moving(phase);
                return Landing {
                    state,
                    mode,
                    kind: CrossingKind::Release,
                };
            }
        };
        match self.phases.phases[phase].exits[found.guard] {
            Exit::Reversal { forward, backward } => {
                let mode = self
                    .phases
                    .leave_rest(forward, backward, found.position, push);
                let state = Start {
                    position: found.position,
                    velocity: 0.0,
                };
                Landing {
                    state,
                    mode,
                    kind: CrossingKind::Reversal,
                }
            }
            Exit::Forward(surface) => self.pass(surface, found.velocity.max(0.0), push, true),
            Exit::Backward(surface) => self.pass(surface, found.velocity.min(0.0), push, false),
        }
    }

    fn pass(&self, surface: usize, velocity: f64, push: f64, forward: bool) -> Landing {
        let at: &Surface = &self.phases.surfaces[surface];
        let mode = self
            .phases
            .at_surface(at, velocity, push, self.fed, self.hum.threshold());
        let held = matches!(mode, Mode::Held { .. });
        let fed = self.fed || at.above_unfed.is_none();
        let kind = CrossingKind::Surface {
            forward,
            impact: forward && at.is_clearance,
            pierces: forward && at.is_far_side && fed,
        };
        let velocity = if held { 0.0 } else { velocity };
        Landing {
            state: Start {
                position: at.position,
                velocity,
            },
            mode,
            kind,
        }
    }

    /// Acceleration in m/s^2 with which a mass at rest starts in a mode: the very number by which the
    /// mode was chosen.
    pub(super) fn acceleration_at_rest(&self, position: f64, drive: (f64, f64), mode: Mode) -> f64 {
        match (self.mode, mode) {
            (Mode::Moving(_), Mode::Moving(phase)) => self.phases.phases[phase]
                .acceleration_from_rest(position, self.push(drive), self.phases.mass),
            // A held mass is let go in balance.
            _ => 0.0,
        }
    }

    /// Push of drive and external force per mass, in m/s^2, at the start of the present arc.
    pub(super) fn push(&self, drive: (f64, f64)) -> f64 {
        self.phases.held.amplitude * drive.0 + self.force.value / self.phases.mass
    }

    /// Acceleration in m/s^2 in a mode.
    pub(super) fn acceleration(&self, mode: Mode, position: f64, velocity: f64, push: f64) -> f64 {
        match mode {
            Mode::Held { .. } => 0.0,
            Mode::Moving(phase) => {
                let Law { force, .. } = self.phases.phases[phase].law;
                let flow = &self.phases.phases[phase].flow;
                flow.acceleration(position, velocity, push + force / self.phases.mass)
            }
        }
    }
}
