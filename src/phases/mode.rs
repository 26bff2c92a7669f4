//! Which mode holds at a given state, the mass moving in a phase or held: by position, then by velocity, then by acceleration.
//!
//! At rest on a surface or under dry friction the force is set-valued (Filippov 1988). The mass
//! leaves forward if the law ahead accelerates it forward, back if the law behind accelerates it
//! back, and is held otherwise. A held mass leaves at the first time at which one of the two
//! accelerations becomes favourable, so jerk and all higher derivatives decide by themselves.

use serde::{Deserialize, Serialize};

use crate::events::Guard;

use super::{Beyond, Layer, PhaseId, PhaseKind, Phases, Surface};

/// Bounces that count as rest: those lower or slower than this.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RestThreshold {
    /// Least height, relative to the position of the surface.
    pub height: f64,
    /// Least speed in m/s.
    pub slowest: f64,
}

impl RestThreshold {
    /// Four units in the last place of the position: lower bounces cannot be described.
    pub const ROUNDING: Self = Self {
        height: 4.0 * f64::EPSILON,
        slowest: 0.0,
    };
}

/// Whether the mass moves, and in which phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Mode {
    /// The mass moves in this phase.
    Moving(PhaseId),
    /// The mass is held.
    Held(Sticking),
    /// The mass bounces on a rigid stop until it rests there.
    Chattering(Sticking),
}

/// A mass that is held, by the phases in which it would leave.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sticking {
    /// Phase in which it leaves upwards; none under a rigid stop.
    pub forward: Option<PhaseId>,
    /// Phase in which it leaves downwards; none on a rigid stop below.
    pub backward: Option<PhaseId>,
}

impl Sticking {
    /// A mass that sticks between two laws that give way.
    pub(crate) const fn between(forward: PhaseId, backward: PhaseId) -> Self {
        Self {
            forward: Some(forward),
            backward: Some(backward),
        }
    }

    /// The phases in which the sticking mass would leave.
    pub(crate) fn phases(self) -> impl Iterator<Item = PhaseId> {
        self.forward.into_iter().chain(self.backward)
    }

    /// The one of the sticking mass's phases that is farther from the stop.
    pub(crate) fn outer_phase(self) -> PhaseId {
        self.phases()
            .min_by_key(|phase| phase.index())
            .unwrap_or(PhaseId::FREE)
    }

    /// What follows when one of the guards of [`Phases::release_guards`] lets the mass go.
    pub(crate) fn after_release(self, guard: usize) -> Mode {
        let phase = self.phases().nth(guard);
        phase.map_or(Mode::Held(self), Mode::Moving)
    }
}

impl Mode {
    /// The phase in which the mass moves in this mode.
    pub fn phase(self) -> Option<PhaseId> {
        match self {
            Self::Moving(phase) => Some(phase),
            Self::Held(_) | Self::Chattering(_) => None,
        }
    }

    /// The phases in which the mass would leave in this mode, where it does not move in one.
    pub(crate) fn sticking(self) -> Option<Sticking> {
        match self {
            Self::Moving(_) => None,
            Self::Held(hold) | Self::Chattering(hold) => Some(hold),
        }
    }
}

impl Surface {
    /// A mass at rest on this surface, with this beyond it.
    pub(crate) fn sticking_at(&self, beyond: Beyond) -> Sticking {
        let inward = match beyond {
            Beyond::Phase(phase) => Some(phase),
            Beyond::Wall { .. } => None,
        };
        let outward = Some(self.before);
        let (forward, backward) = match self.side < 0.0 {
            true => (outward, inward),
            false => (inward, outward),
        };
        Sticking { forward, backward }
    }
}

impl Phases {
    /// The mode at any state. `forcing` is the external force per mass in m/s^2, `fed` says whether a
    /// strip lies beyond the clearance.
    pub fn mode_at(&self, position: f64, velocity: f64, forcing: f64, fed: bool) -> Mode {
        if velocity == 0.0
            && let Some(wall) = self.walls().find(|wall| wall.is_reached(position))
        {
            return self.mode_from_rest(wall.sticking_at(wall.beyond), position, forcing);
        }
        match self.layer_at(position, fed) {
            Some(layer) if position == layer.from => {
                let rounding = RestThreshold::ROUNDING;
                self.mode_at_surface(&self[layer.surface], velocity, forcing, fed, rounding)
            }
            _ => match self.laws_at(position, velocity, fed) {
                [forward, backward] if forward == backward => Mode::Moving(forward),
                [forward, backward] => {
                    self.mode_from_rest(Sticking::between(forward, backward), position, forcing)
                }
            },
        }
    }

    fn layer_at(&self, position: f64, fed: bool) -> Option<&Layer> {
        let above = if fed { &self.fed } else { &self.unfed };
        let layer = above.layer_at(position);
        layer.or_else(|| self.below.layer_at(position))
    }

    /// The phases whose laws hold at a state, wherever it is: of the way forward and of the way back under
    /// dry friction at rest, twice the same one else.
    pub fn laws_at(&self, position: f64, velocity: f64, fed: bool) -> [PhaseId; 2] {
        let Some(layer) = self.layer_at(position, fed) else {
            return [PhaseId::FREE; 2];
        };
        let pressing = |phase| self.pressing_phase(phase, position, velocity);
        if layer.forward == layer.backward || velocity > 0.0 {
            [pressing(layer.forward); 2]
        } else if velocity < 0.0 {
            [pressing(layer.backward); 2]
        } else {
            [layer.forward, layer.backward]
        }
    }

