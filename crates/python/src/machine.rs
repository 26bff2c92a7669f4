//! A machine as Python has it.

use pyo3::prelude::*;
use softstop::{Dimension, Machine as Stated};
use softstop_console::failure::Failure;
use softstop_console::names::file_stem;
use softstop_optimize::fmu::{Standard, archive, library};
use softstop_optimize::page::figures::sketch;

use crate::command::json_to_toml;
use crate::errors::{MachineError, of_failure, of_machine};

/// A machine that cannot change.
#[pyclass(frozen, eq, module = "softstop._softstop")]
#[derive(Debug, Clone, PartialEq)]
pub struct Machine {
    pub(crate) stated: Stated,
}

#[pymethods]
impl Machine {
    /// The machine of a file's text, in TOML, called as the file if it has no name.
    #[staticmethod]
    fn from_toml(text: &str, stem: Option<&str>) -> PyResult<Self> {
        let mut stated = Stated::from_toml(text).map_err(|error| of_machine(&error))?;
        stated.name = stated.name.or_else(|| stem.map(file_stem));
        Ok(Self { stated })
    }

    /// The machine of a file's content as JSON.
    #[staticmethod]
    fn from_json(text: &str) -> PyResult<Self> {
        Self::from_toml(&json_to_toml(text)?, None)
    }

    /// The paper's `unloaded` or `loaded` machine.
    #[staticmethod]
    fn named(name: &str) -> PyResult<Self> {
        let stated = Stated::named(name);
        let stated = stated
            .ok_or_else(|| MachineError::new_err(format!("{name}: no machine is called so")))?;
        Ok(Self { stated })
    }

    /// Another machine, with keys of its file set to values, both as in the file.
    fn replaced(&self, changes: Vec<(String, String)>) -> PyResult<Self> {
        let mut stated = self.stated.clone();
        let changes = changes
            .iter()
            .map(|(key, value)| (key.as_str(), value.as_str()));
        stated.apply(changes).map_err(|error| of_machine(&error))?;
        Ok(Self { stated })
    }

    /// The text of its file.
    fn to_toml(&self) -> String {
        self.stated.to_toml()
    }

    /// The bytes of its FMU, which starts in its initial state.
    fn fmu(&self) -> PyResult<Vec<u8>> {
        let library = library(Standard::Fmi2).map_err(|error| of_failure(error.into()))?;
        let bytes = archive(&library, &self.stated, self.stated.start);
        bytes.map_err(|error| of_failure(Failure::usage(format!("{error:#}"))))
    }

    /// An SVG of it with its dimensions.
    fn sketch(&self) -> String {
        let mut figure = sketch(&self.stated);
        // It speaks of a design.
        figure.caption.clear();
        figure.document(self.stated.name.as_deref().unwrap_or_default())
    }

    /// The numbers that it has: key, value, unit, meaning.
    fn parameters(&self) -> Vec<(&'static str, f64, &'static str, &'static str)> {
        let machine = &self.stated;
        let each = machine.parameters().filter_map(|parameter| {
            let (meaning, _) = machine.meaning_of(parameter);
            let value = machine.value(parameter)?;
            Some((
                machine.name(parameter),
                value,
                machine.unit_of(parameter),
                meaning,
            ))
        });
        each.collect()
    }

    /// The number of a key, letter or older name, in the unit of that key.
    fn value(&self, name: &str) -> PyResult<f64> {
        let stated = self.stated.stated(name);
        let (parameter, factor) = stated.map_err(|error| of_machine(&error))?;
        Ok(self.stated.value(parameter).unwrap_or(f64::NAN) / factor)
    }

    /// What an axis says of a quantity of motion or of a key: what it is, with its unit or symbol; the key itself
    /// if it is in another unit than the machine's own.
    fn label(&self, what: &str) -> PyResult<String> {
        let dimension = match what {
            "time" => Dimension::Time,
            "position" => Dimension::Length,
            "velocity" | "before-impact velocity" => Dimension::Velocity,
            key => {
                let stated = self.stated.stated(key);
                let (parameter, factor) = stated.map_err(|error| of_machine(&error))?;
                let is_own = factor == 1.0;
                return Ok(if is_own {
                    self.stated.label_of(parameter)
                } else {
                    key.to_owned()
                });
            }
        };
        Ok(self.stated.label(what, "", dimension))
    }

    /// Its name, if it has one.
    #[getter]
    fn name(&self) -> Option<String> {
        self.stated.name.clone()
    }

    /// State at time 0: position in m and velocity in m/s.
    #[getter]
    fn start(&self) -> (f64, f64) {
        (self.stated.start.position, self.stated.start.velocity)
    }

    /// The drive period in s.
    #[getter]
    fn period(&self) -> f64 {
        self.stated.scene.period()
    }
}
