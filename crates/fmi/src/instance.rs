//! One instance of a unit: its lifecycle, its values, and the motion behind them.

use std::mem;

use serde::{Deserialize, Serialize};

use crate::fault::{Fault, Status};
use crate::lifecycle::Lifecycle;
use crate::signal::Signal;
use crate::solving::Exchange;
use crate::unit::Unit;

/// One instance. Its clone is a snapshot from which it, or another one, can go on bit by bit.
#[derive(Serialize, Deserialize)]
#[serde(bound = "")]
pub(crate) struct Instance<U: Unit> {
    pub(crate) lifecycle: Lifecycle,
    /// Parameters and discrete inputs, slot by slot.
    pub(crate) values: Vec<f64>,
    /// Continuous inputs.
    pub(crate) signals: Vec<Signal>,
    pub(crate) experiment: Option<Experiment>,
    pub(crate) unit: Option<U>,
    /// Values were set that have not reached the unit yet.
    pub(crate) tuned: bool,
    /// The values before those that do not go together so far.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) sound: Option<Vec<f64>>,
    /// The last step was discarded.
    pub(crate) fell_short: bool,
    /// The unit and the signals with which it began, if it can be repeated.
    pub(crate) retreat: Option<Box<(U, Vec<Signal>)>>,
    /// The unit stands before an event: what was set reaches it after that.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(crate) awaits: bool,
    /// Where in s the last step was to end, if an event ended it before.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) aim: Option<f64>,
    /// What an importer has set that integrates by itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) exchange: Option<Box<Exchange<U>>>,
    /// How many events the clock has told of.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub(crate) ticks: i32,
}

fn is_zero(count: &i32) -> bool {
    *count == 0
}

/// What `fmi2SetupExperiment` said.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct Experiment {
    pub(crate) start: f64,
    pub(crate) stop: Option<f64>,
}

impl<U: Unit> Clone for Instance<U> {
    fn clone(&self) -> Self {
        let mut clone = Self::new();
        clone.clone_from(self);
        clone
    }

    /// Reuses the memory of values and signals: going back to a snapshot is asked for as often as a step.
    fn clone_from(&mut self, kept: &Self) {
        let Self {
            lifecycle,
            values,
            signals,
            experiment,
            unit,
            tuned,
            sound,
            fell_short,
            retreat,
            awaits,
            aim,
            exchange,
            ticks,
        } = kept;
        self.lifecycle = *lifecycle;
        self.values.clone_from(values);
        self.signals.clone_from(signals);
        self.experiment = *experiment;
        self.unit.clone_from(unit);
        self.tuned = *tuned;
        self.sound.clone_from(sound);
        self.fell_short = *fell_short;
        self.retreat.clone_from(retreat);
        self.awaits = *awaits;
        self.aim = *aim;
        self.exchange.clone_from(exchange);
        self.ticks = *ticks;
    }
}

impl<U: Unit> Instance<U> {
    /// A fresh instance with the start values of the library.
    pub(crate) fn new() -> Self {
        Self {
            lifecycle: Lifecycle::Instantiated,
            values: U::block().values(),
            signals: vec![Signal::default(); U::about().table.signals()],
            experiment: None,
            unit: None,
            tuned: false,
            sound: None,
            fell_short: false,
            retreat: None,
            awaits: false,
            aim: None,
            exchange: None,
            ticks: 0,
        }
    }

    /// How the last step ended.
    pub(crate) fn last_status(&self) -> Status {
        match (self.lifecycle, self.fell_short) {
            (Lifecycle::Failed, _) => Status::Error,
            (_, true) => Status::Discard,
            (_, false) => Status::Ok,
        }
    }

    /// The time that the unit has reached, in s, or the importer that integrates.
    pub(crate) fn time(&self) -> f64 {
        if let Some(exchange) = &self.exchange {
            return exchange.time;
        }
        match (&self.unit, self.experiment) {
            (Some(unit), _) => unit.time(),
            (None, Some(experiment)) => experiment.start,
            (None, None) => 0.0,
        }
    }

