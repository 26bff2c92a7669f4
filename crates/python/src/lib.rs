//! The module `_softstop` of the Python package: machines, the commands, batches in the lanes, and exact motions.
//!
//! Python runs the commands of the program in its own process (`command`): each returns the report that the program
//! prints, so no number has a second source. What is an array in Python goes to the lanes (`batch`).

mod arrow;
mod batch;
mod command;
mod errors;
mod exponents;
mod figures;
mod machine;
mod rows;
mod supervise;
mod trajectory;

/// What the package's Python files call.
#[pyo3::pymodule]
mod _softstop {
    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "Python's name")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
    #[pymodule_export]
    use super::arrow::stream;
    #[pymodule_export]
    use super::batch::{Batch, follow};
    #[pymodule_export]
    use super::command::{json_to_toml, main, run, toml_to_json};
    #[pymodule_export]
    use super::errors::{MachineError, SoftstopError};
    #[pymodule_export]
    use super::exponents::exponents;
    #[pymodule_export]
    use super::figures::figures;
    #[pymodule_export]
    use super::machine::Machine;
    #[pymodule_export]
    use super::trajectory::Trajectory;

    use pyo3::prelude::*;

    /// A machine's error has a key, also where Python raises it.
    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        let py = module.py();
        py.get_type::<MachineError>().setattr("key", py.None())
    }
}
