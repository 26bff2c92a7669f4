//! The shaft that leads the feeder: where it stands, and when a turn of it is full.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};
use softstop_fmi::Derivatives;

use super::slot;
use crate::signal::Signal;

/// A shaft that turns by itself, or as it is told.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Shaft {
    takes_angle: bool,
    speed: f64,
    /// Angle in rad at which it feeds.
    feeds_at: f64,
    pub time: f64,
    /// Angle in rad.
    angle: f64,
    /// Angle as it goes on from the last time at which it was told.
    told: Signal,
    /// Full turns beyond `feeds_at` so far: turning back does not take them back.
    pub turn: i64,
}

impl Shaft {
    pub fn begin(values: &[f64], time: f64) -> Self {
        let value = |slot: softstop_fmi::variable::Slot| values[slot.0];
        let (angle, feeds_at) = (value(slot::INITIAL_ANGLE), value(slot::ANGLE));
        let mut shaft = Self {
            takes_angle: value(slot::TAKES_ANGLE) != 0.0,
            speed: value(slot::SPEED),
            feeds_at,
            time,
            angle,
            told: Signal::default(),
            turn: ((angle - feeds_at) / TAU).floor() as i64,
        };
        shaft.turn_by_itself();
        shaft
    }

    fn turn_by_itself(&mut self) {
        if !self.takes_angle {
            let mut derivatives = Derivatives::default();
            [derivatives[0], derivatives[1]] = [self.angle, self.speed];
            self.told = Signal::new(derivatives, self.time);
        }
    }

    /// Takes over another speed.
    pub fn tune(&mut self, values: &[f64]) {
        let speed = values[slot::SPEED.0];
        if speed != self.speed {
            self.speed = speed;
            self.turn_by_itself();
        }
    }

    /// Takes the angle as an input tells it, from now on.
    pub fn tell(&mut self, derivatives: &Derivatives) {
        if self.takes_angle {
            self.told = Signal::new(*derivatives, self.time);
        }
    }

    /// Moves what the input tells.
    pub fn move_told(&mut self, by: f64) {
        if self.takes_angle {
            self.told.derivatives[0] += by;
        }
    }

    /// Moves where it stands.
    pub fn move_start(&mut self, by: f64) {
        self.angle += by;
        self.turn_by_itself();
    }

    /// The angle at a time of the step that ends at `until`: what it lags behind is made up evenly.
    fn angle_at(&self, time: f64, until: f64) -> f64 {
        let left = self.angle - self.told.at(self.time, 0);
        let span = until - self.time;
        let share = if span > 0.0 {
            (until - time) / span
        } else {
            1.0
        };
        left.mul_add(share, self.told.at(time, 0))
    }

    /// Full turns at the end of a step; nothing if there are too many to count.
    pub fn turn_at(&self, until: f64) -> Option<i64> {
        let turns = ((self.angle_at(until, until) - self.feeds_at) / TAU).floor();
        (turns.abs() < 1e15).then_some(turns as i64)
    }

    /// The time in the step up to `until` at which a turn is full, by bisection.
    pub fn time_of(&self, turn: i64, until: f64) -> f64 {
        let at = TAU.mul_add(turn as f64, self.feeds_at);
        let (mut low, mut high) = (self.time, until);
        loop {
            let middle = low + 0.5 * (high - low);
            if middle <= low || middle >= high {
                return high;
            }
            if self.angle_at(middle, until) < at {
                low = middle;
            } else {
                high = middle;
            }
        }
    }

    /// Goes on to the end of a step.
    pub fn go_to(&mut self, until: f64) {
        (self.angle, self.time) = (self.angle_at(until, until), until);
    }
}
