//! The reset at a crossing: state, mode and kind right after it.

use super::bounce_train::MAX_RESTITUTION;
use super::crossing::CrossingKind;
use super::motion::Motion;
use super::start::Start;
use crate::events::FoundCrossing;
use crate::flow::{Chatter, PressingForces};
use crate::phases::{Beyond, Exit, Mode, PhaseId, Phases, Sticking, Surface, SurfaceId};

/// State, mode and kind right after a crossing.
pub(crate) struct Reset {
    pub state: Start,
    pub mode: Mode,
    pub kind: CrossingKind,
    /// The bounces that follow, if they are summed.
    pub chatter: Option<Chatter>,
}

impl Reset {
    pub fn new(position: f64, velocity: f64, mode: Mode, kind: CrossingKind) -> Self {
        Self {
            state: Start::new(position, velocity),
            mode,
            kind,
            chatter: None,
        }
    }
}

impl Phases {
    /// The velocity of a crossing out of a phase: rounding may turn that of a touch the other way.
    #[inline]
    pub(super) fn crossing_velocity(&self, phase: PhaseId, found: &FoundCrossing) -> f64 {
        match self[phase].exits[found.guard] {
            Exit::Forward(_) | Exit::Backward(_) => {
                if self[phase].guards[found.guard].position > 0.0 {
                    found.velocity.max(0.0)
                } else {
                    found.velocity.min(0.0)
                }
            }
            Exit::Reversal { .. } | Exit::Switch(_) => found.velocity,
        }
    }
}

impl Motion {
    /// State, mode and kind right after a crossing; `moved`: the mass is not back at once where it left rest.
    pub(super) fn reset_after(&self, found: &FoundCrossing, forcing: f64, moved: bool) -> Reset {
        match self.mode {
            Mode::Moving(phase) => self.reset_out_of(phase, found, forcing, moved),
            Mode::Held(hold) | Mode::Chattering(hold) => {
                let mode = hold.after_release(found.guard);
                Reset::new(found.position, 0.0, mode, CrossingKind::Release)
            }
        }
    }

    /// The surface that a guard watches, if bounces on it may go on for ever.
    pub(super) fn endless_surface(&self, guard: usize) -> Option<SurfaceId> {
        let surface = match self.phase()?.exits[guard] {
            Exit::Forward(surface) | Exit::Backward(surface) => surface,
            Exit::Reversal { .. } | Exit::Switch(_) => return None,
        };
        let endless = match self.phases[surface].beyond {
            Beyond::Phase(_) => true,
            Beyond::Wall { restitution } => restitution > MAX_RESTITUTION,
        };
        endless.then_some(surface)
    }

    /// Updates whether the sheet-metal strip is cut through in this stroke; a new impact begins a new stroke.
    pub(super) fn update_pierced(&mut self, kind: CrossingKind) {
        if kind.pierces() {
            self.pierced = true;
        } else if matches!(kind, CrossingKind::Surface { impact: true, .. }) {
            self.pierced = false;
        }
    }

    /// The reset at a crossing out of a phase: state and mode right after it, and the kind of the crossing.
    fn reset_out_of(
        &self,
        phase: PhaseId,
        found: &FoundCrossing,
        forcing: f64,
        moved: bool,
    ) -> Reset {
        let onward = self.phases.crossing_velocity(phase, found);
        let phase = &self.phases[phase];
        let position = phase.confine_position(found.position);
        match phase.exits[found.guard] {
            Exit::Reversal { forward, backward } => {
                let hold = Sticking::between(forward, backward);
                let mode = self.phases.mode_at_reversal(hold, position, forcing);
                Reset::new(position, 0.0, mode, CrossingKind::Reversal)
            }
            Exit::Switch(to) => {
                let mode = Mode::Moving(to);
                Reset::new(position, onward, mode, CrossingKind::Switch)
            }
            Exit::Forward(surface) => {
                let at = &self.phases[surface];
                let velocity = if moved { onward } else { 0.0 };
                match self.phases.beyond(at, self.fed) {
                    Beyond::Wall { restitution } => {
                        self.rebound(at, velocity, forcing, restitution)
                    }
                    Beyond::Phase(_) => self.pass_surface(at, velocity, forcing, true),
                }
            }
            Exit::Backward(surface) => {
                let at = &self.phases[surface];
                self.pass_surface(at, onward, forcing, false)
            }
        }
    }

