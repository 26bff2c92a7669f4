//! What several commands report: records whose names are the keys of the JSON.

use nalgebra::Complex;
use serde::Serialize;
use serde_json::{Map, Value, json};
use softstop::{Machine, Parameter, Ratios, Stop, UnitSystem};
use softstop_dynamics::{MotionKind, Orbit, orbit};

use crate::column::{Cell, Column, Told};
use crate::columns;
use crate::machine::PaperMachine;
use crate::number::NumberStyle;
use crate::record::Record;
use crate::units;

/// Floquet multipliers: their parts and moduli, the latter below 1 if the motion is stable.
pub fn multipliers([first, second]: [Complex<f64>; 2]) -> Told {
    let parts = |it: Complex<f64>| json!({ "re": it.re, "im": it.im, "modulus": it.norm() });
    let (re, im) = (NumberStyle::Six.format(first.re), first.im.abs());
    Told {
        value: json!([parts(first), parts(second)]),
        words: match im {
            0.0 => format!("{re}, {}", NumberStyle::Six.format(second.re)),
            _ => format!("{re} +- {im:.6} i, modulus {:.6}", first.norm()),
        },
    }
}

/// A machine as its user states it, whatever the command: its name, if it has one; its language, `si`, `hertz` (SI with the
/// drive's frequency in Hz) or `ratios`; its units, by what they measure; its [`parameters`].
pub fn stated_machine(machine: &Machine) -> Record {
    let language = match machine.unit_system {
        UnitSystem::Si => "si",
        UnitSystem::Hertz => "hertz",
        UnitSystem::Ratios => "ratios",
    };
    Record::default()
        .hidden("name", machine.name.clone())
        .hidden("language", language)
        .hidden("units", json!(units::names(machine)))
        .hidden("parameters", Value::from(parameters(machine)))
}

/// All that a machine has, in its own units, by the dotted keys of its file, as `--set` takes them.
pub fn parameters(machine: &Machine) -> Map<String, Value> {
    let number = |it| Some((machine.name(it).to_owned(), machine.value(it)?.into()));
    let numbers = machine.parameters().filter_map(number);
    law(&machine.scene.stop).chain(numbers).collect()
}

/// What makes out a stop's law besides numbers: its model, its release, its slopes.
fn law(stop: &Stop) -> impl Iterator<Item = (String, Value)> + use<> {
    let law = serde_json::to_value(stop).unwrap_or_default();
    let fields = law.as_object().cloned().unwrap_or_default().into_iter();
    fields
        .filter(|(_, value)| !value.is_number())
        .map(|(key, value)| (format!("stop.{key}"), value))
}

/// A machine where its keys were promised: one like the paper's by regime and the paper's ratios, too, but for its frequency.
pub fn stated(machine: &Machine) -> Record {
    let ratios = machine.ratios().filter(|ratios| ratios.rigid.is_none());
    let ratios = ratios.into_iter().flat_map(|ratios| {
        RATIOS
            .map(|name| Some((name, ratio(machine, &ratios, name)?)))
            .into_iter()
            .flatten()
    });
    let ratios = ratios.fold(Record::default(), |all, (name, cell)| {
        all.hidden(name, cell)
    });
    ratios.hidden("machine", stated_machine(machine))
}

fn ratio(machine: &Machine, ratios: &Ratios, name: &str) -> Option<Cell> {
    let regime = ratios
        .piercing
        .map_or(PaperMachine::Unloaded, |_| PaperMachine::Loaded);
    Some(match name {
        "preload" => ratios.preload.into(),
        "regime" => regime.name().into(),
        _ => machine.value(machine.parameter(name).ok()?)?.into(),
    })
}

/// What the paper's ratios are called in JSON.
const RATIOS: [&str; 10] = [
    "clearance",
    "contact_damping",
    "damping",
    "piercing_friction",
    "piercing_stiffness",
    "preload",
    "regime",
    "stiffness",
    "thickness",
    "travel",
];

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
    pub fn of(motion: &MotionKind) -> Self {
        Self {
            kind: motion.json_key(),
            z: motion.z(),
            order: motion.order().map(ToString::to_string),
            text: motion.to_string(),
        }
    }

    /// That of a regime whose order is not known; without one the motion has not settled.
    pub fn of_regime(regime: Option<orbit::Regime>) -> Self {
        Self {
            kind: regime.map_or(MotionKind::Unsettled.json_key(), |_| "periodic"),
            z: regime.map(|regime| regime.to_string()),
            order: None,
            text: regime.map_or("unsettled".to_owned(), |regime| format!("z = {regime}")),
        }
    }

    /// By its names, for programs.
    pub fn figures(&self) -> Record {
        let figures = Record::default().hidden("kind", self.kind);
        let figures = figures.hidden("z", self.z.clone());
        match &self.order {
            Some(order) => figures.hidden("order", order.clone()),
            None => figures,
        }
    }

    /// In a word: z, or the kind of what does not repeat.
    pub fn word(&self) -> &str {
        self.z.as_deref().unwrap_or(self.kind)
    }
}

impl From<MotionName> for Cell {
    fn from(name: MotionName) -> Self {
        Self::Told(Told {
            value: serde_json::to_value(&name).unwrap_or_default(),
            words: name.text,
        })
    }
}

type Found<'a> = (&'a Machine, &'a Orbit);

fn motions<'a>() -> [Column<Found<'a>>; 8] {
    columns! { Found<'a>, it;
        "frequency" [Frequency], "drive frequency" => it.0.value(Parameter::Frequency);
        "before_impact_velocity" [Velocity] Six, "before-impact velocity" => it.1.before_impact_velocity();
        "max_position" [Length] Six, "greatest position" => it.1.max_position;
        "position" [Length] Six, "position at time 0" => it.1.position;
        "velocity" [Velocity] Six, "velocity at time 0" => it.1.velocity;
        "trace" [None] Six, "trace of the monodromy" => it.1.monodromy.trace();
        "determinant" [None] Six, "its determinant" => it.1.monodromy.determinant();
        "multipliers" [None] Six, "Floquet multipliers" => multipliers(it.1.monodromy.multipliers());
    }
}

/// A z = 1 motion of this machine: where it goes, and how stable it is.
pub fn motion(machine: &Machine, orbit: &Orbit) -> Record {
    Record::of(&motions(), &(machine, orbit))
}

/// The machine for people: its name, its stop, and its parameters but for some; what follows those as its expression.
pub fn machine(machine: &Machine, but: &[Parameter]) -> Record {
    let head = Record::default()
        .with(
            "machine",
            "machine",
            machine.name.clone().unwrap_or_default(),
        )
        .with("stop", "stop", machine.scene.stop.model());
    let of_left_out: Vec<Parameter> = but.iter().flat_map(|it| machine.followers(*it)).collect();
    let parameters = machine.parameters().filter(|it| !but.contains(it));
    parameters.fold(head, |record, it| {
        let label = machine.label_of(it);
        match of_left_out.contains(&it) {
            true => record.with(
                it.name(),
                &label,
                machine.expression(it).unwrap_or_default().to_owned(),
            ),
            false => record.with(it.name(), &label, machine.value(it)),
        }
    })
}
