//! Start values of parameters and discrete inputs.

mod scene;
pub mod slot;

use softstop_fmi::Imprint;
use softstop_fmi::variable::Slot;

use crate::machine::Machine;

pub use scene::NotServed;
pub use slot::SLOTS;

/// One value for each parameter and discrete input; an enumeration is held as its number, true as 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StartValues([f64; SLOTS]);

impl StartValues {
    /// The loaded machine on its z = 1 orbit at eta = 1.15, rho = 10 (Peterka 2003, point B), with a
    /// rigid stop far behind.
    pub const DEFAULT: Self = Self(slot::START);

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

    /// Whether a strip is fed.
    pub const fn is_fed(&self) -> bool {
        self.number(slot::MATERIAL) != 0 && self.get(slot::MATERIAL_SHARE) >= 0.5
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
