//! What the mass may do after a crossing, by the state rules.

use softstop::PhaseKind;

use super::law::{Machine, Special};

/// What the mass does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mode {
    /// In a layer; `forward` tells the law under friction.
    Moving {
        layer: usize,
        forward: bool,
        released: bool,
    },
    /// Held between the law ahead (none before a wall) and the law behind.
    Held { upper: Option<usize>, lower: usize },
    /// Bouncing on the wall above a layer.
    Chatter { layer: usize },
}

/// Forces closer to balance than this share of their size cannot be told from it.
const BALANCE: f64 = 1e-11;
/// Bounces lower than this share of a position may count as rest.
const FAINT: f64 = 32.0 * f64::EPSILON;

impl Machine {
    pub fn kind(&self, mode: Mode) -> PhaseKind {
        match mode {
            Mode::Moving { released: true, .. } => PhaseKind::Released,
            Mode::Moving { layer, .. } => self.layers[layer].kind,
            Mode::Chatter { .. } => PhaseKind::Chatter,
            Mode::Held { upper, lower } => {
                let lower = self.layers[lower].kind;
                match upper.map(|upper| self.layers[upper].kind) {
                    Some(upper) if upper == lower => PhaseKind::Stuck,
                    _ => PhaseKind::Resting,
                }
            }
        }
    }

    /// How much contact pulls: -(k d + c v) or -(1 + lambda v) as (constant, by d, by v).
    pub fn pull(&self, layer: usize) -> Option<(f64, f64, f64)> {
        match self.layers[layer].special {
            Special::ZeroForce { stiffness, damping } => Some((0.0, -stiffness, -damping)),
            Special::Power { dissipation, .. } if dissipation > 0.0 => {
                Some((-1.0, 0.0, -dissipation))
            }
            _ => None,
        }
    }

    /// The modes of a mass that moves in a layer.
    pub fn moving(&self, layer: usize, position: f64, velocity: f64) -> Vec<Mode> {
        let at = &self.layers[layer];
        let forward = !at.friction || velocity > 0.0;
        let mode = |released| Mode::Moving {
            layer,
            forward,
            released,
        };
        let Some((constant, k, c)) = self.pull(layer) else {
            return vec![mode(false)];
        };
        let value = constant + k * (position - at.from) + c * velocity;
        let grain = 1e-14 * (constant.abs() + (k * position).abs() + (c * velocity).abs());
        let mut modes = Vec::new();
        if value > -grain {
            modes.push(mode(true));
        }
        if value < grain {
            modes.push(mode(false));
        }
        modes
    }

    /// Accelerations (times mass) by the law ahead and the law behind, with their grains.
    fn pushes(
        &self,
        position: f64,
        upper: Option<usize>,
        lower: usize,
        angle: f64,
    ) -> [(f64, f64); 2] {
        let forcing = self.amplitude * angle.cos();
        let by = |layer: usize, forward: bool| {
            let (force, size, rounding) = self.resistance(layer, forward, position);
            (forcing - force, BALANCE * size + rounding)
        };
        let ahead = upper.map_or((f64::NEG_INFINITY, 0.0), |upper| by(upper, true));
        [ahead, by(lower, false)]
    }

    /// The modes of a mass at rest between two laws.
    pub fn at_rest(
        &self,
        position: f64,
        upper: Option<usize>,
        lower: usize,
        angle: f64,
    ) -> Vec<Mode> {
        let [ahead, behind] = self.pushes(position, upper, lower, angle);
        let mut modes = Vec::new();
        if let Some(layer) = upper.filter(|_| ahead.0 >= -ahead.1) {
            modes.push(Mode::Moving {
                layer,
                forward: true,
                released: false,
            });
        }
        if ahead.0 <= ahead.1 && behind.0 <= behind.1 {
            let forward = !self.layers[lower].friction;
            modes.push(Mode::Moving {
                layer: lower,
                forward,
                released: false,
            });
        }
        if ahead.0 <= ahead.1 && behind.0 >= -behind.1 {
            modes.push(Mode::Held { upper, lower });
        }
        modes
    }

    /// The modes on the face between a layer and the next, reached with a velocity.
    pub fn on_face(&self, lower: usize, velocity: f64, angle: f64) -> Vec<Mode> {
        let position = self.layers[lower + 1].from;
        if velocity == 0.0 {
            return self.at_rest(position, Some(lower + 1), lower, angle);
        }
        let to = if velocity > 0.0 { lower + 1 } else { lower };
        let mut modes = self.moving(to, position, velocity);
        let [ahead, behind] = self.pushes(position, Some(lower + 1), lower, angle);
        let least = ahead.0.abs().min(behind.0.abs()) / self.mass;
        if velocity * velocity < 2.0 * least * FAINT * position.abs() {
            let held = |mode: &Mode| matches!(mode, Mode::Held { .. });
            let rest = self.at_rest(position, Some(lower + 1), lower, angle);
            modes.extend(rest.into_iter().filter(held));
        }
        modes
    }

    /// Whether a bounce off the wall is lower than the rounding of its position.
    pub fn faint(&self, layer: usize, velocity: f64, angle: f64) -> bool {
        let position = self.wall.map_or(f64::NAN, |wall| wall.0);
        let [_, behind] = self.pushes(position, None, layer, angle);
        velocity * velocity < 2.0 * behind.0 / self.mass * FAINT * position.abs()
    }

    /// The modes right after a hit on the wall above a layer.
    pub fn on_wall(&self, layer: usize, velocity: f64, angle: f64) -> Vec<Mode> {
        let Some((position, _)) = self.wall else {
            return Vec::new();
        };
        if velocity == 0.0 {
            return self.at_rest(position, None, layer, angle);
        }
        let mut modes = self.moving(layer, position, velocity);
        let [_, behind] = self.pushes(position, None, layer, angle);
        if behind.0 > -behind.1 {
            modes.push(Mode::Chatter { layer });
        }
        modes
    }

    /// The modes of any state at the start.
    pub fn at_start(&self, position: f64, velocity: f64, angle: f64) -> Vec<Mode> {
        let last = self.layers.len() - 1;
        if self.wall.is_some_and(|wall| position >= wall.0) && velocity == 0.0 {
            return self.at_rest(position, None, last, angle);
        }
        let layer = (0..=last)
            .rev()
            .find(|at| position >= self.layers[*at].from)
            .unwrap_or(0);
        if layer > 0 && position == self.layers[layer].from {
            return self.on_face(layer - 1, velocity, angle);
        }
        if velocity == 0.0 && self.layers[layer].friction {
            return self.at_rest(position, Some(layer), layer, angle);
        }
        self.moving(layer, position, velocity)
    }

    /// Time that bounces from a wall take which begin with a speed, under constant forces.
    pub fn bounces(&self, layer: usize, speed: f64, angle: f64) -> Option<f64> {
        let (position, restitution) = self.wall?;
        let forcing = self.amplitude * angle.cos();
        let acceleration =
            |forward| (forcing - self.resistance(layer, forward, position).0) / self.mass;
        let (out, back) = (acceleration(false), acceleration(true));
        let ratio = restitution * (back / out).sqrt();
        let first = speed * (1.0 / out + 1.0 / (out * back).sqrt());
        (out > 0.0 && back > 0.0 && ratio < 1.0).then(|| first / (1.0 - ratio))
    }
}
