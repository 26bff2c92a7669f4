//! Which phase holds at a given state: by position, then by velocity, then by acceleration.
//!
//! At rest on a surface or under dry friction the force is set-valued (Filippov 1988). The mass
//! leaves forward if the law ahead accelerates it forward, back if the law behind accelerates it
//! back, and is held otherwise. A held mass leaves at the first time at which one of the two
//! accelerations becomes favourable, so jerk and all higher derivatives decide by themselves.

use serde::{Deserialize, Serialize};

use crate::events::Guard;

use super::{Beyond, Layer, PhaseKind, Phases, Surface};

/// What counts as a bounce.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Threshold {
    /// Least height, relative to the position of the surface.
    pub height: f64,
    /// Least speed in m/s.
    pub slowest: f64,
}

impl Threshold {
    /// Four units in the last place of the position: lower bounces cannot be described.
    pub const ROUNDING: Self = Self {
        height: 4.0 * f64::EPSILON,
        slowest: 0.0,
    };
}

/// What the mass does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Mode {
    /// It moves in this phase.
    Moving(usize),
    /// It is held.
    Held(Hold),
    /// It bounces on a rigid stop until it rests there.
    Chattering(Hold),
}

/// The phases in which a mass at rest would leave.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Hold {
    /// Phase of the way forward; none before a rigid stop.
    pub forward: Option<usize>,
    /// Phase of the way back.
    pub backward: usize,
}

impl Hold {
    /// Between two laws that give way.
    pub(crate) const fn between(forward: usize, backward: usize) -> Self {
        Self {
            forward: Some(forward),
            backward,
        }
    }

    /// Both.
    pub(crate) fn phases(self) -> impl Iterator<Item = usize> {
        self.forward.into_iter().chain([self.backward])
    }
}

impl Mode {
    /// The phase in which it moves.
    pub fn phase(self) -> Option<usize> {
        match self {
            Self::Moving(phase) => Some(phase),
            Self::Held(_) | Self::Chattering(_) => None,
        }
    }

    /// The phases in which it would leave, where it does not move in one.
    pub(crate) fn hold(self) -> Option<Hold> {
        match self {
            Self::Moving(_) => None,
            Self::Held(hold) | Self::Chattering(hold) => Some(hold),
        }
    }
}

impl Surface {
    /// A mass at rest on it, with this above it.
    pub(crate) fn hold(&self, above: Beyond) -> Hold {
        let forward = match above {
            Beyond::Phase(phase) => Some(phase),
            Beyond::Wall { .. } => None,
        };
        Hold {
            forward,
            backward: self.below,
        }
    }
}

impl Phases {
    /// The mode at any state. `push` is the external force per mass in m/s^2, `fed` says whether a
    /// strip lies beyond the clearance.
    pub fn locate(&self, position: f64, velocity: f64, push: f64, fed: bool) -> Mode {
        let stack = if fed { &self.fed } else { &self.unfed };
        if let Some(wall) = stack.wall.map(|wall| self.surfaces[wall])
            && position >= wall.position
            && velocity == 0.0
        {
            return self.leave(wall.hold(wall.above), position, push);
        }
        let Some(layer) = stack
            .layers
            .iter()
            .rev()
            .find(|layer| position >= layer.from)
        else {
            return Mode::Moving(0);
        };
        if position == layer.from {
            let surface = self.surfaces[layer.surface];
            return self.at_surface(&surface, velocity, push, fed, Threshold::ROUNDING);
        }
        self.inside(layer, position, velocity, push)
    }

    fn inside(&self, layer: &Layer, position: f64, velocity: f64, push: f64) -> Mode {
        if layer.forward == layer.backward || velocity > 0.0 {
            self.moving(layer.forward, position, velocity)
        } else if velocity < 0.0 {
            self.moving(layer.backward, position, velocity)
        } else {
            let hold = Hold::between(layer.forward, layer.backward);
            self.leave(hold, position, push)
        }
    }

    /// The phases whose laws hold at a state, wherever it is: of the way forward and of the way back under
    /// dry friction at rest, twice the same one else.
    pub fn laws_at(&self, position: f64, velocity: f64, fed: bool) -> [usize; 2] {
        let stack = if fed { &self.fed } else { &self.unfed };
        let mut below = stack.layers.iter().rev();
        let Some(layer) = below.find(|layer| position >= layer.from) else {
            return [0; 2];
        };
        let pressing = |phase: usize| self.pressing(phase, position, velocity);
        if layer.forward == layer.backward || velocity > 0.0 {
            [pressing(layer.forward); 2]
        } else if velocity < 0.0 {
            [pressing(layer.backward); 2]
        } else {
            [layer.forward, layer.backward]
        }
    }

    /// The mode of a mass that moves in a phase, or in the one that holds where contact would pull.
    pub(crate) fn moving(&self, phase: usize, position: f64, velocity: f64) -> Mode {
        Mode::Moving(self.pressing(phase, position, velocity))
    }

