//! Start values of parameters and discrete inputs.

mod scene;
pub mod slot;

use softstop::internals::samples;
use softstop_fmi::Imprint;
use softstop_fmi::variable::Slot;

use crate::machine::Machine;
use crate::units::number;

pub use scene::NotServed;
pub use slot::SLOTS;

/// One value for each parameter and discrete input; an enumeration is held as its number, true as 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StartValues([f64; SLOTS]);

impl StartValues {
    /// The loaded machine on its z = 1 orbit at eta = 1.15, rho = 10 (Peterka 2003, point B), with a
    /// rigid stop far behind.
    pub const DEFAULT: Self = Self::loaded_machine();

    /// The value of one parameter.
    pub const fn get(&self, slot: Slot) -> f64 {
        self.0[slot.0]
    }

    /// The value of an integer, enumeration or Boolean.
    pub const fn number(&self, slot: Slot) -> i32 {
        self.get(slot) as i32
    }

    /// Puts in the value of one parameter.
    pub const fn set(&mut self, slot: Slot, value: f64) {
        self.0[slot.0] = value;
    }

    /// [`samples::LOADED`] with m = 1 kg, k1 = 1 N/m and F0 = 1 N, so that SI units and the paper's
    /// ratios coincide; as a constant, since the library's block of start values is one.
    const fn loaded_machine() -> Self {
        let sample = samples::LOADED;
        let ratios = sample.ratios;
        let mut values = Self([0.0; SLOTS]);
        values.set(slot::MASS, 1.0);
        values.set(slot::STIFFNESS, 1.0);
        values.set(slot::DAMPING, 2.0 * ratios.damping);
        values.set(slot::AMPLITUDE, 1.0);
        values.set(slot::FREQUENCY, ratios.frequency);
        values.set(slot::CLEARANCE, ratios.clearance);
        values.set(slot::CONTACT_DAMPING, 2.0 * ratios.contact_damping);
        values.set_default_stops(ratios.stiffness, ratios.preload);
        if let Some(strip) = ratios.piercing {
            values.set(slot::PIERCING_STIFFNESS, strip.stiffness);
            values.set(slot::PIERCING_FRICTION, strip.friction);
            values.set(slot::PIERCING_THICKNESS, strip.thickness);
            values.set(slot::PIERCING_TRAVEL, strip.travel);
        }
        values.set(slot::INITIAL_POSITION, sample.position);
        values.set(slot::INITIAL_VELOCITY, sample.velocity);
        values.set(slot::MATERIAL, 1.0);
        values.set(slot::MATERIAL_SHARE, 1.0);
        values
    }

    /// Whether a strip is fed.
    pub const fn is_fed(&self) -> bool {
        self.number(slot::MATERIAL) != 0 && self.get(slot::MATERIAL_SHARE) >= 0.5
    }

    const fn set_default_stops(&mut self, stiffness: f64, preload: f64) {
        self.set(slot::STOP_MODEL, number::PRELOADED as f64);
        self.set(slot::STOP_STIFFNESS, stiffness);
        self.set(slot::STOP_PRELOAD, preload);
        self.set(slot::STOP_RELEASE, number::CLEARANCE as f64);
        self.set(slot::STOP_EXPONENT, 1.5);
        self.set(slot::STOP_RESTITUTION, 0.6);
        self.set(slot::LOADING_COUNT, 1.0);
        self.set(slot::LOADING_STIFFNESS, stiffness);
        self.set(slot::UNLOADING_STIFFNESS, stiffness);
        self.set(slot::RIGID_PRESENT, 1.0);
        self.set(slot::RIGID_TRAVEL, 5.0);
        self.set(slot::BELOW_MODEL, number::NONE as f64);
        self.set(slot::BELOW_CLEARANCE, 10.0);
        self.set(slot::BELOW_STIFFNESS, stiffness);
        self.set(slot::BELOW_PRELOAD, preload);
        self.set(slot::BELOW_RELEASE, number::CLEARANCE as f64);
        self.set(slot::BELOW_EXPONENT, 1.5);
        self.set(slot::BELOW_RESTITUTION, 0.6);
        self.set(slot::BELOW_LOADING_COUNT, 1.0);
        self.set(slot::BELOW_LOADING_STIFFNESS, stiffness);
        self.set(slot::BELOW_UNLOADING_STIFFNESS, stiffness);
    }

    /// The values in the order of their slots.
    pub const fn values(&self) -> &[f64; SLOTS] {
        &self.0
    }

    /// Values in the order of their slots; those that are missing keep their defaults.
    pub fn of(values: &[f64]) -> Self {
        let mut all = Self::DEFAULT;
        for (value, given) in all.0.iter_mut().zip(values) {
            *value = *given;
        }
        all
    }
}

impl From<StartValues> for Imprint<Machine> {
    fn from(values: StartValues) -> Self {
        Self::new(values.values())
    }
}
