//! The oracle's own reading of a scene: layers of positions, each with the force that its stop or
//! strip gives on the way forward and back.

use softstop::internals::force_of;
use softstop::{PhaseKind, Release, Scene, Slope, Stop, Strip};

/// F = `preload` + `stiffness` (x - `origin`), beside a damper that replaces that of the free mass.
#[derive(Debug, Clone, Copy)]
pub struct Law {
    pub damping: f64,
    pub stiffness: f64,
    pub preload: f64,
    pub origin: f64,
}

/// What a layer has besides its linear laws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Special {
    None,
    /// Contact ceases while stiffness (x - from) + `damping` v < 0; the free damper then holds.
    ZeroForce {
        stiffness: f64,
        damping: f64,
    },
    /// F = stiffness d^exponent max(0, 1 + dissipation v).
    Power {
        stiffness: f64,
        exponent: f64,
        dissipation: f64,
    },
}

/// A range of positions from `from` up to the next layer.
#[derive(Debug, Clone)]
pub struct Layer {
    pub from: f64,
    pub kind: PhaseKind,
    /// The law of v > 0.
    pub up: Law,
    /// The law of v < 0.
    pub down: Law,
    /// The two are told apart (even where they happen to agree).
    pub friction: bool,
    pub special: Special,
}

/// A scene as the oracle sees it.
#[derive(Debug, Clone)]
pub struct Machine {
    pub mass: f64,
    pub stiffness: f64,
    pub damping: f64,
    pub amplitude: f64,
    pub frequency: f64,
    /// Layers from below; the first is free.
    pub layers: Vec<Layer>,
    /// The rigid stop that ends them, and its restitution.
    pub wall: Option<(f64, f64)>,
}

impl Machine {
    pub fn new(scene: &Scene) -> Self {
        let free = Layer::plain(PhaseKind::Free, f64::NEG_INFINITY, scene.damping, 0.0, 0.0);
        let mut layers = vec![free];
        layers.extend(strip_layers(scene));
        layers.extend(stop_layers(scene));
        let wall = wall(scene).map(|wall| (wall, restitution(scene)));
        if let Some((wall, _)) = wall {
            layers.retain(|layer| layer.from < wall);
        }
        Self {
            mass: scene.mass,
            stiffness: scene.stiffness,
            damping: scene.damping,
            amplitude: scene.excitation.amplitude,
            frequency: scene.excitation.frequency,
            layers,
            wall,
        }
    }

    /// The period of the drive.
    pub fn period(&self) -> f64 {
        std::f64::consts::TAU / self.frequency
    }

    /// Where a layer ends, if it does.
    pub fn top(&self, layer: usize) -> Option<f64> {
        match self.layers.get(layer + 1) {
            Some(next) => Some(next.from),
            None => self.wall.map(|wall| wall.0),
        }
    }

    /// Force that holds a mass at rest back, suspension included, its natural size, and what the
    /// rounding of the position makes of it.
    pub fn resistance(&self, layer: usize, forward: bool, position: f64) -> (f64, f64, f64) {
        let at = &self.layers[layer];
        let law = if forward { at.up } else { at.down };
        let spring = law.stiffness * (position - law.origin);
        let depth = (position - at.from).max(0.0);
        let (power, slope) = match at.special {
            Special::Power {
                stiffness,
                exponent,
                ..
            } => {
                let power = stiffness * depth.powf(exponent);
                (power, stiffness * exponent * depth.powf(exponent - 1.0))
            }
            _ => (0.0, 0.0),
        };
        let suspension = self.stiffness * position;
        let size = law.preload.abs() + spring.abs() + power + suspension.abs();
        let span = position.abs() + law.origin.abs();
        let rounding = 4.0 * f64::EPSILON * span * (law.stiffness.abs() + slope);
        let force = law.preload + spring + power + suspension;
        (force, size + self.amplitude, rounding)
    }
}

impl Layer {
    fn plain(kind: PhaseKind, from: f64, damping: f64, stiffness: f64, preload: f64) -> Self {
        let origin = if from.is_finite() { from } else { 0.0 };
        let law = Law {
            damping,
            stiffness,
            preload,
            origin,
        };
        Self {
            from,
            kind,
            up: law,
            down: law,
            friction: false,
            special: Special::None,
        }
    }

