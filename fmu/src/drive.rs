//! The drive as its inputs lead it: A cos(angle), the angle being the integral of the speed.
//!
//! While speed and amplitude are constant this is the harmonic drive of the engine, exact however long. Where they
//! change, the way is cut into pieces of a quarter of a radian; on each one the engine takes the harmonic drive with the
//! mean speed and the amplitude in the middle, and what is left is a force that is a polynomial in time: its Taylor
//! polynomial of degree 7 about the middle. The error of the force is of order 8 in the length of a piece, and below
//! 2e-12 of the amplitude.

use std::f64::consts::{PI, TAU};

use serde::{Deserialize, Serialize};
use softstop::internals::Polynomial;
use softstop::{Clock, Excitation, Simulation};
use softstop_fmi::Derivatives;

/// Length of a piece in rad.
const PIECE: f64 = 0.25;
/// Share of the parameter's frequency below which there is no harmonic drive: the time is resolved by its period.
const SLOWEST: f64 = 1.0 / 16.0;
/// Angle in rad beyond which the whole turns of a constant speed are counted apart: its rounding is below 1e-13 rad.
const MAX_COUNTED_ANGLE: f64 = 1e3;

/// Whether speed and amplitude are those of the inputs, and where the drive stands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Drive {
    pub takes_speed: bool,
    pub takes_amplitude: bool,
    /// Frequency in rad/s of the parameters.
    pub frequency: f64,
    /// Angle in rad at the time `since` in s, without so many whole turns where they would take digits of it.
    angle: f64,
    #[serde(default)]
    turns: f64,
    since: f64,
    /// Speed in rad/s and amplitude in N from there on.
    speed: Polynomial,
    amplitude: Polynomial,
}

/// A harmonic drive, and the force in N that is left.
pub(crate) struct Piece {
    pub amplitude: f64,
    pub frequency: f64,
    pub angle: f64,
    pub rest: Polynomial,
}

impl Drive {
    /// A drive that turns with this speed and amplitude from an angle on.
    pub fn new(angle: f64, since: f64, speed: f64, amplitude: f64) -> Self {
        Self {
            takes_speed: false,
            takes_amplitude: false,
            frequency: speed,
            angle,
            turns: 0.0,
            since,
            speed: Polynomial::linear(speed, 0.0),
            amplitude: Polynomial::linear(amplitude, 0.0),
        }
    }

    /// The drive of a machine at the start time: it begins at its phase where the input leads its speed, and at rest until
    /// the inputs are known.
    pub fn begin(of: &Simulation, (takes_speed, takes_amplitude): (bool, bool)) -> Self {
        let drive = of.scene().excitation;
        let (angle, whole, speed) = if takes_speed {
            let phase = drive.reduced_phase();
            (phase, phase, 0.0)
        } else {
            let angle = of.reduced_drive_angle();
            (angle, of.drive_angle(), drive.frequency)
        };
        let amplitude = if takes_amplitude {
            0.0
        } else {
            drive.amplitude
        };
        Self {
            takes_speed,
            takes_amplitude,
            frequency: drive.frequency,
            turns: ((whole - angle) / TAU).round(),
            ..Self::new(angle, of.time(), speed, amplitude)
        }
    }

    /// Lets it go on from `now` with another speed.
    pub fn set_speed(&mut self, now: f64, speed: Derivatives) {
        self.go_on_from(now);
        self.speed = Polynomial::new(speed);
    }

    /// Lets it go on from `now` with another amplitude.
    pub fn set_amplitude(&mut self, now: f64, amplitude: Derivatives) {
        self.go_on_from(now);
        self.amplitude = Polynomial::new(amplitude);
    }

    /// Counts the time from `now` on.
    fn go_on_from(&mut self, now: f64) {
        let (turns, phase) = self.turns_and_angle_at(now);
        (self.speed, self.amplitude) = (self.speed_at(now), self.amplitude_at(now));
        self.angle = Excitation {
            amplitude: 0.0,
            frequency: self.frequency,
            phase,
        }
        .reduced_phase();
        self.turns += turns + ((phase - self.angle) / TAU).round();
        self.since = now;
    }

    /// Counts whole turns of a constant speed up to `now` apart, where they would take digits of the angle.
    pub fn count_turns(&mut self, now: f64) {
        if self.turns_and_angle_at(now).0 != 0.0 {
            self.go_on_from(now);
        }
    }

    /// Goes on from `now` with other parameters, where the inputs do not say it.
    pub fn follow(&mut self, now: f64, frequency: f64, amplitude: f64) {
        self.frequency = frequency;
        if !self.takes_speed {
            self.set_speed(now, constant(frequency));
        }
        if !self.takes_amplitude {
            self.set_amplitude(now, constant(amplitude));
        }
    }

    /// Speed and its derivatives at a time.
    pub fn speed_at(&self, time: f64) -> Polynomial {
        self.speed.shifted(time - self.since)
    }

    /// Amplitude and its derivatives at a time.
    pub fn amplitude_at(&self, time: f64) -> Polynomial {
        self.amplitude.shifted(time - self.since)
    }

