//! Many machines and starts from arrays, row by row.

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use rayon::prelude::*;
use softstop::{Machine as Stated, Parameter, Scene, SceneError, Start};
use softstop_lanes::{Job, LoweredMachine};

use crate::errors::{MachineError, of_machine};
use crate::machine::Machine;

/// Numbers as Python has them.
pub type Array = Py<PyArray1<f64>>;
/// Keys of a machine and their values.
pub type Changes<'py> = Vec<(String, PyReadonlyArray1<'py, f64>)>;
/// Positions in m and velocities in m/s.
pub type States<'py> = (PyReadonlyArray1<'py, f64>, PyReadonlyArray1<'py, f64>);

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
    /// `MachineError` for an unknown key, or arrays of different lengths.
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

    /// The scene of a row, once all are [lowered](Self::lowered).
    pub fn scene(&self, row: usize) -> Scene {
        self.machine(row).scene
    }

    /// The machines ready for the lanes; one for all rows where nothing is changed.
    ///
    /// # Errors
    /// [`SceneError`] of one that cannot be, in its own units.
    pub fn lowered(&self) -> Result<Vec<LoweredMachine>, SceneError> {
        let machines = match self.columns.is_empty() {
            true => self.len().min(1),
            false => self.len(),
        };
        let lowered = |row| Ok(LoweredMachine::new(&self.machine(row).check(None)?));
        (0..machines).into_par_iter().map(lowered).collect()
    }

    /// A job for each row.
    pub fn jobs(&self, periods: u64) -> Vec<Job> {
        let states = self.x.iter().zip(self.v).enumerate();
        let job = |(row, (x, v)): (usize, (&f64, &f64))| Job {
            machine: if self.columns.is_empty() { 0 } else { row },
            start: Start::new(*x, *v),
            periods,
        };
        states.map(job).collect()
    }
}
