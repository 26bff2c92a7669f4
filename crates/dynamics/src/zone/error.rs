//! Why a machine has no zone.

use std::fmt::{self, Display, Formatter};

use thiserror::Error;

use crate::orbit::OrbitError;
use softstop::internals::plain_number;
use softstop::{Dimension, Machine, Parameter, SceneError};

/// Why a machine has no hysteresis zone.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ZoneError {
    /// The impact-less motion never reaches the stop.
    #[error(
        "clearance = {clearance}: must be > 0 and below {largest}, the largest amplitude of the \
         impact-less motion, for a grazing boundary to exist"
    )]
    NoGrazing {
        /// The clearance in m.
        clearance: f64,
        /// The amplitude at resonance in m.
        largest: f64,
    },
    /// There is no stable z = 1 motion where the zone would begin.
    #[error("no hysteresis: no stable z = 1 motion at the grazing boundary, {frequency}")]
    NoOrbit {
        /// Frequency of the grazing boundary.
        frequency: StatedFrequency,
    },
    /// The z = 1 branch loses its stability otherwise than by a fold.
    #[error("the z = 1 branch loses its stability by a flip near {frequency}, before any fold")]
    Flip {
        /// Frequency at which it is first seen unstable.
        frequency: StatedFrequency,
    },
    /// The z = 1 branch goes on without a fold.
    #[error(
        "no hysteresis: the hardest z = 1 motion at the grazing boundary, {from}, stays stable up to {to}, where {end}"
    )]
    NoFold {
        /// Frequency of the grazing boundary.
        from: StatedFrequency,
        /// Frequency up to which it was followed.
        to: StatedFrequency,
        /// Why no farther.
        end: StableBranchEnd,
    },
    /// There is no stable z = 1 motion at the frequencies at which it is looked for.
    #[error("no stable z = 1 motion found between {from} and {to}")]
    NoMotion {
        /// The lowest frequency.
        from: StatedFrequency,
        /// The highest.
        to: StatedFrequency,
    },
    /// The machine has a stop below.
    #[error("stop.below: zones are those of machines with stops on one side")]
    StopBelow,
    /// A place outside the zone was asked for.
    #[error("s = {share}: must lie in [0, 1], from end to end of the zone")]
    Outside {
        /// The share that was asked for.
        share: f64,
    },
    /// The branch could not be computed.
    #[error(transparent)]
    Orbit(#[from] OrbitError),
}

impl ZoneError {
    /// This error with its frequency in the units and under the key of a machine.
    #[must_use]
    pub fn in_units_of(mut self, machine: &Machine) -> Self {
        let (one, other) = match &mut self {
            Self::NoOrbit { frequency } | Self::Flip { frequency } => (Some(frequency), None),
            Self::NoFold { from, to, .. } | Self::NoMotion { from, to } => (Some(from), Some(to)),
            _ => (None, None),
        };
        for frequency in one.into_iter().chain(other) {
            frequency.key = machine.name(Parameter::Frequency);
            frequency.value = machine.to_own(Dimension::Frequency, frequency.value);
        }
        self
    }
}

impl From<SceneError> for ZoneError {
    fn from(error: SceneError) -> Self {
        Self::Orbit(error.into())
    }
}

/// Why a stable branch is followed no farther.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum StableBranchEnd {
    /// No motion with one impact of its kind goes on.
    Regime,
    /// It lies below the grazing boundary.
    Below,
    /// No fold is looked for beyond.
    Range,
    /// It has more points than are followed, as at resonance, where hardly any damping bounds the motion.
    Budget,
}

impl Display for StableBranchEnd {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Regime => "it ends otherwise than by a fold",
            Self::Below => "it has come back below the boundary",
            Self::Range => "the search for a fold ends",
            Self::Budget => {
                "it has more points than are followed: at resonance hardly any damping bounds it; raise damping"
            }
        })
    }
}

/// A drive frequency as a machine states it: under a key of machine files, which says its unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StatedFrequency {
    /// The key: `excitation.frequency` for rad/s.
    pub key: &'static str,
    /// The frequency.
    pub value: f64,
}

impl From<f64> for StatedFrequency {
    /// A frequency in rad/s, as an error tells it until a machine states it in its own unit.
    fn from(value: f64) -> Self {
        let key = Parameter::Frequency.name();
        Self { key, value }
    }
}

impl Display for StatedFrequency {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {}", self.key, plain_number(self.value))
    }
}