    fn with_back(self, stiffness: f64, preload: f64) -> Self {
        let down = Law {
            stiffness,
            preload,
            ..self.up
        };
        Self {
            down,
            friction: true,
            ..self
        }
    }
}

/// Where a rigid stop stands.
pub fn wall(scene: &Scene) -> Option<f64> {
    let strip = scene
        .piercing
        .map_or(0.0, |strip| strip.thickness + strip.travel);
    let stop = scene.clearance + strip;
    match (&scene.stop, scene.rigid) {
        (Stop::Rigid { .. }, _) => Some(stop),
        (_, Some(rigid)) => Some(stop + rigid.travel),
        _ => None,
    }
}

fn restitution(scene: &Scene) -> f64 {
    match (&scene.stop, scene.rigid) {
        (Stop::Rigid { restitution }, _) => *restitution,
        (_, Some(rigid)) => rigid.restitution,
        _ => 0.0,
    }
}

fn strip_layers(scene: &Scene) -> Vec<Layer> {
    let Some(strip) = scene.piercing else {
        return Vec::new();
    };
    let Strip {
        stiffness: k2,
        friction: k3,
        thickness,
        travel,
    } = strip;
    let (r, b) = (scene.clearance, scene.contact_damping);
    let mut layers = Vec::new();
    if thickness > 0.0 {
        layers.push(Layer::plain(PhaseKind::Pierce, r, b, k2 + k3, 0.0).with_back(k2 - k3, 0.0));
    }
    if travel > 0.0 {
        // F = s (k2 + k3) / 40 (1 + 3 sign v)
        let unit = thickness * (k2 + k3) / 40.0;
        let cut = Layer::plain(PhaseKind::Cut, r + thickness, b, 0.0, 4.0 * unit);
        layers.push(cut.with_back(0.0, -2.0 * unit));
    }
    layers
}

fn stop_layers(scene: &Scene) -> Vec<Layer> {
    let (s, b) = (scene.stop_position(), scene.contact_damping);
    let stop = |k: f64, preload: f64| Layer::plain(PhaseKind::Stop, s, b, k, preload);
    match &scene.stop {
        Stop::None if scene.piercing.is_none() && scene.rigid.is_none() => Vec::new(),
        Stop::None | Stop::Rigid { .. } => vec![Layer::plain(PhaseKind::Gap, s, b, 0.0, 0.0)],
        Stop::Preloaded { stiffness, preload } => vec![stop(*stiffness, *preload)],
        Stop::KelvinVoigt { stiffness, release } => {
            let damping = b - scene.damping;
            let clips = *release == Release::ZeroForce && damping != 0.0;
            let special = Special::ZeroForce {
                stiffness: *stiffness,
                damping,
            };
            let special = if clips { special } else { Special::None };
            vec![Layer {
                special,
                ..stop(*stiffness, 0.0)
            }]
        }
        Stop::Hertz {
            stiffness,
            exponent,
            dissipation,
        } => {
            let power = Special::Power {
                stiffness: *stiffness,
                exponent: *exponent,
                dissipation: *dissipation,
            };
            vec![Layer {
                special: power,
                ..stop(0.0, 0.0)
            }]
        }
        Stop::PiecewiseLinear { loading, unloading } => slopes(s, b, loading, unloading),
    }
}

fn slopes(s: f64, b: f64, loading: &[Slope], unloading: &[Slope]) -> Vec<Layer> {
    let same = unloading.is_empty() || unloading == loading;
    let back = if same { loading } else { unloading };
    let mut starts: Vec<f64> = loading.iter().chain(back).map(|slope| slope.from).collect();
    starts.sort_by(f64::total_cmp);
    starts.dedup();
    let slope_at = |slopes: &[Slope], d: f64| {
        let mut held = slopes.iter().filter(|slope| slope.from <= d);
        held.next_back().map_or(0.0, |slope| slope.stiffness)
    };
    let layer = |d: f64| {
        let force = force_of(loading, d);
        let on = Layer::plain(PhaseKind::Stop, s + d, b, slope_at(loading, d), force);
        if same {
            on
        } else {
            on.with_back(slope_at(back, d), force_of(back, d))
        }
    };
    starts.into_iter().map(layer).collect()
}
