//! The axes of a study: which parameter takes which values.

use serde::Deserialize;
use softstop::{Dimension, Machine, Parameter, SceneError};
use softstop_console::failure::Failure;
use softstop_console::units;

use super::values::{Draw, Scale, Values, between};

/// An axis as the file states it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AxisSettings {
    /// A key of the machine's file, or a letter.
    pub parameter: String,
    pub from: Option<f64>,
    pub to: Option<f64>,
    pub count: Option<u64>,
    pub values: Option<Vec<f64>>,
    #[serde(default)]
    pub scale: Scale,
    pub sample: Option<Draw>,
}

/// What an axis changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum AxisTarget {
    Parameter(Parameter),
    Position,
    Velocity,
}

/// An axis.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StudyAxis {
    /// Its name: the key of the machine's file.
    pub name: String,
    pub target: AxisTarget,
    /// The unit of its values in the machine's own ones.
    unit: f64,
    pub values: Values,
}

impl StudyAxis {
    /// What is stated of it, of this machine.
    pub fn new(machine: &Machine, stated: &AxisSettings) -> Result<Self, Failure> {
        let key = stated.parameter.as_str();
        let wrong = |what: String| Failure::usage(format!("axis {key}: {what}"));
        let (target, unit) = match key {
            "initial.position" => (AxisTarget::Position, 1.0),
            "initial.velocity" => (AxisTarget::Velocity, 1.0),
            _ => {
                let unknown = |error| Failure::usage(format!("axis {error}"));
                let (parameter, unit) = machine.free_parameter(key).map_err(unknown)?;
                (AxisTarget::Parameter(parameter), unit)
            }
        };
        // A letter and its key are one; a key that states a value otherwise is its own.
        let name = match target {
            AxisTarget::Parameter(parameter) if unit == 1.0 => machine.name(parameter).to_owned(),
            _ => key.replace('-', "_"),
        };
        let axis = Self {
            name,
            target,
            unit,
            values: values(stated).map_err(wrong)?,
        };
        for value in axis.ends() {
            let mut machine = machine.clone();
            axis.set(&mut machine, value);
            machine
                .validate()
                .map_err(|error: SceneError| wrong(format!("{value}: {error}")))?;
        }
        Ok(axis)
    }

    /// How its values are drawn, if they are.
    pub fn draw(&self) -> Option<Draw> {
        match self.values {
            Values::Drawn { sample, .. } => Some(sample),
            _ => None,
        }
    }

    /// Its least and greatest value.
    pub fn ends(&self) -> [f64; 2] {
        let [a, b] = match &self.values {
            Values::List { values } => {
                let least = values.iter().copied().fold(f64::INFINITY, f64::min);
                [
                    least,
                    values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
                ]
            }
            Values::Grid { from, to, .. } | Values::Drawn { from, to, .. } => [*from, *to],
        };
        [a.min(b), a.max(b)]
    }

    /// Its value at a share of its range.
    pub fn drawn(&self, share: f64) -> f64 {
        match self.values {
            Values::Drawn {
                from, to, scale, ..
            } => between(from, to, share, scale),
            _ => f64::NAN,
        }
    }

    /// Gives the machine a value of it.
    pub fn set(&self, machine: &mut Machine, value: f64) {
        match self.target {
            AxisTarget::Parameter(parameter) => machine.set(parameter, value * self.unit),
            AxisTarget::Position => machine.start.position = value,
            AxisTarget::Velocity => machine.start.velocity = value,
        }
    }

    /// Its unit by name, and what it is, as an axis of a picture has it.
    pub fn told(&self, machine: &Machine) -> (&'static str, String) {
        let of_state = |what, symbol, dimension| {
            let label = machine.label(what, symbol, dimension);
            (units::name(machine, dimension), label)
        };
        match self.target {
            AxisTarget::Parameter(parameter) if self.unit == 1.0 => {
                let unit = units::of_parameter(machine, parameter);
                (unit, machine.label_of(parameter))
            }
            AxisTarget::Parameter(_) => {
                let unit = if self.unit > 1.0 { "Hz" } else { "rad/s" };
                (unit, format!("drive frequency ({unit})"))
            }
            AxisTarget::Position => of_state("initial position", "X", Dimension::Length),
            AxisTarget::Velocity => of_state("initial velocity", "X′", Dimension::Velocity),
        }
    }
}

/// The values that are stated, or what is wrong with them.
fn values(stated: &AxisSettings) -> Result<Values, String> {
    let (scale, range) = (stated.scale, stated.from.zip(stated.to));
    let is_list = scale == Scale::Linear && stated.from.or(stated.to).is_none();
    let listed = stated.values.clone();
    let values = match (listed, range, stated.count, stated.sample) {
        (Some(values), None, None, None) if is_list => Values::List { values },
        (None, Some((from, to)), Some(count), None) => Values::Grid {
            from,
            to,
            count,
            scale,
        },
        (None, Some((from, to)), None, Some(sample)) => Values::Drawn {
            from,
            to,
            scale,
            sample,
        },
        _ => {
            return Err(
                "must have from, to and count (a grid), from, to and sample = \"random\" or \
                        \"sobol\", or values alone"
                    .to_owned(),
            );
        }
    };
    match &values {
        Values::List { values } if values.is_empty() => Err("values = []: must have one".into()),
        Values::List { values } if values.iter().any(|value| !value.is_finite()) => {
            Err("values: must be finite".into())
        }
        Values::Grid { count: 0, .. } => Err("count = 0: must be >= 1".into()),
        Values::Grid { from, to, .. } | Values::Drawn { from, to, .. } => {
            let must = match scale {
                _ if !(from.is_finite() && to.is_finite()) => "finite",
                Scale::Log if *from <= 0.0 || *to <= 0.0 => "> 0 on a log scale",
                _ => return Ok(values),
            };
            Err(format!("from {from} to {to}: must be {must}"))
        }
        Values::List { .. } => Ok(values),
    }
}
