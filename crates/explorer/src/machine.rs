//! What a machine is: its parameters with their names, and the names of what is drawn.

use std::collections::BTreeMap;

use serde::Serialize;
use softstop::internals::Scales;
use softstop::{Allowed, Dimension, Machine, Parameter, Start};

use crate::answer::Answer;

#[derive(Serialize)]
struct Description<'a> {
    name: &'a Option<String>,
    description: &'a Option<String>,
    model: &'static str,
    /// The machine file.
    toml: String,
    parameters: Vec<Number>,
    /// Names with units of what is drawn.
    labels: BTreeMap<&'static str, String>,
    /// Where its own motion begins: position and velocity.
    start: [f64; 2],
    /// Where those of its diagram begin: thrown at the stop, and at rest.
    starts: [[f64; 2]; 2],
    /// Half-size of the plane of starts: position and velocity.
    reach: [f64; 2],
    /// The drive period in s.
    period: f64,
}

/// A parameter in the machine's own units.
#[derive(Serialize)]
struct Number {
    key: &'static str,
    label: String,
    value: f64,
    allowed: &'static str,
    /// What sets it, if it follows others.
    follows: Option<String>,
}

/// Half-size of the plane of starts, in units of the motion's length (and of w times it).
const WIDE: f64 = 2.0;
/// Speed of a start that is thrown at the stop, in the same units.
const THROWN: f64 = 1.25;

/// Says what a machine is.
pub(crate) fn describe(machine: &Machine) -> Answer {
    let scene = &machine.scene;
    let Scales { length, rate } = scene.motion_scales();
    let thrown = Start::new(0.0, THROWN * length * rate);
    let described = Description {
        name: &machine.name,
        description: &machine.description,
        model: scene.stop.model(),
        toml: machine.to_toml(),
        parameters: machine
            .parameters()
            .filter_map(|it| number(machine, it))
            .collect(),
        labels: labels(machine),
        start: pair(machine.start),
        starts: [thrown, Start::REST].map(pair),
        reach: [WIDE * length, WIDE * length * rate],
        period: scene.period(),
    };
    Answer::new(&described, Vec::new())
}

/// Position and velocity.
pub(crate) const fn pair(start: Start) -> [f64; 2] {
    [start.position, start.velocity]
}

fn number(machine: &Machine, parameter: Parameter) -> Option<Number> {
    Some(Number {
        key: machine.name(parameter),
        label: machine.label_of(parameter),
        value: machine.value(parameter)?,
        allowed: match parameter.about().allowed {
            Allowed::Positive => "positive",
            Allowed::NotNegative => "not_negative",
            Allowed::Finite => "finite",
            Allowed::Share => "share",
            Allowed::Power => "power",
        },
        follows: machine.expression(parameter).map(str::to_owned),
    })
}

fn labels(machine: &Machine) -> BTreeMap<&'static str, String> {
    let labels = [
        ("time", "time t", Dimension::Time),
        ("position", "position x", Dimension::Length),
        ("velocity", "velocity v", Dimension::Velocity),
        ("impact", "before-impact velocity", Dimension::Velocity),
    ];
    let label = |(key, what, dimension)| (key, machine.label(what, "", dimension));
    labels.map(label).into()
}

/// The parameter of a key.
pub(crate) fn parameter(machine: &Machine, key: &str) -> Result<Parameter, String> {
    let mut all = machine.parameters();
    let found = all.find(|it| machine.name(*it) == key && machine.expression(*it).is_none());
    found.ok_or_else(|| format!("{key}: must be a parameter that follows no other"))
}
