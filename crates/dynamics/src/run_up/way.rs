//! The ways to bring a machine into a motion, and where each begins.

use serde::{Deserialize, Serialize};
use softstop::{Parameter, Scene};

use crate::sweep::Direction;
use crate::zone::free_amplitude;

/// A way to bring a machine into a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Way {
    /// The mass rests, and the drive is switched on at once, at its working frequency.
    SwitchedOn,
    /// The frequency rises slowly from well below.
    FrequencyRaised,
    /// The frequency falls slowly from well above.
    FrequencyLowered,
    /// The clearance is opened slowly from a small one.
    ClearanceOpened,
    /// The amplitude of the drive rises slowly from next to nothing.
    AmplitudeRaised,
    /// The amplitude of the drive falls slowly from one with which the free mass would meet the stop.
    AmplitudeLowered,
}

impl Way {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::SwitchedOn,
        Self::FrequencyRaised,
        Self::FrequencyLowered,
        Self::ClearanceOpened,
        Self::AmplitudeRaised,
        Self::AmplitudeLowered,
    ];

    /// Those that need no more than the drive's own amplitude.
    pub const BY_OWN_DRIVE: [Self; 5] = [
        Self::SwitchedOn,
        Self::FrequencyRaised,
        Self::FrequencyLowered,
        Self::ClearanceOpened,
        Self::AmplitudeRaised,
    ];

    /// In words.
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

    /// The parameter that changes on the way, if one does.
    pub const fn changes(self) -> Option<Parameter> {
        match self {
            Self::SwitchedOn => None,
            Self::FrequencyRaised | Self::FrequencyLowered => Some(Parameter::Frequency),
            Self::ClearanceOpened => Some(Parameter::Clearance),
            Self::AmplitudeRaised | Self::AmplitudeLowered => Some(Parameter::Amplitude),
        }
    }

    /// What changes on the way, from which value in SI units, and whether up or down; none where nothing does, or where
    /// there is no such way.
    pub(super) fn change(self, scene: &Scene) -> Option<(Parameter, f64, Direction)> {
        let w = scene.excitation.frequency;
        let (amplitude, clearance) = (scene.excitation.amplitude, scene.clearance);
        let reached = scene.least_clearance();
        let own = (scene.stiffness / scene.mass).sqrt();
        match self {
            Self::SwitchedOn => None,
            Self::FrequencyRaised => {
                let slow = if own > 0.0 { own.min(w) } else { w };
                Some((Parameter::Frequency, BELOW * slow, Direction::Up))
            }
            Self::FrequencyLowered => {
                Some((Parameter::Frequency, ABOVE * own.max(w), Direction::Down))
            }
            Self::ClearanceOpened => (clearance > 0.0).then_some((
                Parameter::Clearance,
                SMALL * clearance,
                Direction::Up,
            )),
            Self::AmplitudeRaised => (amplitude > 0.0).then_some((
                Parameter::Amplitude,
                FAINT * amplitude,
                Direction::Up,
            )),
            Self::AmplitudeLowered => {
                let free = free_amplitude(scene, w);
                let enough = amplitude * (STRONG * reached / free).max(ABOVE);
                (amplitude > 0.0 && enough.is_finite()).then_some((
                    Parameter::Amplitude,
                    enough,
                    Direction::Down,
                ))
            }
        }
    }
}

/// Where ways begin: a frequency below and above, in units of the lower and the higher one of the drive's and the mass's
/// own; a clearance and an amplitude, in units of those at work; an amplitude, in units of that of grazing.
const BELOW: f64 = 0.5;
const ABOVE: f64 = 2.0;
const SMALL: f64 = 0.05;
const FAINT: f64 = 0.01;
const STRONG: f64 = 1.5;
