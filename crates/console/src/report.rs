//! What several commands report: plain data whose field names are the keys of the JSON.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::{Map, Value};
use softstop::{Dimension, Language, Machine, Parameter};
use softstop_dynamics::orbit::Orbit;

use crate::machine::Regime;
use crate::table::{Row, number, row};

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

/// A machine by the keys of its file, as its user states it: one like the paper's by the names of the
/// paper's ratios, any other with its name, its units and its parameters.
#[derive(Debug, Clone, Serialize)]
#[serde(transparent)]
pub struct MachineReport(Map<String, Value>);

impl MachineReport {
    /// This machine.
    #[must_use]
    pub fn of(machine: &Machine) -> Self {
        let mut report = Map::new();
        let is_drive = |parameter: &Parameter| *parameter == Parameter::Frequency;
        let parameters = machine.parameters().filter(|it| !is_drive(it));
        let value = |parameter| machine.value(parameter).unwrap_or(f64::NAN);
        if let Some(ratios) = machine.ratios().filter(|ratios| ratios.rigid.is_none()) {
            let regime = ratios.piercing.map_or(Regime::Unloaded, |_| Regime::Loaded);
            report.insert("regime".to_owned(), regime.name().into());
            let preload = ("preload".to_owned(), ratios.preload);
            let of_ratios = parameters.filter_map(|it| Some((ratio(it)?.to_owned(), value(it))));
            report.extend(
                of_ratios
                    .chain([preload])
                    .map(|(key, value)| (key, value.into())),
            );
            return Self(report);
        }
        let name = machine.name.as_deref().unwrap_or("machine");
        report.insert("machine".to_owned(), name.into());
        report.insert("clearance".to_owned(), value(Parameter::Clearance).into());
        let units = units(machine).into_iter();
        let units = units.map(|(what, unit)| (what.to_owned(), unit.into()));
        report.insert("units".to_owned(), Map::from_iter(units).into());
        let parameters = parameters.map(|it| (key(machine.name(it)), value(it).into()));
        let model = ("stop_model".to_owned(), machine.scene.stop.model().into());
        let parameters = Map::from_iter(parameters.chain([model]));
        report.insert("parameters".to_owned(), parameters.into());
        Self(report)
    }
}

/// The names of a machine's units.
#[must_use]
pub fn units(machine: &Machine) -> BTreeMap<&'static str, &'static str> {
    let name = |dimension, ratio| match machine.speaks {
        Language::Ratios => ratio,
        _ => machine.unit(dimension),
    };
    [
        ("length", name(Dimension::Length, "F0/k1")),
        ("velocity", name(Dimension::Velocity, "F0/sqrt(m k1)")),
        ("frequency", name(Dimension::Frequency, "sqrt(k1/m)")),
        ("force", name(Dimension::Force, "F0")),
        ("time", name(Dimension::Time, "sqrt(m/k1)")),
        ("energy", name(Dimension::Energy, "F0^2/k1")),
    ]
    .into()
}

/// A dotted name as a key of JSON.
#[must_use]
pub fn key(name: &str) -> String {
    name.replace('.', "_")
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
