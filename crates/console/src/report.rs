//! What several commands report: plain data whose field names are the keys of the JSON.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::{Map, Value};
use softstop::{Dimension, Language, Machine, Parameter, Ratios, Stop};
use softstop_dynamics::motion::MotionKind;
use softstop_dynamics::orbit::{self, Orbit};

use crate::machine::Regime;
use crate::table::{Row, number, row};
use crate::units;

/// A Floquet multiplier.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Multiplier {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
    /// Absolute value; below 1 for both if the motion is stable.
    pub modulus: f64,
}

impl Multiplier {
    /// This complex number.
    #[must_use]
    pub fn new(multiplier: nalgebra::Complex<f64>) -> Self {
        Self {
            re: multiplier.re,
            im: multiplier.im,
            modulus: multiplier.norm(),
        }
    }
}

/// A machine as its user states it, whatever the command.
#[derive(Debug, Clone, Serialize)]
pub struct MachineReport {
    /// Its name, if it has one.
    pub name: Option<String>,
    /// `si`, `hertz` (SI with the drive's frequency in Hz) or `ratios`.
    pub language: &'static str,
    /// Its units, by what they measure.
    pub units: BTreeMap<&'static str, &'static str>,
    /// All that it has, in its own units, by the dotted keys of its file, as `--set` takes them.
    pub parameters: Map<String, Value>,
}

impl MachineReport {
    /// This machine.
    #[must_use]
    pub fn of(machine: &Machine) -> Self {
        let number = |it| Some((machine.name(it).to_owned(), machine.value(it)?.into()));
        let numbers = machine.parameters().filter_map(number);
        Self {
            name: machine.name.clone(),
            language: match machine.speaks {
                Language::Si => "si",
                Language::Hertz => "hertz",
                Language::Ratios => "ratios",
            },
            units: units::names(machine),
            parameters: law(&machine.scene.stop).chain(numbers).collect(),
        }
    }
}

/// What makes out a stop's law besides numbers: its model, its release, its slopes.
fn law(stop: &Stop) -> impl Iterator<Item = (String, Value)> + use<> {
    let law = serde_json::to_value(stop).unwrap_or_default();
    let fields = law.as_object().cloned().unwrap_or_default().into_iter();
    fields
        .filter(|(_, value)| !value.is_number())
        .map(|(key, value)| (format!("stop.{key}"), value))
}

/// A machine where its keys were promised: one like the paper's by the names of the paper's ratios, too.
#[derive(Debug, Clone, Serialize)]
pub struct Stated {
    /// Regime and ratios of a machine like the paper's, but for its frequency; empty for any other.
    #[serde(flatten)]
    pub ratios: Map<String, Value>,
    /// The machine.
    pub machine: MachineReport,
}

impl Stated {
    /// This machine.
    #[must_use]
    pub fn of(machine: &Machine) -> Self {
        let ratios = machine.ratios().filter(|ratios| ratios.rigid.is_none());
        Self {
            ratios: ratios.map_or_else(Map::new, |ratios| flat(machine, &ratios)),
            machine: MachineReport::of(machine),
        }
    }
}

fn flat(machine: &Machine, ratios: &Ratios) -> Map<String, Value> {
    let regime = ratios.piercing.map_or(Regime::Unloaded, |_| Regime::Loaded);
    let named = |it| Some((ratio(it)?.to_owned(), machine.value(it)?.into()));
    let named = machine.parameters().filter_map(named);
    let others = [
        ("regime".to_owned(), regime.name().into()),
        ("preload".to_owned(), ratios.preload.into()),
    ];
    named.chain(others).collect()
}

/// What the paper's ratio of a parameter is called in JSON; none of those that have no ratio.
const fn ratio(parameter: Parameter) -> Option<&'static str> {
    Some(match parameter {
        Parameter::Clearance => "clearance",
        Parameter::StopStiffness => "stiffness",
        Parameter::Damping => "damping",
        Parameter::ContactDamping => "contact_damping",
        Parameter::PiercingStiffness => "piercing_stiffness",
        Parameter::PiercingFriction => "piercing_friction",
        Parameter::Thickness => "thickness",
        Parameter::Travel => "travel",
        _ => return None,
    })
}