    fn pressing(&self, phase: usize, position: f64, velocity: f64) -> usize {
        match self.phases[phase].released {
            Some((released, pulls)) if pulls.value(position, velocity) > 0.0 => released,
            _ => phase,
        }
    }

    /// What lies above a surface.
    pub fn beyond(&self, at: &Surface, fed: bool) -> Beyond {
        if fed {
            at.above
        } else {
            at.above_unfed.unwrap_or(at.above)
        }
    }

    /// The mode after reaching a surface. Where both sides press the mass onto it, a bounce below
    /// the threshold counts as rest.
    pub(crate) fn at_surface(
        &self,
        at: &Surface,
        velocity: f64,
        push: f64,
        fed: bool,
        Threshold { height, slowest }: Threshold,
    ) -> Mode {
        let above = self.beyond(at, fed);
        let held = self.leave(at.hold(above), at.position, push);
        let rests = matches!(held, Mode::Held(_));
        let faint = || {
            velocity.abs() < slowest
                || self.bounce(at, above, velocity, push) < height * at.position.abs()
                || self.is_faint(at, velocity, push, fed)
        };
        if velocity == 0.0 || (rests && faint()) {
            held
        } else if velocity < 0.0 {
            self.moving(at.below, at.position, velocity)
        } else if let Beyond::Phase(above) = above {
            self.moving(above, at.position, velocity)
        } else {
            held
        }
    }

    /// The mode of a mass at rest between two laws.
    pub(crate) fn leave(&self, hold: Hold, position: f64, push: f64) -> Mode {
        let acceleration =
            |phase: usize| self.phases[phase].acceleration_from_rest(position, push, self.mass);
        match hold.forward {
            Some(phase) if acceleration(phase) > 0.0 => Mode::Moving(phase),
            _ if acceleration(hold.backward) < 0.0 => Mode::Moving(hold.backward),
            _ => Mode::Held(hold),
        }
    }

    /// The mode of a mass that has come to rest under dry friction. Within rounding of a balance it is
    /// held: a creep that ends there would else turn back and forth for ever.
    pub(crate) fn turn(&self, hold: Hold, position: f64, push: f64) -> Mode {
        let balanced = |phase: usize| {
            let law = &self.phases[phase];
            let pull = law.flow.modes.stiffness * position;
            let size = push.abs() + (law.law.force / self.mass).abs() + pull.abs();
            let acceleration = law.acceleration_from_rest(position, push, self.mass);
            acceleration.abs() <= 4.0 * f64::EPSILON * size
        };
        if hold.phases().any(balanced) {
            return Mode::Held(hold);
        }
        self.leave(hold, position, push)
    }

    /// The guards that let a mass go that is held since the push was `push`, each with the phase that it
    /// leads to.
    pub(crate) fn releases(
        &self,
        Hold { forward, backward }: Hold,
        position: f64,
        push: f64,
    ) -> ([Guard; 2], [usize; 2], usize) {
        let balance = |phase: usize| {
            let phase = &self.phases[phase];
            -phase.acceleration_from_rest(position, 0.0, self.mass)
        };
        // A hold may begin within rounding of a balance; the guard then begins at zero.
        let back = Guard::push_below(balance(backward).min(push));
        match forward {
            Some(forward) => {
                let on = Guard::push_above(balance(forward).max(push));
                ([on, back], [forward, backward], 2)
            }
            None => ([back, back], [backward, backward], 1),
        }
    }

    /// True if a bounce cannot be told from none: lower than four units in the last place of the
    /// position, or as slow as what the force brings about within the resolution of time.
    pub(crate) fn is_faint(&self, at: &Surface, velocity: f64, push: f64, fed: bool) -> bool {
        let above = self.beyond(at, fed);
        let height = self.bounce(at, above, velocity, push);
        let period = std::f64::consts::TAU / self.held.frequency;
        let resolution = 4.0 * f64::EPSILON * period;
        // A bounce of height h under the acceleration a takes v / a each way.
        2.0 * height < resolution * velocity.abs()
            || height < Threshold::ROUNDING.height * at.position.abs()
    }

    /// Height v^2 / (2 a) in m of the bounce that would follow, on its higher side.
    fn bounce(&self, at: &Surface, above: Beyond, velocity: f64, push: f64) -> f64 {
        let acceleration = |phase: usize| {
            self.phases[phase]
                .acceleration_from_rest(at.position, push, self.mass)
                .abs()
        };
        let sides = at.hold(above).phases().map(acceleration);
        velocity * velocity / (2.0 * sides.fold(f64::INFINITY, f64::min))
    }

    /// What a mode is in the machine.
    pub fn kind(&self, mode: Mode) -> PhaseKind {
        match mode {
            Mode::Moving(phase) => self.phases[phase].kind,
            Mode::Chattering(_) => PhaseKind::Chatter,
            Mode::Held(Hold { forward, backward }) => {
                let kind = |phase: usize| self.phases[phase].kind;
                if forward.map(kind) == Some(kind(backward)) {
                    PhaseKind::Stuck
                } else {
                    PhaseKind::Resting
                }
            }
        }
    }
}
