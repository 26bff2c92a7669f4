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
    /// The clearance is opened slowly from a small one.
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
    pub const BY_OWN_DRIVE: [Self; 5] = [
        Self::SwitchedOn,
        Self::FrequencyRaised,
        Self::FrequencyLowered,
        Self::ClearanceOpened,
        Self::AmplitudeRaised,
    ];

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

    /// The slow change on a way to run up: parameter, first value in SI units, direction; none without such a way.
    pub(super) fn slow_change(self, scene: &Scene) -> Option<(Parameter, f64, Direction)> {
        let w = scene.excitation.frequency;
        let (amplitude, clearance) = (scene.excitation.amplitude, scene.clearance);
        let reached = scene.least_clearance();
        let own = (scene.stiffness / scene.mass).sqrt();
        match self {
            Self::SwitchedOn => None,
            Self::FrequencyRaised => {
                let slow = if own > 0.0 { own.min(w) } else { w };
                Some((Parameter::Frequency, LOW_FREQUENCY * slow, Direction::Up))
            }
            Self::FrequencyLowered => Some((
                Parameter::Frequency,
                HIGH_FACTOR * own.max(w),
                Direction::Down,
            )),
            Self::ClearanceOpened => (clearance > 0.0).then_some((
                Parameter::Clearance,
                START_CLEARANCE * clearance,
                Direction::Up,
            )),
            Self::AmplitudeRaised => (amplitude > 0.0).then_some((
                Parameter::Amplitude,
                START_AMPLITUDE * amplitude,
                Direction::Up,
            )),
            Self::AmplitudeLowered => {
                let free = free_amplitude(scene, w);
                let enough = amplitude * (GRAZING_FACTOR * reached / free).max(HIGH_FACTOR);
                (amplitude > 0.0 && enough.is_finite()).then_some((
                    Parameter::Amplitude,
                    enough,
                    Direction::Down,
                ))
            }
        }
    }
}

/// Frequency at which a rising one begins, in units of the lower one of the drive's and the mass's own.
const LOW_FREQUENCY: f64 = 0.5;
/// Frequency at which a falling one begins, in units of the higher one; least such factor of an amplitude.
const HIGH_FACTOR: f64 = 2.0;
/// Clearance at which an opening one begins, in units of that at work.
const START_CLEARANCE: f64 = 0.05;
/// Amplitude at which a rising one begins, in units of that at work.
const START_AMPLITUDE: f64 = 0.01;
/// Amplitude at which a falling one begins, in units of that of grazing.
const GRAZING_FACTOR: f64 = 1.5;