    /// The angle in rad at a time, over all turns.
    pub fn whole_angle_at(&self, time: f64) -> f64 {
        let (turns, angle) = self.turns_and_angle_at(time);
        TAU.mul_add(self.turns + turns, angle)
    }

    /// The angle in rad at a time, without whole turns that would take digits of it.
    pub fn angle_at(&self, time: f64) -> f64 {
        self.turns_and_angle_at(time).1
    }

    /// Whole turns that are counted apart since `since`, and the angle in rad beside them, at a time.
    fn turns_and_angle_at(&self, time: f64) -> (f64, f64) {
        let (t, speed) = (time - self.since, self.speed.value());
        if self.is_steady() && (speed * t).abs() > MAX_COUNTED_ANGLE {
            let at = Clock::new(speed.abs(), 0.0).instant(t);
            return (
                speed.signum() * at.cycles,
                speed.mul_add(at.offset, self.angle),
            );
        }
        let terms = self.speed.derivatives().iter();
        let turned = terms.enumerate().rev().fold(0.0, |sum, (k, derivative)| {
            (derivative + sum) * (t / (k + 1) as f64)
        });
        (0.0, self.angle + turned)
    }

    /// True if it turns with a constant speed.
    fn is_steady(&self) -> bool {
        self.speed.is_constant()
    }

    /// True if it turns with a constant speed and amplitude, as an engine's drive does.
    pub fn is_harmonic(&self) -> bool {
        !self.varies() && self.speed.value() != 0.0
    }

    /// True if it has to be followed in pieces.
    pub fn varies(&self) -> bool {
        let speed = self.speed.value().abs();
        let crawls = speed > 0.0 && speed < SLOWEST * self.frequency;
        crawls || !self.is_steady() || !self.amplitude.is_constant()
    }

    /// Where the piece ends that begins at `time`, not after `until`.
    pub fn end_of_piece(&self, time: f64, until: f64) -> f64 {
        let amplitude = self.amplitude_at(time);
        let size = amplitude
            .value()
            .abs()
            .max(self.amplitude_at(until).value().abs());
        let root = |of: f64, order: usize| of.abs().powf(1.0 / order as f64);
        let turning = self.speed_at(time);
        let speeds = turning.derivatives().iter().enumerate();
        let swelling = amplitude.derivatives().iter().enumerate().skip(2);
        let swelling = swelling.filter(|_| size > 0.0);
        let rate = speeds.map(|(k, of)| root(*of, k + 1)).sum::<f64>()
            + swelling.map(|(k, of)| root(of / size, k)).sum::<f64>();
        let end = time + PIECE / rate;
        if end < until { end } else { until }
    }

    /// Value and derivatives of the force in N at a time.
    pub fn force_at(&self, time: f64) -> Polynomial {
        let turning = self.speed_at(time).taylor_coefficients();
        let amplitude = self.amplitude_at(time).taylor_coefficients();
        let (mut cos, mut sin) = (Derivatives::default(), Derivatives::default());
        (sin[0], cos[0]) = self.angle_at(time).sin_cos();
        for k in 0..cos.len() - 1 {
            let sum = |of: &Derivatives| (0..=k).map(|j| turning[j] * of[k - j]).sum::<f64>();
            let share = 1.0 / (k + 1) as f64;
            (cos[k + 1], sin[k + 1]) = (-share * sum(&sin), share * sum(&cos));
        }
        let mut factorial = 1.0;
        Polynomial::new(std::array::from_fn(|k| {
            factorial *= k.max(1) as f64;
            factorial * (0..=k).map(|j| amplitude[j] * cos[k - j]).sum::<f64>()
        }))
    }

    /// The piece between two times.
    pub fn piece(&self, from: f64, until: f64) -> Piece {
        let span = until - from;
        let (angle, middle) = (self.angle_at(from), from + 0.5 * span);
        let speed = if span > 0.0 && !self.is_steady() {
            (self.angle_at(until) - angle) / span
        } else {
            self.speed_at(from).value()
        };
        let amplitude = self.amplitude_at(middle).value();
        if speed.abs() < SLOWEST * self.frequency {
            return Piece {
                amplitude: 0.0,
                frequency: self.frequency,
                angle,
                rest: self.force_at(middle).shifted(from - middle),
            };
        }
        let rest = if self.varies() {
            let harmonic = Self::new(angle, from, speed, amplitude).force_at(middle);
            let all = self.force_at(middle);
            let rest = |k: usize| all.derivatives()[k] - harmonic.derivatives()[k];
            Polynomial::new(std::array::from_fn(rest)).shifted(from - middle)
        } else {
            Polynomial::default()
        };
        // cos(angle + w t) with a positive frequency and amplitude.
        let turned = if amplitude < 0.0 { PI } else { 0.0 };
        Piece {
            amplitude: amplitude.abs(),
            frequency: speed.abs(),
            angle: angle * speed.signum() + turned,
            rest,
        }
    }
}

fn constant(value: f64) -> Derivatives {
    *Polynomial::linear(value, 0.0).derivatives()
}
