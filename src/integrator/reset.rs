//! What a crossing leads to: state, mode and kind right after it.

use super::motion::Motion;
use super::observer::CrossingKind;
use super::start::Start;
use crate::events::Found;
use crate::flow::{Chatter, Drive, Polynomial, Pressing};
use crate::phases::{Beyond, Exit, Mode, PhaseId, Phases, Sticking, Surface, SurfaceId, Threshold};

/// Restitution above which bounces shrink by viscous damping rather than by the impacts: they then come
/// to no end in finite time, as those on a preloaded face.
const ENDLESS: f64 = 1.0 - 1.0 / (1u64 << 16) as f64;

/// State, mode and kind of a crossing, right after it.
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
    /// The surface that a guard of a phase watches, if bounces on it may go on for ever.
    pub(crate) fn endless_surface(&self, phase: PhaseId, guard: usize) -> Option<SurfaceId> {
        let surface = match self[phase].exits[guard] {
            Exit::Forward(surface) | Exit::Backward(surface) => surface,
            Exit::Reversal { .. } | Exit::Switch(_) => return None,
        };
        let endless = match self[surface].beyond {
            Beyond::Phase(_) => true,
            Beyond::Wall { restitution } => restitution > ENDLESS,
        };
        endless.then_some(surface)
    }

    /// The velocity of a crossing out of a phase: rounding may turn that of a touch the other way.
    #[inline]
    pub(super) fn onward(&self, phase: PhaseId, found: &Found) -> f64 {
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
    /// The surface that a guard watches, if bounces on it may go on for ever.
    pub(super) fn surface_of(&self, guard: usize) -> Option<SurfaceId> {
        self.phases.endless_surface(self.mode.phase()?, guard)
    }

    /// State and mode right after a crossing; `moved` as for [`ResetContext::leave`].
    pub(super) fn land(&self, found: &Found, push: f64, moved: bool) -> Reset {
        match self.mode {
            Mode::Moving(phase) => self.ground().leave(phase, found, push, moved),
            Mode::Held(hold) | Mode::Chattering(hold) => {
                let mode = hold.released(found.guard);
                Reset::new(found.position, 0.0, mode, CrossingKind::Release)
            }
        }
    }

    fn ground(&self) -> ResetContext<'_> {
        ResetContext {
            phases: &self.phases,
            fed: self.fed,
            pierced: self.pierced,
            threshold: self.hum.threshold(),
            force: self.force.on_arc(),
            period: self.clock().period(),
        }
    }

    /// Remembers whether the strip of this stroke is pierced.
    pub(super) fn note_strip(&mut self, kind: CrossingKind) {
        if kind.pierces() {
            self.pierced = true;
        } else if matches!(kind, CrossingKind::Surface { impact: true, .. }) {
            self.pierced = false;
        }
    }

    /// Acceleration in m/s^2 with which a mass at rest starts in a mode: the very number by which the
    /// mode was chosen.
    pub(super) fn acceleration_at_rest(&self, position: f64, drive: Drive, mode: Mode) -> f64 {
        match (self.mode, mode) {
            (Mode::Moving(_) | Mode::Chattering(_), Mode::Moving(phase)) => {
                let push = self.push(drive);
                self.phases.acceleration(phase, position, 0.0, push)
            }
            // A held mass is let go in balance.
            _ => 0.0,
        }
    }

    /// Push of drive and external force per mass, in m/s^2, at the start of the present arc.
    pub(super) fn push(&self, drive: Drive) -> f64 {
        self.phases.push(drive, self.force.on_arc())
    }

    /// Acceleration in m/s^2 in a mode.
    pub(super) fn acceleration(&self, mode: Mode, at: Start, push: f64) -> f64 {
        let Start { position, velocity } = at;
        let moving = |phase| self.phases.acceleration(phase, position, velocity, push);
        mode.phase().map_or(0.0, moving)
    }
}

/// What the rules of a landing ask for.
pub(crate) struct ResetContext<'a> {
    pub phases: &'a Phases,
    /// A strip lies beyond the clearance.
    pub fed: bool,
    /// The strip of this stroke is pierced.
    pub pierced: bool,
    /// What counts as a bounce.
    pub threshold: Threshold,
    /// The external force in N from now on.
    pub force: &'a Polynomial,
    /// Drive period in s.
    pub period: f64,
}

