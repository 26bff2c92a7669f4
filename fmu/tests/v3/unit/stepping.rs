//! Steps of a unit and its events.

use std::ffi::c_int;

use softstop_fmi3::*;

use super::{CLOCK, Ending, Unit};
use crate::common::OK;

impl Unit {
    /// Status and value of the clock of impacts.
    pub fn try_clock(&self) -> (c_int, bool) {
        let mut ticks = 7;
        // SAFETY: one reference and one value.
        let status = unsafe { fmi3GetClock(self.instance, &CLOCK, 1, &raw mut ticks) };
        assert!(status != OK || ticks <= 1);
        (status, ticks == 1)
    }

    pub fn ticks(&self) -> bool {
        let (status, ticks) = self.try_clock();
        self.check(status);
        ticks
    }

    /// Status and ending of a step.
    pub fn try_step(&self, point: f64, size: f64) -> (c_int, Ending) {
        let (mut event, mut end, mut early, mut time) = (7, 7, 7, f64::NAN);
        // SAFETY: places for the answers.
        let status = unsafe {
            let (event, end, early) = (&raw mut event, &raw mut end, &raw mut early);
            fmi3DoStep(
                self.instance,
                point,
                size,
                1,
                event,
                end,
                early,
                &raw mut time,
            )
        };
        let ending = Ending {
            event: event == 1,
            early: early == 1,
            time,
        };
        (status, ending)
    }

    pub fn step(&self, point: f64, size: f64) -> Ending {
        let (status, ending) = self.try_step(point, size);
        self.check(status);
        ending
    }

    pub fn enter_event_mode(&self) {
        // SAFETY: the instance is alive.
        self.check(unsafe { fmi3EnterEventMode(self.instance) });
    }

    pub fn leave_event_mode(&self) {
        // SAFETY: the instance is alive.
        self.check(unsafe { fmi3EnterStepMode(self.instance) });
    }

    /// Lets the event happen; when the next one comes.
    pub fn update(&self) -> Option<f64> {
        let (status, next) = self.try_update();
        self.check(status);
        next
    }

    pub fn try_update(&self) -> (c_int, Option<f64>) {
        let (status, next, _) = self.try_update_states();
        (status, next)
    }

    /// Status, time of the next event, and whether states have changed.
    pub fn try_update_states(&self) -> (c_int, Option<f64>, bool) {
        let (mut flags, mut time) = ([7u8; 5], f64::NAN);
        let [a, b, c, d, defined] = flags.each_mut().map(|flag| &raw mut *flag);
        // SAFETY: places for the answers.
        let status =
            unsafe { fmi3UpdateDiscreteStates(self.instance, a, b, c, d, defined, &raw mut time) };
        assert!(status != OK || flags[..2] == [0; 2]);
        assert!(status != OK || self.is_for_exchange || flags[2..4] == [0; 2]);
        (status, (flags[4] == 1).then_some(time), flags[3] == 1)
    }

    /// Goes to a time in steps of one size, and handles events if there is event mode; what `see` says of each.
    pub fn run(&self, end: f64, size: f64, mut see: impl FnMut(&Self, Ending)) {
        let (mut point, mut number) = (0.0, 1.0);
        while point < end {
            let aim = (number * size).min(end);
            let ending = self.step(point, aim - point);
            if ending.early {
                point = ending.time;
            } else {
                (point, number) = (aim, number + 1.0);
            }
            if ending.event {
                self.enter_event_mode();
                see(self, ending);
                self.update();
                self.leave_event_mode();
            }
            if ending.event || ending.early {
                see(self, ending);
            }
        }
    }
}
