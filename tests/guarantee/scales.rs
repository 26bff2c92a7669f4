//! What rounding may leave, and the conditions that may end a leg.

use super::law::Machine;
use super::motion::{Departure, Motion};
use super::piece::Guard;

/// What rounding may leave, relative to the natural sizes of an arc.
pub const GRAIN: f64 = 1e-12;
/// Size of what a motion has died down to in the end.
const NOTHING: f64 = 1e-30;
/// What rounding may leave of position and velocity, and the sizes it refers to.
pub struct Scales {
    pub x: f64,
    pub v: f64,
    pub length: f64,
    pub speed: f64,
    /// Size of the positions.
    pub span: f64,
}

impl Scales {
    pub fn new(machine: &Machine, at: &Departure, motion: &Motion, time: f64) -> Self {
        let (length, speed) = motion.sizes();
        let growth = motion.growth();
        let (length, speed) = (
            (length * growth).max(NOTHING),
            (speed * growth).max(NOTHING),
        );
        let law = machine.layers[at.layer].up;
        let frequency = ((machine.stiffness + law.stiffness) / machine.mass).sqrt();
        let face = machine.layers[at.layer.max(1).min(machine.layers.len() - 1)].from;
        let face = if face.is_finite() { face.abs() } else { 0.0 };
        let span = at.position.abs() + face + length;
        let rounding = 8.0 * f64::EPSILON * span * growth;
        Self {
            x: GRAIN * (length + speed * time.min(1.0 / machine.frequency)) + rounding,
            v: GRAIN * speed + frequency * rounding,
            length,
            speed,
            span,
        }
    }

    /// Whatever may end the leg.
    pub fn guards(&self, machine: &Machine, at: &Departure) -> Vec<(&'static str, Guard)> {
        let face = |position: f64, sign: f64| Guard {
            constant: sign * (at.position - position),
            u: sign,
            v: 0.0,
            grain: self.x,
            size: self.span,
        };
        let layer = &machine.layers[at.layer];
        let mut guards = Vec::with_capacity(4);
        if let Some(top) = machine.top(at.layer) {
            guards.push(("the surface ahead", face(top, 1.0)));
        }
        if at.layer > 0 {
            guards.push(("the surface behind", face(layer.from, -1.0)));
        }
        if layer.friction {
            let v = if at.forward { -1.0 } else { 1.0 };
            let guard = Guard {
                constant: 0.0,
                u: 0.0,
                v,
                grain: self.v,
                size: self.speed,
            };
            guards.push(("a reversal", guard));
        }
        guards.extend(self.pull(machine, at).map(|guard| ("a switch", guard)));
        guards
    }

    /// The guard of contact that ceases or begins to press.
    pub fn pull(&self, machine: &Machine, at: &Departure) -> Option<Guard> {
        let (constant, k, c) = machine.pull(at.layer)?;
        let sign = if at.released { -1.0 } else { 1.0 };
        let depth = at.position - machine.layers[at.layer].from;
        Some(Guard {
            constant: sign * (constant + k * depth),
            u: sign * k,
            v: sign * c,
            grain: k.abs() * self.x + c.abs() * self.v,
            size: constant.abs() + k.abs() * self.length + c.abs() * self.speed,
        })
    }
}