    /// The reset where a surface is passed.
    fn pass_surface(&self, at: &Surface, velocity: f64, forcing: f64, forward: bool) -> Reset {
        let mode = self.phases.mode_at_surface(
            at,
            velocity,
            forcing,
            self.fed,
            self.bounce_train.rest_threshold(),
        );
        let held = matches!(mode, Mode::Held(_));
        let kind = CrossingKind::Surface {
            forward,
            impact: forward && at.is_clearance,
            pierces: forward && self.pierces_strip(at),
        };
        let velocity = if held { 0.0 } else { velocity };
        Reset::new(at.position, velocity, mode, kind)
    }

    /// The reset by Newton's impact law v+ = -R v-.
    fn rebound(&self, at: &Surface, velocity: f64, forcing: f64, restitution: f64) -> Reset {
        let kind = CrossingKind::Rebound {
            impact: at.is_clearance,
            pierces: self.pierces_strip(at),
        };
        let (position, speed) = (at.position, restitution * (at.side * velocity));
        let velocity = -at.side * speed;
        let hold = at.sticking_at(Beyond::Wall { restitution });
        let held = self.phases.mode_from_rest(hold, position, forcing);
        let rests = matches!(held, Mode::Held(_));
        let faint = || {
            let endless = restitution > MAX_RESTITUTION
                && self
                    .phases
                    .is_unresolved_bounce(at, speed, forcing, self.fed);
            speed < self.bounce_train.rest_threshold().slowest || endless
        };
        if speed == 0.0 || (rests && faint()) {
            return Reset::new(position, 0.0, held, kind);
        }
        let chatter = self.sum_bounces(at, speed, forcing, restitution);
        let mode = match chatter {
            Some(_) => Mode::Chattering(hold),
            None => Mode::Moving(self.phases.pressing_phase(at.before, position, velocity)),
        };
        Reset {
            chatter,
            ..Reset::new(position, velocity, mode, kind)
        }
    }

    /// The bounces that follow a rebound, where they can be summed.
    fn sum_bounces(
        &self,
        at: &Surface,
        speed: f64,
        forcing: f64,
        restitution: f64,
    ) -> Option<Chatter> {
        let phases = &*self.phases;
        let (out, back) = (at.before, phases.at_velocity(at.before, at.side));
        let rest = |phase| at.side * phases.acceleration(phase, at.position, 0.0, forcing);
        let slopes = [out, back].map(|phase| phases[phase].force_derivatives(at.position, 0.0));
        let largest = |values: [f64; 2]| values[0].abs().max(values[1].abs()) / phases.mass;
        let drive = phases.amplitude * phases.frequency;
        let velocity = -at.side * speed;
        let two_laws = back != out || phases.pressing_phase(out, at.position, velocity) != out;
        let pressing = PressingForces {
            accelerations: (rest(out), rest(back)),
            drive_rate: drive,
            forcing: self.force.on_arc().per_mass(0.0, phases.mass),
            damping: largest(slopes.map(|slope| slope.1)),
            stiffness: largest(slopes.map(|slope| slope.0)),
            period: self.clock().period(),
            grain: two_laws.then_some(f64::EPSILON * at.position.abs()),
        };
        let chatter = Chatter::from_speed(speed, restitution, &pressing)?;
        Some(chatter.on_side(at.side))
    }

    /// True if moving on to a surface pierces a strip that the stroke has not pierced yet.
    fn pierces_strip(&self, at: &Surface) -> bool {
        let fed = self.fed || at.beyond_unfed.is_none();
        at.is_far_side && fed && !self.pierced
    }
}
