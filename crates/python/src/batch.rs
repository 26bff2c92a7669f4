//! Many motions at once, in the lanes.

use std::ops::ControlFlow;

use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use rayon::prelude::*;
use softstop::Start;
use softstop_console::interrupt;
use softstop_lanes::{BatchObserver, Outcome};

use crate::machine::Machine;
use crate::rows::{Array, Changes, Rows, States};
use crate::supervise::{Teller, supervise_in_pool};

/// What came of a batch, a value for each motion, and the impacts that were kept.
#[pyclass(frozen, get_all, module = "softstop._softstop")]
pub struct Batch {
    /// Position at the end.
    position: Array,
    /// Velocity at the end.
    velocity: Array,
    /// Impacts on the way.
    counts: Py<PyArray1<u64>>,
    /// Impacts of motion i are those from offsets[i] to offsets[i + 1].
    offsets: Py<PyArray1<i64>>,
    /// Time of each impact in s.
    times: Array,
    /// Before-impact velocity of each impact in m/s.
    velocities: Array,
    /// Motions that could not be followed to the end, and why.
    errors: Vec<(usize, String)>,
}

/// Motion, time in the drive period in s, before-impact velocity in m/s, number of the drive period.
type Impact = (usize, f64, f64, u64);

/// Impacts of a batch.
struct Impacts {
    /// The row of job 0.
    first: usize,
    /// First drive period whose impacts are kept.
    from: u64,
    kept: Vec<Impact>,
}

impl BatchObserver for Impacts {
    fn observed(&self) -> (bool, bool) {
        (true, false)
    }

    fn impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64) {
        if cycle >= self.from {
            self.kept.push((self.first + job, offset, velocity, cycle));
        }
    }

    fn goes_on(&mut self) -> ControlFlow<()> {
        interrupt::go_on()
    }
}

/// Nothing is kept: motions that settle are leapt over.
pub struct Ends;

impl BatchObserver for Ends {
    fn goes_on(&mut self) -> ControlFlow<()> {
        interrupt::go_on()
    }
}

/// follow(machine, changes, start, periods, keep, progress)
/// --
///
/// Follows one motion for each row of the arrays over whole drive periods, on all processors.
///
/// `changes` are keys of the machine and their values; `keep` is how many of the last periods have their impacts kept.
#[pyfunction]
pub fn follow<'py>(
    py: Python<'py>,
    machine: &Machine,
    changes: Changes<'py>,
    start: States<'py>,
    periods: u64,
    keep: u64,
    progress: Teller<'py>,
) -> PyResult<Batch> {
    let rows = Rows::new(machine, &changes, &start)?;
    let (outcomes, kept, times) = supervise_in_pool(py, &progress, || -> PyResult<_> {
        let (outcomes, kept) = match keep {
            0 => (rows.follow(periods, |_| Ends)?.0, Vec::new()),
            _ => impacts(&rows, periods, periods.saturating_sub(keep))?,
        };
        let of_motion = |impacts: &[Impact]| {
            let period = rows.scene(impacts[0].0).period();
            let time = |it: &Impact| it.3 as f64 * period + it.1;
            impacts.iter().map(time).collect::<Vec<f64>>()
        };
        let times = kept
            .par_chunk_by(|a, b| a.0 == b.0)
            .flat_map_iter(of_motion);
        let times: Vec<f64> = times.collect();
        Ok((outcomes, kept, times))
    })??;
    let mut offsets = vec![0_i64; outcomes.len() + 1];
    for (job, ..) in &kept {
        offsets[job + 1] += 1;
    }
    for row in 0..outcomes.len() {
        offsets[row + 1] += offsets[row];
    }
    let column = |value: fn(&Start) -> f64| {
        PyArray1::from_iter(py, outcomes.iter().map(|it| value(&it.end))).unbind()
    };
    let errors = outcomes.iter().enumerate();
    let errors = errors.filter_map(|(row, it)| Some((row, it.error.as_ref()?.to_string())));
    Ok(Batch {
        position: column(|it| it.position),
        velocity: column(|it| it.velocity),
        counts: PyArray1::from_iter(py, outcomes.iter().map(|it| it.impacts)).unbind(),
        offsets: offsets.into_pyarray(py).unbind(),
        times: times.into_pyarray(py).unbind(),
        velocities: PyArray1::from_iter(py, kept.iter().map(|it| it.2)).unbind(),
        errors: errors.collect(),
    })
}

/// What motions come to, and their impacts from a drive period on, motion after motion.
fn impacts(rows: &Rows<'_>, periods: u64, from: u64) -> PyResult<(Vec<Outcome>, Vec<Impact>)> {
    let (outcomes, watches) = rows.follow(periods, |first| Impacts {
        first,
        from,
        kept: Vec::new(),
    })?;
    let mut kept: Vec<Impact> = watches.into_iter().flat_map(|it| it.kept).collect();
    kept.sort_by_key(|(job, ..)| *job);
    Ok((outcomes, kept))
}
