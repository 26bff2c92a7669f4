//! Which phase holds at a given state: by position, then by velocity, then by acceleration.
//!
//! At rest on a surface or under dry friction the force is set-valued (Filippov 1988). The mass
//! leaves forward if the law ahead accelerates it forward, back if the law behind accelerates it
//! back, and is held otherwise. A held mass leaves at the first time at which one of the two
//! accelerations becomes favourable, so jerk and all higher derivatives decide by themselves.

use crate::events::Guard;

use super::{Layer, PhaseKind, Phases, Surface};

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
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// It moves in this phase.
    Moving(usize),
    /// It is held; it would leave in one of these phases.
    Held {
        /// Phase of the way forward.
        forward: usize,
        /// Phase of the way back.
        backward: usize,
    },
}

impl Phases {
    /// The mode at any state. `push` is the external force per mass in m/s^2, `fed` says whether a
    /// strip lies beyond the clearance.
    pub fn locate(&self, position: f64, velocity: f64, push: f64, fed: bool) -> Mode {
        let layers = if fed { &self.fed } else { &self.unfed };
        let Some(layer) = layers.iter().rev().find(|layer| position >= layer.from) else {
            return Mode::Moving(0);
        };
        if position == layer.from {
            let mut surface = self.surfaces[layer.surface];
            surface.above = layer.forward;
            return self.at_surface(&surface, velocity, push, fed, Threshold::ROUNDING);
        }
        self.inside(layer, position, velocity, push)
    }

    fn inside(&self, layer: &Layer, position: f64, velocity: f64, push: f64) -> Mode {
        if layer.forward == layer.backward || velocity > 0.0 {
            Mode::Moving(layer.forward)
        } else if velocity < 0.0 {
            Mode::Moving(layer.backward)
        } else {
            self.leave_rest(layer.forward, layer.backward, position, push)
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
        let above = if fed {
            at.above
        } else {
            at.above_unfed.unwrap_or(at.above)
        };
        let held = self.leave_rest(above, at.below, at.position, push);
        let rests = matches!(held, Mode::Held { .. });
        let faint = || {
            velocity.abs() < slowest
                || self.bounce(at, above, velocity, push) < height * at.position.abs()
        };
        if velocity == 0.0 || (rests && faint()) {
            held
        } else if velocity > 0.0 {
            Mode::Moving(above)
        } else {
            Mode::Moving(at.below)
        }
    }

    /// The mode of a mass at rest between two laws.
    pub(crate) fn leave_rest(
        &self,
        forward: usize,
        backward: usize,
        position: f64,
        push: f64,
    ) -> Mode {
        let acceleration =
            |phase: usize| self.phases[phase].acceleration_from_rest(position, push, self.mass);
        if acceleration(forward) > 0.0 {
            Mode::Moving(forward)
        } else if acceleration(backward) < 0.0 {
            Mode::Moving(backward)
        } else {
            Mode::Held { forward, backward }
        }
    }

    /// The guards that let a held mass go: forward first, then back.
    pub(crate) fn release_guards(
        &self,
        forward: usize,
        backward: usize,
        position: f64,
    ) -> [Guard; 2] {
        let balance = |phase: usize| {
            let phase = &self.phases[phase];
            phase.flow.modes.stiffness * position - phase.law.force / self.mass
        };
        [
            Guard::push_above(balance(forward)),
            Guard::push_below(balance(backward)),
        ]
    }

    /// Height v^2 / (2 a) in m of the bounce that would follow, on its higher side.
    fn bounce(&self, at: &Surface, above: usize, velocity: f64, push: f64) -> f64 {
        let acceleration = |phase: usize| {
            self.phases[phase]
                .acceleration_from_rest(at.position, push, self.mass)
                .abs()
        };
        velocity * velocity / (2.0 * acceleration(above).min(acceleration(at.below)))
    }

    /// What a mode is in the machine.
    pub fn kind(&self, mode: Mode) -> PhaseKind {
        match mode {
            Mode::Moving(phase) => self.phases[phase].kind,
            Mode::Held { forward, backward } => {
                let same = self.phases[forward].kind == self.phases[backward].kind;
                if same {
                    PhaseKind::Stuck
                } else {
                    PhaseKind::Resting
                }
            }
        }
    }
}
