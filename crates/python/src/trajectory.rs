//! One exact motion.

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use softstop::{CrossingKind, Start, Trajectory as Motion};
use softstop_console::budget::Budget;

use crate::errors::{SoftstopError, of_failure, of_motion};
use crate::machine::Machine;
use crate::supervise::supervise;

/// An exact motion from time 0 over whole drive periods.
#[pyclass(frozen, module = "softstop._softstop")]
pub struct Trajectory {
    motion: Motion,
    #[pyo3(get)]
    duration: f64,
}

type Array = Py<PyArray1<f64>>;

#[pymethods]
impl Trajectory {
    #[new]
    fn new(py: Python<'_>, machine: &Machine, start: (f64, f64), periods: u64) -> PyResult<Self> {
        let scene = &machine.stated.scene;
        let start = Start::new(start.0, start.1);
        let motion = supervise(py, || {
            Budget::MACHINE.limit(|| Ok(scene.trajectory(start, periods)))
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
        let states: Vec<Start> = times.as_slice()?.iter().map(at).collect::<PyResult<_>>()?;
        let column = |value: fn(&Start) -> f64| states.iter().map(value).collect::<Vec<f64>>();
        Ok((
            column(|it| it.position).into_pyarray(py).unbind(),
            column(|it| it.velocity).into_pyarray(py).unbind(),
        ))
    }

    /// Times in s and before-impact velocities in m/s of all impacts.
    fn impacts(&self, py: Python<'_>) -> (Array, Array) {
        let clock = &self.motion.clock;
        let all = || self.motion.impacts();
        (
            all()
                .map(|it| clock.time(it.instant))
                .collect::<Vec<f64>>()
                .into_pyarray(py)
                .unbind(),
            all()
                .map(|it| it.before_impact_velocity)
                .collect::<Vec<f64>>()
                .into_pyarray(py)
                .unbind(),
        )
    }

    /// Times in s, positions in m, velocities in m/s before and after, and kinds of all crossings.
    fn crossings(&self, py: Python<'_>) -> (Array, Array, Array, Array, Vec<String>) {
        let clock = &self.motion.clock;
        let all = &self.motion.crossings;
        let column = |value: &dyn Fn(&softstop::Crossing) -> f64| {
            all.iter()
                .map(value)
                .collect::<Vec<f64>>()
                .into_pyarray(py)
                .unbind()
        };
        (
            column(&|it| clock.time(it.instant)),
            column(&|it| it.position),
            column(&|it| it.velocity),
            column(&|it| it.velocity_after),
            all.iter().map(|it| name(it.kind).to_owned()).collect(),
        )
    }

    /// Energies in J: supplied by the drive, dissipated, and stored at the end less at the start.
    #[getter]
    fn energies(&self) -> (f64, f64, f64) {
        let work = &self.motion.work;
        (work.supplied, work.dissipated, self.motion.stored)
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
