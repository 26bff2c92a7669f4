//! Many machines and starts from arrays, row by row.

use std::ops::Range;

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use rayon::prelude::*;
use softstop::{CheckedScene, Machine as Stated, MotionError, Parameter, Scene, Start};
use softstop_console::failure::check_interrupt;
use softstop_console::progress::Progress;
use softstop_lanes::{BatchObserver, Job, LoweredMachine, Outcome, run_parallel};

use crate::errors::{MachineError, of_failure, of_machine, of_motion, of_scene};
use crate::machine::Machine;

/// Numbers as Python has them.
pub type Array = Py<PyArray1<f64>>;
/// Keys of a machine and their values.
pub type Changes<'py> = Vec<(String, PyReadonlyArray1<'py, f64>)>;
/// Positions in m and velocities in m/s.
pub type States<'py> = (PyReadonlyArray1<'py, f64>, PyReadonlyArray1<'py, f64>);

/// Rows whose machines are in memory at once, some 7 kB each: whole batches of the lanes, enough for many threads.
const BLOCK: usize = 1 << 15;

/// A machine and a start for each row.
pub struct Rows<'a> {
    stated: &'a Stated,
    columns: Vec<(Parameter, f64, &'a [f64])>,
    x: &'a [f64],
    v: &'a [f64],
}

impl<'a> Rows<'a> {
    /// Rows of arrays of one length.
    ///
    /// # Errors
    /// `MachineError` for an unknown key, arrays of different lengths, or a start that is not finite.
    pub fn new(
        machine: &'a Machine,
        changes: &'a Changes<'_>,
        start: &'a States<'_>,
    ) -> PyResult<Self> {
        let stated = &machine.stated;
        let (x, v) = (start.0.as_slice()?, start.1.as_slice()?);
        let mut columns: Vec<(Parameter, f64, &[f64])> = Vec::new();
        for (key, values) in changes {
            let (parameter, factor) = stated
                .free_parameter(key)
                .map_err(|error| of_machine(&error))?;
            if columns.iter().any(|(known, ..)| *known == parameter) {
                return Err(MachineError::new_err(format!("{key}: is set twice")));
            }
            columns.push((parameter, factor, values.as_slice()?));
        }
        if columns.iter().any(|(.., values)| values.len() != x.len()) || v.len() != x.len() {
            return Err(MachineError::new_err("arrays of different lengths"));
        }
        for (name, values) in [("position", x), ("velocity", v)] {
            if let Some(&value) = values.iter().find(|it| !it.is_finite()) {
                return Err(of_motion(&MotionError::NotFinite { name, value }));
            }
        }
        Ok(Self {
            stated,
            columns,
            x,
            v,
        })
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// The machine of a row, which may be one that cannot be.
    fn machine(&self, row: usize) -> Stated {
        let mut own = self.stated.clone();
        for (parameter, factor, values) in &self.columns {
            own.set(*parameter, values[row] * factor);
        }
        own
    }

    /// The scene of a row, once all are [followed](Self::follow).
    pub fn scene(&self, row: usize) -> Scene {
        self.machine(row).scene
    }

    /// Follows the motion of each row over whole drive periods, block by block once all machines are checked, each batch of the
    /// lanes with an observer that `watch` makes for rows counted from this one on.
    ///
    /// # Errors
    /// `MachineError` of a machine that cannot be, in its own units; `KeyboardInterrupt` after Ctrl-C.
    pub fn follow<W: BatchObserver + Send>(
        &self,
        periods: u64,
        watch: impl Fn(usize) -> W + Sync,
    ) -> PyResult<(Vec<Outcome>, Vec<W>)> {
        if self.len() > BLOCK {
            let all = self.machines_of(0..self.len());
            all.try_for_each(|row| self.checked(row).map(drop))?;
        }
        let progress = Progress::new(self.len() as u64, "motions");
        let (mut outcomes, mut watches) = (Vec::new(), Vec::new());
        for first in (0..self.len()).step_by(BLOCK) {
            let block = first..self.len().min(first + BLOCK);
            let machines = self.lowered(block.clone())?;
            let job = |row: usize| Job {
                machine: (row - first).min(machines.len() - 1),
                start: Start::new(self.x[row], self.v[row]),
                periods,
            };
            let jobs: Vec<Job> = block.map(job).collect();
            let watch = |part: Range<usize>| {
                progress.more(part.len() as u64);
                watch(first)
            };
            let done = run_parallel(&machines, &jobs, watch);
            outcomes.extend(done.0);
            watches.extend(done.1);
            check_interrupt().map_err(of_failure)?;
        }
        Ok((outcomes, watches))
    }

    /// The machines of a block ready for the lanes; one for all rows where nothing is changed.
    fn lowered(&self, block: Range<usize>) -> PyResult<Vec<LoweredMachine>> {
        let machines = self.machines_of(block).map(|row| self.checked(row));
        machines.map(|it| Ok(LoweredMachine::new(&it?))).collect()
    }

    /// The rows of a block whose machines differ.
    fn machines_of(&self, block: Range<usize>) -> rayon::range::Iter<usize> {
        match self.columns.is_empty() {
            true => (block.start..block.start + 1).into_par_iter(),
            false => block.into_par_iter(),
        }
    }

    fn checked(&self, row: usize) -> PyResult<CheckedScene> {
        check_interrupt().map_err(of_failure)?;
        let checked = self.machine(row).check(None);
        checked.map_err(|error| of_scene(&error))
    }
}
