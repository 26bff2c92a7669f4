//! An importer of model exchange that integrates.

use std::ffi::{c_int, c_void};

use softstop_fmi3::*;
use softstop_fmu::Options;

use super::unit::Unit;

pub type States = [f64; 2];

/// Reads a vector of the model.
type Vector = unsafe extern "C" fn(*mut c_void, *mut f64, usize) -> c_int;

/// An importer that integrates with steps of one size by the method of Runge and Kutta, and steps to each event that it is
/// told of.
pub struct Integrator {
    pub unit: Unit,
    pub time: f64,
    pub next: Option<f64>,
    /// State before and after each event, with its time.
    pub events: Vec<(f64, States, States)>,
}

impl Integrator {
    pub fn begun(values: &[(&str, f64)]) -> Self {
        Self::of(Unit::for_exchange(Options::default()), values)
    }

    /// An importer of a unit that it begins with these values.
    pub fn of(unit: Unit, values: &[(&str, f64)]) -> Self {
        unit.initialize(values);
        let mut begun = Self {
            unit,
            time: 0.0,
            next: None,
            events: Vec::new(),
        };
        begun.leave_event_mode();
        begun
    }

    /// A vector of the model.
    fn vector<const COUNT: usize>(&self, function: Vector) -> [f64; COUNT] {
        let mut values = [f64::NAN; COUNT];
        // SAFETY: a place for so many numbers.
        let status = unsafe { function(self.unit.instance, values.as_mut_ptr(), COUNT) };
        self.unit.check(status);
        values
    }

    pub fn states(&self) -> States {
        self.vector(fmi3GetContinuousStates)
    }

    pub fn derivatives(&self) -> States {
        self.vector(fmi3GetContinuousStateDerivatives)
    }

    pub fn nominals(&self) -> States {
        self.vector(fmi3GetNominalsOfContinuousStates)
    }

    pub fn indicators(&self) -> [f64; 3] {
        self.vector(fmi3GetEventIndicators)
    }

    pub fn put(&self, time: f64, states: States) {
        // SAFETY: two numbers.
        unsafe {
            let instance = self.unit.instance;
            self.unit.check(fmi3SetTime(instance, time));
            self.unit
                .check(fmi3SetContinuousStates(instance, states.as_ptr(), 2));
        }
    }

    /// One step; whether the unit asks for event mode.
    pub fn step(&mut self, size: f64) -> bool {
        let (begin, from) = (self.states(), self.time);
        let moved = |by: f64, rates: States| std::array::from_fn(|k| begin[k] + by * rates[k]);
        let at = |part: f64, rates: States| {
            self.put(from + part * size, moved(part * size, rates));
            self.derivatives()
        };
        let one = at(0.0, [0.0; 2]);
        let two = at(0.5, one);
        let three = at(0.5, two);
        let four = at(1.0, three);
        let mean = std::array::from_fn(|k| (one[k] + 2.0 * (two[k] + three[k]) + four[k]) / 6.0);
        self.time = from + size;
        self.put(self.time, moved(size, mean));
        let (mut enter, mut terminate) = (7, 7);
        let (instance, enter_place) = (self.unit.instance, &raw mut enter);
        // SAFETY: places for the answers.
        let status =
            unsafe { fmi3CompletedIntegratorStep(instance, 1, enter_place, &raw mut terminate) };
        self.unit.check(status);
        enter == 1
    }

    /// Lets events happen and goes on; whether the states have changed.
    pub fn leave_event_mode(&mut self) -> bool {
        let (status, next, has_new_states) = self.unit.try_update_states();
        self.unit.check(status);
        self.next = next;
        // SAFETY: the instance is alive.
        self.unit
            .check(unsafe { fmi3EnterContinuousTimeMode(self.unit.instance) });
        assert!(self.indicators().iter().all(|indicator| *indicator != 0.0));
        has_new_states
    }

    /// Goes on to a time in steps of some size at most.
    pub fn run(&mut self, end: f64, size: f64) {
        while self.time < end {
            let stop = self.next.map_or(end, |next| next.min(end));
            let count = ((stop - self.time) / size).ceil().max(1.0);
            let is_asked = self.step((stop - self.time) / count);
            if count == 1.0 {
                self.time = stop;
                self.put(stop, self.states());
            }
            if is_asked || self.next == Some(self.time) {
                let before = self.states();
                self.unit.enter_event_mode();
                self.leave_event_mode();
                self.events.push((self.time, before, self.states()));
            }
        }
    }
}
