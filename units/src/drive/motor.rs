//! The motor: torque over speed, and what it turns.

use serde::{Deserialize, Serialize};
use softstop_fmi::{Enumeration, item};

use super::slot;

const DIRECT_CURRENT: i32 = 1;
const ASYNCHRONOUS: i32 = 2;

/// Share of the motor's speed below which a load brakes no harder.
const SLOW: f64 = 1.0 / 1024.0;

/// The laws of torque.
pub(super) static MODEL: Enumeration = Enumeration {
    type_name: "MotorModel",
    description: "Torque T of a motor over its speed w, at the voltage u as a share of the rated one",
    items: &[
        item(
            DIRECT_CURRENT,
            "directCurrent",
            "T = motor.torque (u - w / motor.speed)",
        ),
        item(
            ASYNCHRONOUS,
            "asynchronous",
            "T = 2 motor.torque u^2 / (s / motor.slip + motor.slip / s) with the slip s = 1 - w / motor.speed (Kloss)",
        ),
    ],
};

/// Motor, rotor and unbalance.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Motor {
    model: i32,
    pub voltage: f64,
    torque: f64,
    pub speed: f64,
    slip: f64,
    pub inertia: f64,
    pub friction: f64,
    pub unbalance: f64,
}

impl Motor {
    pub fn of(values: &[f64]) -> Self {
        let value = |slot: softstop_fmi::variable::Slot| values[slot.0];
        Self {
            model: value(slot::MODEL) as i32,
            voltage: value(slot::VOLTAGE),
            torque: value(slot::TORQUE),
            speed: value(slot::SPEED),
            slip: value(slot::SLIP),
            inertia: value(slot::INERTIA),
            friction: value(slot::FRICTION),
            unbalance: value(slot::UNBALANCE),
        }
    }

    /// Torque in N m at a voltage and a speed in rad/s.
    pub fn torque(&self, voltage: f64, speed: f64) -> f64 {
        let share = speed / self.speed;
        match self.model {
            ASYNCHRONOUS => {
                let slip = 1.0 - share;
                let shape = slip * self.slip / (slip * slip + self.slip * self.slip);
                2.0 * self.torque * voltage * voltage * shape
            }
            _ => self.torque * (voltage - share),
        }
    }

    /// Energy in J of the rotor at the motor's speed.
    pub fn typical_energy(&self) -> f64 {
        0.5 * self.inertia * self.speed * self.speed
    }

    /// Torque in N m by which a load of a power in W brakes.
    pub fn braking(&self, power: f64, speed: f64) -> f64 {
        let slow = SLOW * self.speed;
        power * speed / (speed * speed).max(slow * slow)
    }
}
