//! Many motions at once, in the lanes.

use std::ops::{ControlFlow, Range};

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use rayon::prelude::*;
use softstop::{Machine as Stated, SceneError, Start};
use softstop_console::interrupt;
use softstop_lanes::{Instructions, Job, Machine as Lowered, Outcome, Watch, run_parallel};

use crate::errors::{MachineError, of_machine, of_scene};
use crate::machine::Machine;
use crate::supervise::supervise;

/// What came of a batch, a value for each motion, and the impacts that were kept.
#[pyclass(frozen, get_all, module = "softstop._softstop")]
pub struct Batch {
    /// Position at the end.
    position: Py<PyArray1<f64>>,
    /// Velocity at the end.
    velocity: Py<PyArray1<f64>>,
    /// Impacts on the way.
    counts: Py<PyArray1<u64>>,
    /// Impacts of motion i are those from offsets[i] to offsets[i + 1].
    offsets: Py<PyArray1<i64>>,
    /// Time of each impact in s.
    times: Py<PyArray1<f64>>,
    /// Before-impact velocity of each impact in m/s.
    velocities: Py<PyArray1<f64>>,
    /// Motions that could not be followed to the end, and why.
    errors: Vec<(usize, String)>,
}

/// Motion, time in the drive period in s, before-impact velocity in m/s, number of the drive period.
type Impact = (usize, f64, f64, u64);

/// Impacts of a range of jobs.
struct Impacts {
    /// First drive period whose impacts are kept.
    from: u64,
    kept: Vec<Impact>,
}

impl Watch for Impacts {
    const IMPACTS: bool = true;

    fn impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64) {
        if cycle >= self.from {
            self.kept.push((job, offset, velocity, cycle));
        }
    }

    fn goes_on(&mut self) -> ControlFlow<()> {
        interrupt::go_on()
    }
}

/// Nothing is kept.
struct Ends;

impl Watch for Ends {
    fn goes_on(&mut self) -> ControlFlow<()> {
        interrupt::go_on()
    }
}

/// follow(machine, changes, start, periods, keep)
/// --
///
/// Follows one motion for each row of the arrays over whole drive periods, on all processors.
///
/// `changes` are keys of the machine and their values; `keep` is how many of the last periods have their impacts kept.
#[pyfunction]
pub fn follow(
    py: Python<'_>,
    machine: &Machine,
    changes: Vec<(String, PyReadonlyArray1<'_, f64>)>,
    start: (PyReadonlyArray1<'_, f64>, PyReadonlyArray1<'_, f64>),
    periods: u64,
    keep: u64,
) -> PyResult<Batch> {
    let stated = &machine.stated;
    let (x, v) = (start.0.as_slice()?, start.1.as_slice()?);
    let mut columns = Vec::new();
    for (key, values) in &changes {
        let (parameter, factor) = stated.stated(key).map_err(|error| of_machine(&error))?;
        columns.push((parameter, factor, values.as_slice()?));
    }
    if columns.iter().any(|(.., values)| values.len() != x.len()) || v.len() != x.len() {
        return Err(MachineError::new_err("arrays of different lengths"));
    }
    let lowered = |row: usize| {
        let mut own: Stated = stated.clone();
        for (parameter, factor, values) in &columns {
            own.set(*parameter, values[row] * factor);
        }
        own.validate()?;
        Ok::<_, SceneError>((Lowered::new(&own.scene)?, own.scene.period()))
    };
    let rows = if columns.is_empty() {
        x.len().min(1)
    } else {
        x.len()
    };
    let followed = supervise(py, || {
        let machines: Result<(Vec<Lowered>, Vec<f64>), _> =
            (0..rows).into_par_iter().map(lowered).collect();
        machines.map(|(machines, lengths)| (run(&machines, (x, v), periods, keep), lengths))
    })?;
    let ((outcomes, mut kept), lengths) = followed.map_err(|error| of_scene(&error))?;
    let ends = |value: fn(&Start) -> f64| {
        outcomes
            .iter()
            .map(|it| value(&it.end))
            .collect::<Vec<f64>>()
    };
    kept.sort_by_key(|(job, ..)| *job);
    let mut offsets = vec![0_i64; outcomes.len() + 1];
    for (job, ..) in &kept {
        offsets[job + 1] += 1;
    }
    for row in 0..outcomes.len() {
        offsets[row + 1] += offsets[row];
    }
    let time = |(job, offset, _, cycle): &Impact| {
        *cycle as f64 * lengths[(*job).min(lengths.len() - 1)] + offset
    };
    let errors = outcomes.iter().enumerate();
    let errors = errors.filter_map(|(row, it)| Some((row, it.error.as_ref()?.to_string())));
    Ok(Batch {
        position: ends(|it| it.position).into_pyarray(py).unbind(),
        velocity: ends(|it| it.velocity).into_pyarray(py).unbind(),
        counts: outcomes
            .iter()
            .map(|it| it.impacts)
            .collect::<Vec<u64>>()
            .into_pyarray(py)
            .unbind(),
        offsets: offsets.into_pyarray(py).unbind(),
        times: kept
            .iter()
            .map(time)
            .collect::<Vec<f64>>()
            .into_pyarray(py)
            .unbind(),
        velocities: kept
            .iter()
            .map(|it| it.2)
            .collect::<Vec<f64>>()
            .into_pyarray(py)
            .unbind(),
        errors: errors.collect(),
    })
}

fn run(
    machines: &[Lowered],
    (x, v): (&[f64], &[f64]),
    periods: u64,
    keep: u64,
) -> (Vec<Outcome>, Vec<Impact>) {
    let jobs = x.iter().zip(v).enumerate().map(|(row, (x, v))| Job {
        machine: row.min(machines.len().saturating_sub(1)),
        start: Start::new(*x, *v),
        periods,
    });
    let jobs: Vec<Job> = jobs.collect();
    let from = periods.saturating_sub(keep);
    match keep {
        0 => (
            run_parallel(Instructions::Widest, machines, &jobs, |_| Ends).0,
            Vec::new(),
        ),
        _ => {
            let impacts = |_: Range<usize>| Impacts {
                from,
                kept: Vec::new(),
            };
            let (outcomes, kept) = run_parallel(Instructions::Widest, machines, &jobs, impacts);
            (outcomes, kept.into_iter().flat_map(|it| it.kept).collect())
        }
    }
}
