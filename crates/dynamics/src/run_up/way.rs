//! The ways to run a machine up into a motion, and where each begins.

use serde::{Deserialize, Serialize};
use softstop::{Parameter, Scene};

use crate::sweep::Direction;
use crate::zone::free_amplitude;

/// A way to run a machine up into a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Way {
    /// The mass rests, and the drive is switched on at once, at its working frequency.
    SwitchedOn,
    /// The frequency rises slowly from well below.
    FrequencyRaised,
    /// The frequency falls slowly from well above.
    FrequencyLowered,
    /// The clearance is opened slowly from a small one; no way where it is 0 or below.
    ClearanceOpened,
    /// The amplitude of the drive rises slowly from next to nothing.
    AmplitudeRaised,
    /// The amplitude of the drive falls slowly from one with which the free mass would meet the stop.
    AmplitudeLowered,
}

impl Way {
    /// All ways to run up.
    pub const ALL: [Self; 6] = [
        Self::SwitchedOn,
        Self::FrequencyRaised,
        Self::FrequencyLowered,
        Self::ClearanceOpened,
        Self::AmplitudeRaised,
        Self::AmplitudeLowered,
    ];

    /// The ways to run up that need no more than the drive's own amplitude.
    pub const BY_OWN_DRIVE: [Self; 5] = {
        let [one, two, three, four, five, _] = Self::ALL;
        [one, two, three, four, five]
    };

    /// The way to run up, in words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::SwitchedOn => "switching the drive on at its working frequency",
            Self::FrequencyRaised => "raising the frequency from below",
            Self::FrequencyLowered => "lowering the frequency from above",
            Self::ClearanceOpened => "opening the clearance slowly from a small one",
            Self::AmplitudeRaised => "raising the drive's amplitude slowly from rest",
            Self::AmplitudeLowered => "lowering the drive's amplitude slowly from a larger one",
        }
    }

    /// The parameter that changes on the way to run up, if one does.
    pub const fn changed_parameter(self) -> Option<Parameter> {
        match self {
            Self::SwitchedOn => None,
            Self::FrequencyRaised | Self::FrequencyLowered => Some(Parameter::Frequency),
            Self::ClearanceOpened => Some(Parameter::Clearance),
            Self::AmplitudeRaised | Self::AmplitudeLowered => Some(Parameter::Amplitude),
        }
    }

    /// The slow change that a way to run up makes: its parameter, the value at which it begins in SI units, and its direction.
    /// None if the way has none, or not with this scene.
    pub(super) fn slow_change(self, scene: &Scene) -> Option<(Parameter, f64, Direction)> {
        let w = scene.excitation.frequency;
        let amplitude = scene.excitation.amplitude;
        let own = (scene.stiffness / scene.mass).sqrt();
        let (first, direction) = match self {
            Self::SwitchedOn => return None,
            Self::FrequencyRaised => {
                let slow = if own > 0.0 { own.min(w) } else { w };
                (0.5 * slow, Direction::Up)
            }
            Self::FrequencyLowered => (2.0 * own.max(w), Direction::Down),
            Self::ClearanceOpened => (0.05 * scene.clearance, Direction::Up),
            Self::AmplitudeRaised => (0.01 * amplitude, Direction::Up),
            Self::AmplitudeLowered => {
                let grazing = 1.5 * scene.least_clearance() / free_amplitude(scene, w);
                (amplitude * grazing.max(2.0), Direction::Down)
            }
        };
        let is_possible = first > 0.0 && first.is_finite();
        is_possible.then_some((self.changed_parameter()?, first, direction))
    }
}