/// What a motion settles on, by the same names in all reports.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct MotionName {
    /// `periodic`, `chatter`, `rest`, `chaos`, `transient_chaos`, `unsettled` or `lost`.
    pub kind: &'static str,
    /// p/n of a motion that repeats, `1` for 1/1; `∞/n` for complete chatter.
    pub z: Option<String>,
    /// Its impacts in each of its drive periods, where they are known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub order: Option<String>,
    /// As people read it.
    #[serde(skip)]
    pub text: String,
}

impl MotionName {
    /// That of a motion.
    #[must_use]
    pub fn of(motion: &MotionKind) -> Self {
        Self {
            kind: motion.key(),
            z: motion.z(),
            order: motion.order().map(ToString::to_string),
            text: motion.to_string(),
        }
    }

    /// That of a regime whose order is not known; without one the motion has not settled.
    #[must_use]
    pub fn of_regime(regime: Option<orbit::Regime>) -> Self {
        Self {
            kind: regime.map_or(MotionKind::Unsettled.key(), |_| "periodic"),
            z: regime.map(|regime| regime.to_string()),
            order: None,
            text: regime.map_or("unsettled".to_owned(), |regime| format!("z = {regime}")),
        }
    }

    /// In a word: z, or the kind of what does not repeat.
    #[must_use]
    pub fn word(&self) -> &str {
        self.z.as_deref().unwrap_or(self.kind)
    }
}

/// A motion, in the units of its machine.
#[derive(Debug, Clone, Serialize)]
pub struct MotionReport {
    /// eta.
    pub frequency: f64,
    /// X at drive angle 0.
    pub position: f64,
    /// X' at drive angle 0.
    pub velocity: f64,
    /// X' when the mass reaches the clearance.
    pub before_impact_velocity: f64,
    /// X_m.
    pub max_position: f64,
    /// Trace of the monodromy matrix.
    pub trace: f64,
    /// Its determinant.
    pub determinant: f64,
    /// Its eigenvalues.
    pub multipliers: [Multiplier; 2],
}

impl MotionReport {
    /// The motion of this machine.
    #[must_use]
    pub fn of(machine: &Machine, orbit: &Orbit) -> Self {
        Self {
            frequency: machine.value(Parameter::Frequency).unwrap_or(f64::NAN),
            position: orbit.position,
            velocity: orbit.velocity,
            before_impact_velocity: orbit.before_impact_velocity(),
            max_position: orbit.max_position,
            trace: orbit.trace(),
            determinant: orbit.determinant(),
            multipliers: orbit.multipliers().map(Multiplier::new),
        }
    }
}

/// The machine as rows of a table.
#[must_use]
pub fn machine(machine: &Machine) -> Vec<Row> {
    let name = row("machine", [machine.name.clone().unwrap_or_default()]);
    let stop = row("stop", [machine.scene.stop.model().to_owned()]);
    let values = machine.parameters().map(|parameter| {
        let value = machine.value(parameter).unwrap_or(f64::NAN);
        row(&machine.label_of(parameter), [number(value)])
    });
    [name, stop].into_iter().chain(values).collect()
}

/// The motion as rows of a table.
#[must_use]
pub fn motion(machine: &Machine, report: &MotionReport) -> Vec<Row> {
    let multipliers = report.multipliers.map(|multiplier| {
        if multiplier.im == 0.0 {
            number(multiplier.re)
        } else {
            format!("{} {:+.6}i", number(multiplier.re), multiplier.im)
        }
    });
    let [first, second] = multipliers;
    let length = |what, symbol| machine.label(what, symbol, Dimension::Length);
    let velocity = |what, symbol| machine.label(what, symbol, Dimension::Velocity);
    [
        (
            velocity("before-impact velocity", "X'-"),
            number(report.before_impact_velocity),
        ),
        (
            length("greatest position", "X_m"),
            number(report.max_position),
        ),
        (
            length("position at drive angle 0", "X"),
            number(report.position),
        ),
        (
            velocity("velocity at drive angle 0", "X'"),
            number(report.velocity),
        ),
        ("trace of the monodromy".to_owned(), number(report.trace)),
        ("its determinant".to_owned(), number(report.determinant)),
        ("Floquet multipliers".to_owned(), first),
        (String::new(), second),
    ]
    .into_iter()
    .map(|(label, cell)| row(&label, [cell]))
    .collect()
}
