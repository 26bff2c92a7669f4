//! Numbered cases: the same seed gives the same scene and start for ever.

use std::f64::consts::TAU;

use softstop::{Excitation, Release, RigidStop, Scene, Slope, Start, Stop, Strip};

use super::graze;
use super::law::wall;

/// A scene, a start and a span.
#[derive(Debug, Clone)]
pub struct Case {
    pub scene: Scene,
    pub start: Start,
    pub periods: f64,
}

/// Numbers by a counter (Steele, Lea and Flood 2014).
pub struct Dice(u64);

impl Dice {
    pub fn new(seed: u64) -> Self {
        let mut dice = Self(seed.wrapping_mul(0xD134_2543_DE82_EF95));
        dice.next();
        dice
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn log(&mut self, low: f64, high: f64) -> f64 {
        self.range(low.ln(), high.ln()).exp()
    }

    pub fn below(&mut self, count: u64) -> u64 {
        self.next() % count
    }

    /// True once in `count` times.
    pub fn once_in(&mut self, count: u64) -> bool {
        self.below(count) == 0
    }
}

/// The case of a seed.
pub fn case(seed: u64) -> Case {
    let mut dice = Dice::new(seed);
    let mut case = any(&mut dice);
    if dice.once_in(2) {
        let plain = case.clone();
        graze::aim(&mut case, &mut dice);
        if case.scene.validate().is_err() {
            case = plain;
        }
        let most = wall(&case.scene).unwrap_or(f64::INFINITY);
        case.start.position = case.start.position.min(most);
    }
    case
}

fn any(dice: &mut Dice) -> Case {
    let (stop, stiffness) = any_stop(dice);
    let damping = if dice.once_in(8) {
        0.0
    } else {
        2.0 * dice.range(0.0, 0.5)
    };
    let rolling = dice.once_in(2);
    let scene = Scene {
        mass: if dice.once_in(4) {
            dice.log(0.1, 10.0)
        } else {
            1.0
        },
        stiffness: 1.0,
        damping,
        excitation: Excitation {
            amplitude: if dice.once_in(16) { 0.0 } else { 1.0 },
            frequency: dice.log(0.05, 20.0),
            phase: if dice.once_in(2) {
                0.0
            } else {
                dice.range(0.0, TAU)
            },
        },
        clearance: match dice.below(4) {
            0 => 0.0,
            1 | 2 => dice.range(-5.0, 5.0),
            _ => dice.range(-5.0, 50.0),
        },
        contact_damping: contact_damping(dice, damping, stiffness, &stop),
        stop,
        piercing: dice.once_in(4).then(|| any_strip(dice)),
        rigid: dice.once_in(4).then(|| RigidStop {
            travel: dice.log(1e-3, 2.0),
            restitution: share(dice),
        }),
        followers: softstop::Ties::NONE,
        below: None,
    };
    let start = any_start(dice, &scene, rolling);
    let periods = dice.range(0.5, 4.0);
    Case {
        scene,
        start,
        periods,
    }
}

fn share(dice: &mut Dice) -> f64 {
    match dice.below(6) {
        0 => 0.0,
        1 => 1.0,
        _ => dice.range(0.0, 1.0),
    }
}

fn contact_damping(dice: &mut Dice, free: f64, stiffness: f64, stop: &Stop) -> f64 {
    let critical = 2.0 * (1.0 + stiffness).sqrt();
    let most = if matches!(stop, Stop::Hertz { .. }) {
        30.0
    } else {
        f64::INFINITY
    };
    match dice.below(8) {
        0 => 0.0,
        1 => free,
        2 => dice.range(0.0, 1.0),
        3 => (critical * dice.log(1.0, 100.0)).min(most),
        _ => (critical * dice.log(1e-3, 1.0)).min(most),
    }
}

fn any_stop(dice: &mut Dice) -> (Stop, f64) {
    let stiffness = dice.log(1e-2, 1e8);
    let stop = match dice.below(9) {
        0 => Stop::None,
        1 => Stop::KelvinVoigt {
            stiffness,
            release: Release::Clearance,
        },
        2 => Stop::KelvinVoigt {
            stiffness,
            release: Release::ZeroForce,
        },
        3 => chain(dice, false),
        4 => chain(dice, true),
        5 => Stop::Hertz {
            stiffness,
            exponent: match dice.below(4) {
                0 => 1.5,
                1 => dice.range(1.0, 1.2),
                _ => dice.range(1.0, 3.0),
            },
            dissipation: if dice.once_in(3) {
                0.0
            } else {
                dice.range(0.0, 2.0)
            },
        },
        6 | 7 => Stop::Preloaded {
            stiffness,
            preload: match dice.below(4) {
                0 => 0.0,
                1 => dice.range(0.0, 2.0),
                _ => dice.range(0.0, 100.0),
            },
        },
        _ => Stop::Rigid {
            restitution: share(dice),
        },
    };
    (stop, stiffness)
}

fn chain(dice: &mut Dice, loop_: bool) -> Stop {
    let most = if dice.once_in(3) { 1e8 } else { 1e3 };
    let mut from = 0.0;
    let mut loading = Vec::new();
    for _ in 0..=dice.below(5) {
        let stiffness = if dice.once_in(8) {
            0.0
        } else {
            dice.log(1e-2, most)
        };
        loading.push(Slope { from, stiffness });
        from += dice.log(1e-3, 1.0);
    }
    let part = dice.range(0.0, 1.0);
    let least = loading
        .iter()
        .fold(f64::INFINITY, |least, slope| least.min(slope.stiffness));
    let unloading = if !loop_ {
        Vec::new()
    } else if dice.once_in(3) {
        vec![Slope {
            from: 0.0,
            stiffness: part * least,
        }]
    } else {
        let weaker = |slope: &Slope| Slope {
            stiffness: part * slope.stiffness,
            ..*slope
        };
        loading.iter().map(weaker).collect()
    };
    Stop::PiecewiseLinear { loading, unloading }
}

fn any_strip(dice: &mut Dice) -> Strip {
    let stiffness = if dice.once_in(8) {
        0.0
    } else {
        dice.log(0.1, 1e3)
    };
    let friction = if dice.once_in(8) {
        0.0
    } else {
        stiffness * dice.range(0.0, 2.0)
    };
    let (thickness, travel) = match dice.below(8) {
        0 => (0.0, dice.log(1e-2, 2.0)),
        1 => (dice.log(1e-2, 2.0), 0.0),
        _ => (dice.log(1e-2, 2.0), dice.log(1e-2, 2.0)),
    };
    Strip {
        stiffness,
        friction,
        thickness,
        travel,
    }
}

fn any_start(dice: &mut Dice, scene: &Scene, fast: bool) -> Start {
    let reach = if fast { 10.0 } else { 1.0 };
    let most = wall(scene).unwrap_or(f64::INFINITY);
    let position = match dice.below(16) {
        0 => scene.clearance,
        1 => scene.stop_position(),
        2 => scene.clearance + dice.log(1e-4, 1.0),
        _ => scene.clearance - dice.range(0.0, 2.0 * reach),
    };
    let velocity = if dice.once_in(8) {
        0.0
    } else {
        dice.range(-reach, 2.0 * reach)
    };
    Start::new(position.min(most), velocity)
}
