//! One unit: its lifecycle, its values, and the motion behind them.

use std::fmt;

use serde::{Deserialize, Serialize};
use softstop::flow::Polynomial;
use softstop::{MotionError, Simulation};

use crate::error::{Fault, argument};
use crate::start::StartValues;
use crate::status::Status;

/// Where an instance stands between instantiation and its end (FMI 2.0, 4.2.4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Lifecycle {
    /// Made or reset.
    Instantiated,
    /// Between entering and leaving initialisation.
    Initializing,
    /// Ready for the next step.
    Running,
    /// A defect of this library showed.
    Failed,
    /// Ended by the importer.
    Terminated,
}

impl fmt::Display for Lifecycle {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str(match self {
            Self::Instantiated => "before initialisation",
            Self::Initializing => "during initialisation",
            Self::Running => "after initialisation",
            Self::Failed => "after an internal error",
            Self::Terminated => "after fmi2Terminate",
        })
    }
}

/// The input `force`: its value and derivatives at a time, from which it goes on.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Force {
    pub(crate) polynomial: Polynomial,
    pub(crate) since: f64,
}

impl Force {
    pub(crate) fn at(&self, time: f64) -> f64 {
        self.polynomial.at(time - self.since)
    }

    pub(crate) fn seen_from(&self, time: f64) -> Polynomial {
        self.polynomial.shifted(time - self.since)
    }
}

/// What was set and has not reached the motion yet.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(crate) struct Pending {
    pub(crate) tuning: bool,
    pub(crate) force: bool,
}

/// One unit. Its clone is a snapshot from which it, or another one, can go on bit by bit.
#[derive(Clone)]
pub struct Instance {
    initial: StartValues,
    pub(crate) parameters: StartValues,
    pub(crate) lifecycle: Lifecycle,
    pub(crate) force: Force,
    pub(crate) material: bool,
    pub(crate) experiment: Option<Experiment>,
    pub(crate) simulation: Option<Simulation>,
    pub(crate) pending: Pending,
    /// The motion and the force with which the last step began, if it was discarded.
    pub(crate) discarded: Option<Box<(Simulation, Force)>>,
}

/// What `fmi2SetupExperiment` said.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct Experiment {
    pub(crate) start: f64,
    pub(crate) stop: Option<f64>,
}

impl Instance {
    /// A fresh unit with these start values.
    pub fn new(initial: StartValues) -> Self {
        Self {
            initial,
            parameters: initial,
            lifecycle: Lifecycle::Instantiated,
            force: Force::default(),
            material: true,
            experiment: None,
            simulation: None,
            pending: Pending::default(),
            discarded: None,
        }
    }

    /// Where the unit stands.
    pub fn lifecycle(&self) -> Lifecycle {
        self.lifecycle
    }

    /// Back to the fresh unit.
    pub fn reset(&mut self) {
        *self = Self::new(self.initial);
    }

    /// How the last step ended.
    pub fn last_status(&self) -> Status {
        match (self.lifecycle, &self.discarded) {
            (Lifecycle::Failed, _) => Status::Error,
            (_, Some(_)) => Status::Discard,
            (_, None) => Status::Ok,
        }
    }

    /// Marks the unit as unable to go on: only reading, resetting and freeing are left.
    pub fn fail(&mut self) {
        self.lifecycle = Lifecycle::Failed;
    }

    /// The time that the motion has reached, in s.
    pub fn time(&self) -> f64 {
        match (&self.simulation, self.experiment) {
            (Some(simulation), _) => simulation.time(),
            (None, Some(experiment)) => experiment.start,
            (None, None) => 0.0,
        }
    }

    /// Takes the start and stop time of the experiment.
    ///
    /// # Errors
    /// In another state than [`Lifecycle::Instantiated`], or if a number is not usable.
    pub fn setup(
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
            return Err(argument("tolerance", tolerance, "finite and >= 0"));
        }
        if !start.is_finite() {
            return Err(argument("startTime", start, "finite"));
        }
        if let Some(stop) = stop.filter(|stop| !(stop.is_finite() && *stop >= start)) {
            return Err(argument(
                "stopTime",
                stop,
                "finite and not before startTime",
            ));
        }
        self.experiment = Some(Experiment { start, stop });
        self.force.since = start;
        self.simulation = None;
        Ok(())
    }

    /// Enters initialisation.
    ///
    /// # Errors
    /// In another state than [`Lifecycle::Instantiated`], or without an experiment.
    pub fn enter_initialization(&mut self) -> Result<(), Fault> {
        self.require(
            &[Lifecycle::Instantiated],
            "it is entered once, after fmi2SetupExperiment",
        )?;
        if self.experiment.is_none() {
            return Err(Fault::WrongState {
                state: self.lifecycle,
                remedy: "fmi2SetupExperiment must come first",
            });
        }
        self.lifecycle = Lifecycle::Initializing;
        Ok(())
    }

    /// Leaves initialisation: the unit is ready for its first step.
    ///
    /// # Errors
    /// If it was not entered, or if the parameters do not describe a machine; they can then be set
    /// anew.
    pub fn exit_initialization(&mut self) -> Result<(), Fault> {
        self.require(
            &[Lifecycle::Initializing],
            "fmi2EnterInitializationMode must come first",
        )?;
        self.settle()?;
        self.lifecycle = Lifecycle::Running;
        Ok(())
    }

    /// Ends the experiment; values can still be read.
    ///
    /// # Errors
    /// If it is not running.
    pub fn terminate(&mut self) -> Result<(), Fault> {
        self.require(
            &[Lifecycle::Running, Lifecycle::Failed],
            "only an initialised unit can be terminated",
        )?;
        if self.lifecycle == Lifecycle::Running {
            self.settle()?;
        }
        self.lifecycle = Lifecycle::Terminated;
        Ok(())
    }

    pub(crate) fn require(&self, states: &[Lifecycle], remedy: &'static str) -> Result<(), Fault> {
        if states.contains(&self.lifecycle) {
            Ok(())
        } else {
            Err(Fault::WrongState {
                state: self.lifecycle,
                remedy,
            })
        }
    }

    /// The motion, with all that was set taken over.
    pub(crate) fn settle(&mut self) -> Result<&mut Simulation, Fault> {
        let mut simulation = match self.simulation.take() {
            Some(simulation) => simulation,
            None => self.begin()?,
        };
        let taken_over = self.take_over(&mut simulation);
        let simulation = self.simulation.insert(simulation);
        taken_over.map(|()| simulation)
    }

    /// The motion at the start time.
    fn begin(&mut self) -> Result<Simulation, Fault> {
        let start = self.time();
        let scene = self.parameters.scene();
        let simulation = Simulation::new_fed(&scene, self.parameters.start(), start, self.material)
            .map_err(at_start)?;
        self.force.since = start;
        self.pending = Pending {
            tuning: false,
            force: self.force.polynomial != Polynomial::default(),
        };
        Ok(simulation)
    }

    fn take_over(&mut self, simulation: &mut Simulation) -> Result<(), Fault> {
        if self.pending.tuning {
            simulation.tune(&self.parameters.scene())?;
            self.pending.tuning = false;
        }
        if self.pending.force {
            simulation.set_force(self.force.polynomial.derivatives())?;
            self.pending.force = false;
        }
        Ok(())
    }
}

/// What keeps a motion from beginning, in the names of the variables.
fn at_start(error: MotionError) -> Fault {
    match error {
        MotionError::BeyondStop { position, wall } => Fault::StartBeyondStop { position, wall },
        other => other.into(),
    }
}
