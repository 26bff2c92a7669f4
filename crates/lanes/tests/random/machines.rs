//! Random machines, and where their motions start.

use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{RngCore, SeedableRng};
use softstop::{Ratios, Release, RigidStop, Scene, Start, Stop};
use softstop_testing::{hertz, kelvin_voigt, preloaded, rigid_stop, slope};

/// A machine and where its motion starts.
pub type Motion = (Scene, Start);

/// Draws machines; the same ones for the same seed and part.
pub struct Draw(Xoshiro256PlusPlus);

impl Draw {
    /// The machines of one part of a check.
    pub fn new(seed: u64, part: u64) -> Self {
        let mut numbers = Xoshiro256PlusPlus::seed_from_u64(seed);
        let own = numbers.next_u64() ^ part;
        Self(Xoshiro256PlusPlus::seed_from_u64(own))
    }

    /// The next machine and the start of its motion: as many of the paper's without and with a strip, with other linear
    /// laws and with power laws, frequency ratios 0.5 to 2, clearances 0.5 to 20, stops of stiffness 3 to 10^4; every second
    /// power law dissipates, and every tenth stop of another kind that is not rigid gets a rigid one behind.
    pub fn machine(&mut self) -> Motion {
        let kind = self.below(4);
        let base = match kind {
            1 => Ratios::loaded(),
            _ => Ratios::unloaded(),
        };
        let ratios = base.at_frequency(self.between(0.5, 2.0));
        let ratios = ratios.at_clearance(self.between(0.5, 20.0));
        let mut scene = ratios.scene().expect("valid");
        match kind {
            2 => scene.stop = self.stop(),
            3 => scene.stop = self.power(),
            _ => {}
        }
        let is_last = matches!(scene.stop, Stop::Hertz { .. } | Stop::Rigid { .. });
        if self.below(10) == 0 && !is_last {
            let travel = self.between(0.1, 2.0);
            scene.rigid = Some(self.wall(travel));
        }
        let start = self.start(&scene);
        (scene, start)
    }

    /// Somewhere before the wall.
    pub(super) fn start(&mut self, scene: &Scene) -> Start {
        let wall = scene.wall().map_or(f64::INFINITY, |wall| wall.position);
        let position = self.between(-12.0, wall.min(12.0));
        Start::new(position, self.between(-15.0, 15.0))
    }

    /// A rigid stop behind the stop.
    pub(super) fn wall(&mut self, travel: f64) -> RigidStop {
        rigid_stop(travel, self.between(0.2, 0.95))
    }

    fn stop(&mut self) -> Stop {
        let stiffness = 10f64.powf(self.between(0.5, 4.0));
        match self.below(5) {
            0 => Stop::Rigid {
                restitution: self.between(0.2, 0.95),
            },
            1 => kelvin_voigt(stiffness, Release::Clearance),
            2 => kelvin_voigt(stiffness, Release::ZeroForce),
            3 => Stop::PiecewiseLinear {
                loading: vec![slope(0.0, stiffness), slope(0.3, 2.0 * stiffness)],
                unloading: vec![slope(0.0, 0.5 * stiffness)],
            },
            _ => preloaded(stiffness, self.between(0.0, 100.0)),
        }
    }

    fn power(&mut self) -> Stop {
        let stiffness = 10f64.powf(self.between(0.5, 4.0));
        let exponent = [1.5, 2.0, 2.5][self.below(3)];
        hertz(stiffness, exponent, self.between(-0.1, 0.1).max(0.0))
    }

    /// Evenly in [low, high).
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        let share = (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        low + (high - low) * share
    }

    pub(super) fn below(&mut self, count: usize) -> usize {
        (self.between(0.0, count as f64) as usize).min(count - 1)
    }
}
