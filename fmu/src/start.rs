//! Start values of the parameters, and the block in the library that holds them.
//!
//! A packaged design must start with its own values even if the importer sets none and passes no
//! resource folder. So the library carries them in one block of plain bytes behind a marker, and
//! the packager patches these bytes in the copy that it packs.

mod block;
mod scene;
mod slot;

use softstop::samples;

use crate::units::{RELEASE_CLEARANCE, STOP_PRELOADED};

pub use block::library_start_values;
pub(crate) use block::marker;
pub use scene::NotServed;
pub use slot::{SLOPES, SLOTS, Slot};

/// One value for each parameter; an enumeration is held as its number, true as 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StartValues([f64; SLOTS]);

impl StartValues {
    /// The loaded machine on its z = 1 orbit at eta = 1.15, rho = 10 (Peterka 2003, point B), with a
    /// rigid stop far behind.
    pub const DEFAULT: Self = Self::loaded_machine();

    /// The value of one parameter.
    pub const fn get(&self, slot: Slot) -> f64 {
        self.0[slot.position()]
    }

    /// The value of an integer, enumeration or Boolean.
    pub const fn number(&self, slot: Slot) -> i32 {
        self.get(slot) as i32
    }

    /// Puts in the value of one parameter.
    pub const fn set(&mut self, slot: Slot, value: f64) {
        self.0[slot.position()] = value;
    }

    /// [`samples::LOADED`] with m = 1 kg, k1 = 1 N/m and F0 = 1 N, so that SI units and the paper's
    /// ratios coincide; as a constant, since the library's block of start values is one.
    const fn loaded_machine() -> Self {
        let sample = samples::LOADED;
        let ratios = sample.ratios;
        let mut values = Self([0.0; SLOTS]);
        values.set(Slot::MASS, 1.0);
        values.set(Slot::STIFFNESS, 1.0);
        values.set(Slot::DAMPING, 2.0 * ratios.damping);
        values.set(Slot::AMPLITUDE, 1.0);
        values.set(Slot::FREQUENCY, ratios.frequency);
        values.set(Slot::CLEARANCE, ratios.clearance);
        values.set(Slot::CONTACT_DAMPING, 2.0 * ratios.contact_damping);
        values.set_default_stops(ratios.stiffness, ratios.preload);
        if let Some(strip) = ratios.piercing {
            values.set(Slot::PIERCING_STIFFNESS, strip.stiffness);
            values.set(Slot::PIERCING_FRICTION, strip.friction);
            values.set(Slot::PIERCING_THICKNESS, strip.thickness);
            values.set(Slot::PIERCING_TRAVEL, strip.travel);
        }
        values.set(Slot::INITIAL_POSITION, sample.position);
        values.set(Slot::INITIAL_VELOCITY, sample.velocity);
        values
    }

    const fn set_default_stops(&mut self, stiffness: f64, preload: f64) {
        self.set(Slot::STOP_MODEL, STOP_PRELOADED as f64);
        self.set(Slot::STOP_STIFFNESS, stiffness);
        self.set(Slot::STOP_PRELOAD, preload);
        self.set(Slot::STOP_RELEASE, RELEASE_CLEARANCE as f64);
        self.set(Slot::STOP_EXPONENT, 1.5);
        self.set(Slot::STOP_RESTITUTION, 0.6);
        self.set(Slot::LOADING_COUNT, 1.0);
        self.set(Slot::LOADING_STIFFNESS, stiffness);
        self.set(Slot::UNLOADING_STIFFNESS, stiffness);
        self.set(Slot::RIGID_PRESENT, 1.0);
        self.set(Slot::RIGID_TRAVEL, 5.0);
    }

    /// The values in the order of their slots.
    pub(crate) const fn values(&self) -> &[f64; SLOTS] {
        &self.0
    }

    pub(crate) const fn from_values(values: [f64; SLOTS]) -> Self {
        Self(values)
    }

    /// The bytes that stand behind the marker.
    pub(crate) fn to_bytes(self) -> Vec<u8> {
        self.0
            .iter()
            .flat_map(|value| value.to_le_bytes())
            .collect()
    }
}

impl Default for StartValues {
    fn default() -> Self {
        Self::DEFAULT
    }
}
