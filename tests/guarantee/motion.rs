//! The oracle's motion of one leg, and the search over all of it.

use super::law::{Machine, Special};
use super::linear::{Linear, Setting};
use super::piece::{Guard, Piece, Seen, State, Watch, search};
use super::power::{Power, Steps};

/// Linear or not.
pub enum Motion {
    Linear(Linear, f64),
    Steps(Steps),
}

/// A layer, the way through it, and the state to start from.
#[derive(Debug, Clone, Copy)]
pub struct Departure {
    pub layer: usize,
    pub forward: bool,
    pub released: bool,
    pub position: f64,
    pub velocity: f64,
    pub angle: f64,
}

impl Motion {
    /// The motion over a time; none if it costs too much.
    pub fn new(machine: &Machine, at: &Departure, time: f64, budget: &mut u64) -> Option<Self> {
        let layer = &machine.layers[at.layer];
        let law = if at.forward { layer.up } else { layer.down };
        if let (
            Special::Power {
                stiffness,
                exponent,
                dissipation,
            },
            false,
        ) = (layer.special, at.released)
        {
            let law = (stiffness, exponent, dissipation);
            let power = Power::new(machine, layer.up.damping, layer.from, law);
            let start = (at.position - layer.from, at.velocity);
            return power.run(start, at.angle, time, budget).map(Self::Steps);
        }
        let lets_go = at.released && matches!(layer.special, Special::ZeroForce { .. });
        let (damping, stiffness, force) = if lets_go || at.layer == 0 {
            (machine.damping, 0.0, 0.0)
        } else {
            let force = law.preload + law.stiffness * (at.position - law.origin);
            (law.damping, law.stiffness, force)
        };
        let m = machine.mass;
        let setting = Setting {
            damping: damping / m,
            stiffness: (machine.stiffness + stiffness) / m,
            constant: -(machine.stiffness * at.position + force) / m,
            amplitude: machine.amplitude / m,
            frequency: machine.frequency,
            angle: at.angle,
            velocity: at.velocity,
        };
        Some(Self::Linear(Linear::new(setting), time))
    }

    pub fn end(&self) -> State {
        match self {
            Self::Linear(linear, time) => linear.at(*time),
            Self::Steps(steps) => steps.end,
        }
    }

    /// State at any time.
    pub fn at(&self, time: f64) -> State {
        match self {
            Self::Linear(linear, _) => linear.at(time),
            Self::Steps(steps) => {
                let step = steps.steps.iter().find(|step| time <= step.end);
                step.map_or(steps.end, |step| step.at(time))
            }
        }
    }

    /// Natural sizes of displacement and velocity.
    pub fn sizes(&self) -> (f64, f64) {
        match self {
            Self::Linear(linear, _) => linear.sizes(),
            Self::Steps(steps) => (steps.length, steps.speed),
        }
    }

    /// How much an error of rounding grows until the end: with the instability of the law, and with
    /// the number of oscillations or steps.
    pub fn growth(&self) -> f64 {
        match self {
            Self::Linear(linear, time) => linear.growth(*time),
            Self::Steps(steps) => 1.0 + steps.steps.len() as f64 / 100.0,
        }
    }

    /// Looks for a guard above zero anywhere on the leg.
    pub fn search(&self, guard: &Guard, watch: &mut Watch) -> Seen {
        match self {
            Self::Linear(linear, time) => search(linear, guard, 0.0, *time, watch),
            Self::Steps(steps) => {
                let mut begin = 0.0;
                for step in &steps.steps {
                    let seen = search(step, guard, begin, step.end, watch);
                    if seen != Seen::Clear {
                        return seen;
                    }
                    begin = step.end;
                }
                Seen::Clear
            }
        }
    }
}
