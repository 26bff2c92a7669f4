//! The commands of the program.

use clap::Parser;
use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use softstop_console::export::{Array, Returned, returned};
use softstop_console::failure::Failure;
use softstop_optimize::CommandLine;

use crate::errors::{MachineError, of_failure};
use crate::supervise::{Teller, supervise};

/// run(arguments, progress)
/// --
///
/// Runs a command and returns what it would print: text for people, and JSON; and arrays. Files are written as it says.
///
/// Raises
/// ------
/// MachineError
///     If arguments, machine or task cannot be.
/// SoftstopError
///     If there is no result.
#[pyfunction]
pub fn run<'py>(
    py: Python<'py>,
    arguments: Vec<String>,
    progress: Teller<'py>,
) -> PyResult<(String, String, Bound<'py, PyDict>)> {
    let Returned { text, json, arrays } = supervise(py, &progress, || {
        let words = ["softstop".to_owned()].into_iter().chain(arguments);
        let line = CommandLine::try_parse_from(words);
        let line = line.map_err(|error| Failure::usage(told(&error)))?;
        returned(|| softstop_optimize::run(line.command))
    })?
    .map_err(of_failure)?;
    let named = PyDict::new(py);
    for (name, array) in arrays {
        match array {
            Array::Numbers(numbers) => named.set_item(name, numbers.into_pyarray(py))?,
            Array::Indices(indices) => named.set_item(name, indices.into_pyarray(py))?,
        }
    }
    Ok((text, json, named))
}

/// What is wrong with arguments, without the advice to look at `--help`.
fn told(error: &clap::Error) -> String {
    let words = error.render().to_string();
    let first = words.split("\n\n").next().unwrap_or_default();
    first.trim_start_matches("error: ").to_owned()
}

/// main(arguments: list[str]) -> int
/// --
///
/// The program `softstop` itself, its name first in the arguments: prints, and returns the exit code.
#[pyfunction]
pub fn main(py: Python<'_>, arguments: Vec<String>) -> u8 {
    py.detach(|| softstop_optimize::main_of(arguments.into_iter().map(Into::into).collect()))
}

/// json_to_toml(text: str) -> str
/// --
///
/// The TOML of a JSON object.
#[pyfunction]
pub fn json_to_toml(text: &str) -> PyResult<String> {
    let table: toml::Table = serde_json::from_str(text).map_err(no_table)?;
    Ok(table.to_string())
}

/// toml_to_json(text: str) -> str
/// --
///
/// The JSON of a TOML file.
#[pyfunction]
pub fn toml_to_json(text: &str) -> PyResult<String> {
    let table: toml::Table = toml::from_str(text).map_err(no_table)?;
    serde_json::to_string(&table).map_err(no_table)
}

fn no_table(error: impl std::fmt::Display) -> PyErr {
    MachineError::new_err(error.to_string())
}
