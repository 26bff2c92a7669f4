//! Lyapunov exponents of many motions.

use numpy::PyArray1;
use pyo3::prelude::*;
use rayon::prelude::*;
use softstop_console::failure::{Failure, check_interrupt};
use softstop_console::progress::Progress;
use softstop_dynamics::LyapunovExponents;

use crate::batch::Ends;
use crate::machine::Machine;
use crate::rows::{Array, Changes, Rows, States};
use crate::supervise::{Teller, supervise_in_pool};

/// Larger and smaller exponents per drive period, half-widths of the 95 % intervals of the larger ones, 1 where they are
/// positive beyond doubt, drive periods in s; and why motions could not be followed.
type Columns = ([Array; 5], Vec<(usize, String)>);

/// exponents(machine, changes, start, transient, batch, progress)
/// --
///
/// The exponents of the motion of each row over 32 batches of drive periods, after a transient.
#[pyfunction]
pub fn exponents<'py>(
    py: Python<'py>,
    machine: &Machine,
    changes: Changes<'py>,
    start: States<'py>,
    transient: u64,
    batch: u64,
    progress: Teller<'py>,
) -> PyResult<Columns> {
    let rows = Rows::new(machine, &changes, &start)?;
    let found = supervise_in_pool(py, &progress, || -> PyResult<_> {
        let (settled, _) = rows.follow(transient, |_| Ends)?;
        let progress = Progress::new(rows.len() as u64, "exponents");
        let along = |row: usize| {
            if let Some(error) = &settled[row].error {
                return Err(Failure::Run(error.clone().into()));
            }
            let (scene, state) = (rows.scene(row), settled[row].end.into());
            let found =
                LyapunovExponents::along_motion_with_monitor(&scene, state, batch, check_interrupt);
            progress.more(1);
            Ok(found?.0)
        };
        let found: Vec<Result<LyapunovExponents, Failure>> =
            (0..rows.len()).into_par_iter().map(along).collect();
        Ok(found)
    })??;
    let column = |value: &dyn Fn(&LyapunovExponents) -> f64| {
        let value = |it: &Result<_, _>| it.as_ref().map_or(f64::NAN, value);
        PyArray1::from_iter(py, found.iter().map(value)).unbind()
    };
    let errors = found.iter().enumerate();
    let errors = errors.filter_map(|(row, it)| match it.as_ref().err()? {
        Failure::Run(error) => Some((row, format!("{error:#}"))),
        failure => Some((row, failure.to_string())),
    });
    Ok((
        [
            column(&|it| it.per_period[0]),
            column(&|it| it.per_period[1]),
            column(&|it| it.error),
            column(&|it| f64::from(u8::from(it.is_positive()))),
            column(&|it| it.period),
        ],
        errors.collect(),
    ))
}
