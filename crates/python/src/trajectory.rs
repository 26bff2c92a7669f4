//! One exact motion.

use std::ops::ControlFlow;

use numpy::{PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use softstop::{
    AppliedForce, Clock, CrossingKind, ImpactEvent, Observer, Start, Trajectory as Motion,
};
use softstop_console::budget::Budget;
use softstop_console::interrupt;

use crate::errors::{SoftstopError, of_failure, of_motion};
use crate::machine::Machine;
use crate::rows::Array;
use crate::supervise::supervise;

/// States that are computed between two looks for Ctrl-C.
const UNHEARD: usize = 100_000;

/// An exact motion from time 0 over whole drive periods.
#[pyclass(frozen, module = "softstop._softstop")]
pub struct Trajectory {
    motion: Motion,
    #[pyo3(get)]
    duration: f64,
}

/// Stops a motion after Ctrl-C.
struct Interrupt;

impl Observer for Interrupt {
    fn progress(&mut self, _: u64) -> ControlFlow<()> {
        interrupt::go_on()
    }
}

#[pymethods]
impl Trajectory {
    /// Forces begin at times in s, each with a row of derivatives: value in N, rate in N/s, and so on.
    #[new]
    fn new(
        py: Python<'_>,
        machine: &Machine,
        start: (f64, f64),
        periods: u64,
        forces: (PyReadonlyArray1<'_, f64>, PyReadonlyArray2<'_, f64>),
    ) -> PyResult<Self> {
        let scene = &machine.stated.scene;
        let start = Start::new(start.0, start.1);
        let derivatives = forces.1.as_array();
        let rows = forces.0.as_slice()?.iter().zip(derivatives.outer_iter());
        let forces: Vec<AppliedForce> = rows
            .map(|(from, row)| AppliedForce {
                from: *from,
                derivatives: row.to_vec(),
            })
            .collect();
        let end = Clock::at_cycle(periods);
        let motion = supervise(py, &None, || {
            let follow = || scene.trajectory_with_forces(start, end, &forces, &mut Interrupt);
            Budget::MACHINE.limit(|| Ok(follow()))
        })?;
        let motion = motion
            .map_err(of_failure)?
            .map_err(|error| of_motion(&error))?;
        let duration = periods as f64 * motion.clock.period();
        Ok(Self { motion, duration })
    }

    /// Positions in m and velocities in m/s at times in s within the motion.
    fn sample(&self, py: Python<'_>, times: PyReadonlyArray1<'_, f64>) -> PyResult<(Array, Array)> {
        let motion = &self.motion;
        let at = |time: &f64| {
            let within = (0.0..=self.duration).contains(time);
            let state = motion.at(motion.clock.instant(*time)).filter(|_| within);
            let last = state.or((*time == self.duration).then_some(motion.end));
            last.ok_or_else(|| {
                SoftstopError::new_err(format!("time = {time}: must be in [0, {}]", self.duration))
            })
        };
        let times = times.as_slice()?;
        let mut states = Vec::with_capacity(times.len());
        for part in times.chunks(UNHEARD) {
            let part = py.detach(|| part.iter().map(at).collect::<PyResult<Vec<Start>>>());
            states.append(&mut part?);
            py.check_signals()?;
        }
        let column =
            |value: fn(&Start) -> f64| PyArray1::from_iter(py, states.iter().map(value)).unbind();
        Ok((column(|it| it.position), column(|it| it.velocity)))
    }

    /// Times in s and before-impact velocities in m/s of all impacts.
    fn impacts(&self, py: Python<'_>) -> (Array, Array) {
        let clock = &self.motion.clock;
        let column = |value: &dyn Fn(ImpactEvent) -> f64| {
            PyArray1::from_iter(py, self.motion.impacts().map(value)).unbind()
        };
        (
            column(&|it| clock.time(it.instant)),
            column(&|it| it.before_impact_velocity),
        )
    }

    /// Times in s, positions in m, velocities in m/s before and after, and kinds of all crossings.
    fn crossings(&self, py: Python<'_>) -> (Array, Array, Array, Array, Vec<String>) {
        let clock = &self.motion.clock;
        let all = || self.motion.crossings();
        let column = |value: &dyn Fn(&softstop::Crossing) -> f64| {
            PyArray1::from_iter(py, all().map(value)).unbind()
        };
        (
            column(&|it| clock.time(it.instant)),
            column(&|it| it.position),
            column(&|it| it.velocity),
            column(&|it| it.velocity_after),
            all().map(|it| name(it.kind).to_owned()).collect(),
        )
    }

    /// Energies in J: supplied by the drive, dissipated, and stored at the end less at the start.
    #[getter]
    fn energies(&self) -> (f64, f64, f64) {
        let work = self.motion.work();
        (work.supplied, work.dissipated, self.motion.stored())
    }

    /// Position in m and velocity in m/s at the end.
    #[getter]
    fn end(&self) -> (f64, f64) {
        (self.motion.end.position, self.motion.end.velocity)
    }
}

/// What a crossing is called.
fn name(kind: CrossingKind) -> &'static str {
    match kind {
        CrossingKind::Surface { impact: true, .. } | CrossingKind::Rebound { impact: true, .. } => {
            "impact"
        }
        CrossingKind::Surface { pierces: true, .. } => "pierces",
        CrossingKind::Surface { forward: true, .. } => "forward",
        CrossingKind::Surface { .. } => "back",
        CrossingKind::Rebound { .. } => "rebound",
        CrossingKind::Reversal => "reversal",
        CrossingKind::Switch => "switch",
        CrossingKind::Rest => "rest",
        CrossingKind::Release => "release",
    }
}