impl ResetContext<'_> {
    /// State and mode right after a crossing out of a phase; `moved` is false for a mass that is back at
    /// once where it left rest.
    pub(crate) fn leave(&self, phase: PhaseId, found: &Found, push: f64, moved: bool) -> Reset {
        let onward = self.phases.onward(phase, found);
        let phase = &self.phases[phase];
        let position = phase.confine(found.position);
        match phase.exits[found.guard] {
            Exit::Reversal { forward, backward } => {
                let hold = Sticking::between(forward, backward);
                let mode = self.phases.turn(hold, position, push);
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
                    Beyond::Wall { restitution } => self.rebound(at, velocity, push, restitution),
                    Beyond::Phase(_) => self.pass(at, velocity, push, true),
                }
            }
            Exit::Backward(surface) => {
                let at = &self.phases[surface];
                self.pass(at, onward, push, false)
            }
        }
    }

    fn pass(&self, at: &Surface, velocity: f64, push: f64, forward: bool) -> Reset {
        let mode = self
            .phases
            .at_surface(at, velocity, push, self.fed, self.threshold);
        let held = matches!(mode, Mode::Held(_));
        let kind = CrossingKind::Surface {
            forward,
            impact: forward && at.is_clearance,
            pierces: forward && self.pierces(at),
        };
        let velocity = if held { 0.0 } else { velocity };
        Reset::new(at.position, velocity, mode, kind)
    }

    /// Newton's impact law v+ = -R v-.
    fn rebound(&self, at: &Surface, velocity: f64, push: f64, restitution: f64) -> Reset {
        let kind = CrossingKind::Rebound {
            impact: at.is_clearance,
            pierces: self.pierces(at),
        };
        let (position, speed) = (at.position, restitution * (at.side * velocity));
        let velocity = -at.side * speed;
        let hold = at.hold(Beyond::Wall { restitution });
        let held = self.phases.leave(hold, position, push);
        let rests = matches!(held, Mode::Held(_));
        let faint = || {
            let endless = restitution > ENDLESS && self.phases.is_faint(at, speed, push, self.fed);
            speed < self.threshold.slowest || endless
        };
        if speed == 0.0 || (rests && faint()) {
            return Reset::new(position, 0.0, held, kind);
        }
        let chatter = self.chatter(at, speed, push, restitution);
        let mode = match chatter {
            Some(_) => Mode::Chattering(hold),
            None => Mode::Moving(self.phases.pressing(at.before, position, velocity)),
        };
        Reset {
            chatter,
            ..Reset::new(position, velocity, mode, kind)
        }
    }

    /// The bounces that follow a rebound, where they can be summed.
    fn chatter(&self, at: &Surface, speed: f64, push: f64, restitution: f64) -> Option<Chatter> {
        let phases = self.phases;
        let (out, back) = (at.before, phases.at_velocity(at.before, at.side));
        let rest = |phase| at.side * phases.acceleration(phase, at.position, 0.0, push);
        let slopes = [out, back].map(|phase| phases[phase].slopes(at.position, 0.0));
        let largest = |values: [f64; 2]| values[0].abs().max(values[1].abs()) / phases.mass;
        let drive = phases.amplitude * phases.frequency;
        let velocity = -at.side * speed;
        let two_laws = back != out || phases.pressing(out, at.position, velocity) != out;
        let pressing = Pressing {
            accelerations: (rest(out), rest(back)),
            drive_rate: drive,
            push: self.force.per_mass(0.0, phases.mass),
            damping: largest(slopes.map(|slope| slope.1)),
            stiffness: largest(slopes.map(|slope| slope.0)),
            period: self.period,
            grain: two_laws.then_some(f64::EPSILON * at.position.abs()),
        };
        let chatter = Chatter::from_speed(speed, restitution, &pressing)?;
        Some(chatter.on_side(at.side))
    }

    /// True if moving on to a surface pierces a strip that the stroke has not pierced yet.
    fn pierces(&self, at: &Surface) -> bool {
        let fed = self.fed || at.beyond_unfed.is_none();
        at.is_far_side && fed && !self.pierced
    }
}