    /// This phase, or the one that holds instead where contact would pull.
    pub(crate) fn pressing_phase(&self, phase: PhaseId, position: f64, velocity: f64) -> PhaseId {
        match self[phase].released {
            Some((released, pulls)) if pulls.value_at(position, velocity) > 0.0 => released,
            _ => phase,
        }
    }

    /// What lies beyond a surface, with a strip fed or not.
    pub fn beyond(&self, at: &Surface, fed: bool) -> Beyond {
        if fed {
            at.beyond
        } else {
            at.beyond_unfed.unwrap_or(at.beyond)
        }
    }

    /// The mode after reaching a surface under a forcing per mass, with a strip beyond the clearance (`fed`) or without.
    /// Where both sides press the mass onto it, a bounce below the threshold counts as rest.
    pub(crate) fn mode_at_surface(
        &self,
        at: &Surface,
        velocity: f64,
        forcing: f64,
        fed: bool,
        RestThreshold { height, slowest }: RestThreshold,
    ) -> Mode {
        let beyond = self.beyond(at, fed);
        let held = self.mode_from_rest(at.sticking_at(beyond), at.position, forcing);
        let rests = matches!(held, Mode::Held(_));
        let faint = || {
            velocity.abs() < slowest
                || self.bounce_height(at, beyond, velocity, forcing) < height * at.position.abs()
                || self.is_unresolved_bounce(at, velocity, forcing, fed)
        };
        if velocity == 0.0 || (rests && faint()) {
            held
        } else if at.side * velocity < 0.0 {
            Mode::Moving(self.pressing_phase(at.before, at.position, velocity))
        } else if let Beyond::Phase(beyond) = beyond {
            Mode::Moving(self.pressing_phase(beyond, at.position, velocity))
        } else {
            held
        }
    }

    /// The mode of a mass at rest between two laws.
    pub(crate) fn mode_from_rest(&self, hold: Sticking, position: f64, forcing: f64) -> Mode {
        let acceleration = |phase| self.acceleration(phase, position, 0.0, forcing);
        match hold {
            Sticking {
                forward: Some(phase),
                ..
            } if acceleration(phase) > 0.0 => Mode::Moving(phase),
            Sticking {
                backward: Some(phase),
                ..
            } if acceleration(phase) < 0.0 => Mode::Moving(phase),
            _ => Mode::Held(hold),
        }
    }

    /// The mode of a mass that has come to rest under dry friction. Within rounding of a balance it is
    /// held: a creep that ends there would else turn back and forth for ever.
    pub(crate) fn mode_at_reversal(&self, hold: Sticking, position: f64, forcing: f64) -> Mode {
        let balanced = |id: PhaseId| {
            let phase = &self[id];
            let pull = phase.flow.modes.stiffness * position;
            let size = forcing.abs() + (phase.law.force / self.mass).abs() + pull.abs();
            self.acceleration(id, position, 0.0, forcing).abs() <= 4.0 * f64::EPSILON * size
        };
        if hold.phases().any(balanced) {
            return Mode::Held(hold);
        }
        self.mode_from_rest(hold, position, forcing)
    }

    /// The guards that let a mass go that is held since the forcing was `forcing`; [`Sticking::after_release`] says where.
    pub(crate) fn release_guards(&self, hold: Sticking, position: f64, forcing: f64) -> Vec<Guard> {
        let balance = |phase| -self.acceleration(phase, position, 0.0, 0.0);
        // A hold may begin within rounding of a balance; the guard then begins at zero.
        let on = |phase| Guard::forcing_above(balance(phase).max(forcing));
        let back = |phase| Guard::forcing_above(balance(phase).min(forcing)).negated();
        let (forward, backward) = (hold.forward.map(on), hold.backward.map(back));
        forward.into_iter().chain(backward).collect()
    }

    /// True if a bounce that leaves a surface with a velocity in m/s cannot be told from none: lower than four units in the last
    /// place of the position, or as slow as what the force brings about within the resolution of time.
    pub(crate) fn is_unresolved_bounce(
        &self,
        at: &Surface,
        leaving_velocity: f64,
        forcing: f64,
        fed: bool,
    ) -> bool {
        let beyond = self.beyond(at, fed);
        let height = self.bounce_height(at, beyond, leaving_velocity, forcing);
        let period = std::f64::consts::TAU / self.frequency;
        let resolution = 4.0 * f64::EPSILON * period;
        // A bounce of height h under the acceleration a takes v / a each way.
        2.0 * height < resolution * leaving_velocity.abs()
            || height < RestThreshold::ROUNDING.height * at.position.abs()
    }

    /// Height v^2 / (2 a) in m of the bounce that would follow, on its higher side.
    fn bounce_height(&self, at: &Surface, beyond: Beyond, velocity: f64, forcing: f64) -> f64 {
        let acceleration = |phase| self.acceleration(phase, at.position, 0.0, forcing).abs();
        let sides = at.sticking_at(beyond).phases().map(acceleration);
        velocity * velocity / (2.0 * sides.fold(f64::INFINITY, f64::min))
    }

    /// What a mode is in the machine.
    pub fn kind(&self, mode: Mode) -> PhaseKind {
        match mode {
            Mode::Moving(phase) => self[phase].kind,
            Mode::Chattering(_) => PhaseKind::Chatter,
            Mode::Held(Sticking { forward, backward }) => {
                let kind = |phase: PhaseId| self[phase].kind;
                if forward.map(kind) == backward.map(kind) {
                    PhaseKind::Stuck
                } else {
                    PhaseKind::Resting
                }
            }
        }
    }
}
