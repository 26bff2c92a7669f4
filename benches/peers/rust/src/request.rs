//! What is asked and what is answered.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

/// X'' = cos(eta tau) - damping X' - stiffness X.
#[derive(Debug, Clone, Copy, Deserialize)]
pub struct Law {
    /// Coefficient of X'.
    pub damping: f64,
    /// Coefficient of X.
    pub stiffness: f64,
}

/// The machine and its start.
#[derive(Debug, Clone, Deserialize)]
pub struct Scene {
    /// X at which the law changes.
    pub clearance: f64,
    /// The law for X < clearance.
    pub free: Law,
    /// The law for X > clearance.
    pub contact: Law,
    /// X and X' at time 0.
    pub start: [f64; 2],
    /// Forcing periods to cover.
    pub periods: f64,
}

/// One motion for each frequency.
#[derive(Debug, Clone, Deserialize)]
pub struct Request {
    /// The method.
    pub method: String,
    /// Its relative and absolute tolerance.
    pub tolerance: f64,
    /// The machine.
    pub scene: Scene,
    /// Frequencies eta.
    pub frequencies: Vec<f64>,
}

impl Request {
    /// The end of a motion, in dimensionless time.
    pub fn end(&self, frequency: f64) -> f64 {
        self.scene.periods * TAU / frequency
    }

    /// The law in contact or out of it.
    pub fn law(&self, contact: bool) -> Law {
        if contact {
            self.scene.contact
        } else {
            self.scene.free
        }
    }
}

impl Law {
    /// X''.
    pub fn acceleration(&self, drive: f64, position: f64, velocity: f64) -> f64 {
        drive - self.damping * velocity - self.stiffness * position
    }
}

/// X, X' and the number of impacts at the end.
pub type End = (f64, f64, u64);

/// The answer.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum Answer {
    /// All motions and the time that they took.
    Solved {
        /// Processor time in s.
        seconds: f64,
        /// The ends in the order of the frequencies.
        ends: Vec<End>,
    },
    /// Why there is none.
    Failed {
        /// In the words of the peer.
        error: String,
    },
}