    /// Takes the start and stop time of the experiment.
    pub(crate) fn setup(
        &mut self,
        tolerance: Option<f64>,
        start: f64,
        stop: Option<f64>,
    ) -> Result<(), Fault> {
        self.require(
            &[Lifecycle::Instantiated],
            "call it between fmi2Instantiate and fmi2EnterInitializationMode",
        )?;
        if let Some(tolerance) = tolerance.filter(|t| !(t.is_finite() && *t >= 0.0)) {
            return Err(Fault::argument("tolerance", tolerance, "finite and >= 0"));
        }
        if !start.is_finite() {
            return Err(Fault::argument("startTime", start, "finite"));
        }
        if let Some(stop) = stop.filter(|stop| !(stop.is_finite() && *stop >= start)) {
            let allowed = "finite and not before startTime";
            return Err(Fault::argument("stopTime", stop, allowed));
        }
        self.experiment = Some(Experiment { start, stop });
        start_signals(&mut self.signals, start);
        self.unit = None;
        Ok(())
    }

    /// Enters initialisation.
    pub(crate) fn enter_initialization(&mut self) -> Result<(), Fault> {
        self.require(
            &[Lifecycle::Instantiated],
            "it is entered once, after fmi2SetupExperiment",
        )?;
        if self.experiment.is_none() {
            return Err(self.not_allowed("fmi2SetupExperiment must come first"));
        }
        self.lifecycle = Lifecycle::Initializing;
        Ok(())
    }

    /// Leaves initialisation: the instance is ready for its first step.
    pub(crate) fn exit_initialization(&mut self) -> Result<(), Fault> {
        self.require(
            &[Lifecycle::Initializing],
            "fmi2EnterInitializationMode must come first",
        )?;
        self.settle()?;
        self.lifecycle = Lifecycle::Running;
        Ok(())
    }

    /// Ends the experiment; values can still be read.
    pub(crate) fn terminate(&mut self) -> Result<(), Fault> {
        self.require(
            &[
                Lifecycle::Running,
                Lifecycle::Event,
                Lifecycle::Continuous,
                Lifecycle::Failed,
            ],
            "only an initialised unit can be terminated",
        )?;
        // Nothing needs what does not go together any more.
        if let Some(sound) = self.sound.take() {
            self.values = sound;
        }
        self.ready_for_outputs()?;
        self.lifecycle = Lifecycle::Terminated;
        Ok(())
    }

    /// The fault of a call that the present state does not allow.
    pub(crate) fn not_allowed(&self, remedy: &'static str) -> Fault {
        Fault::WrongState {
            state: self.lifecycle,
            remedy,
        }
    }

    pub(crate) fn require(&self, states: &[Lifecycle], remedy: &'static str) -> Result<(), Fault> {
        if states.contains(&self.lifecycle) {
            Ok(())
        } else {
            Err(self.not_allowed(remedy))
        }
    }

    /// The unit, with all that was set taken over; at the start time if it has not begun.
    pub(crate) fn settle(&mut self) -> Result<&mut U, Fault> {
        let start = self.time();
        let Self {
            unit,
            values,
            signals,
            tuned,
            sound,
            awaits,
            ..
        } = self;
        let unit = match unit {
            Some(unit) => unit,
            none => {
                let unit = none.insert(U::begin(values, start)?);
                start_signals(signals, start);
                *tuned = false;
                unit
            }
        };
        if *awaits {
            return Ok(unit);
        }
        if let Some(sound) = sound.take() {
            let unfit = mem::replace(values, sound);
            U::check_values(&unfit).map_err(Fault::Unfit)?;
        }
        if *tuned {
            unit.tune(values)?;
            *tuned = false;
        }
        for (number, signal) in signals.iter_mut().enumerate() {
            if signal.pending {
                unit.drive(number, &signal.derivatives)?;
                signal.pending = false;
            }
        }
        Ok(unit)
    }
}

/// Counts the time of all signals from the start.
fn start_signals(signals: &mut [Signal], start: f64) {
    for signal in signals {
        *signal = Signal::new(signal.derivatives, start);
    }
}
