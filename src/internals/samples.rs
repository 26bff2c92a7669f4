//! Sample machines with their exact answers, shared by tests, documentation and the FMU.

use crate::scene::Ratios;

/// A machine in its z = 1 motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MachineSample {
    /// The machine.
    pub ratios: Ratios,
    /// Position at drive angle 0, in units of the static deflection.
    pub position: f64,
    /// Velocity at drive angle 0.
    pub velocity: f64,
    /// Before-impact velocity at X = rho.
    pub before_impact_velocity: f64,
    /// Largest position X_m.
    pub max_position: f64,
}

/// Point A of Peterka 2003: the unloaded machine, eta = 1.15, rho = 10.
pub const UNLOADED: MachineSample = MachineSample {
    ratios: Ratios::unloaded(),
    position: 6.901_267_951_548,
    velocity: 9.516_655_745_459,
    before_impact_velocity: 6.494_627_429_36,
    max_position: 10.260_591_34,
};

/// Point B of Peterka 2003: the loaded machine, eta = 1.15, rho = 10.
pub const LOADED: MachineSample = MachineSample {
    ratios: Ratios::loaded(),
    position: 4.818_747_634_046,
    velocity: 11.908_301_592_746,
    before_impact_velocity: 8.398_675_591_86,
    max_position: 11.155_994_68,
};
