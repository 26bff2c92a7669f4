//! What command line and file say of the parameters that are searched, layer over layer.

use softstop::{Dimension, Machine, Parameter};
use softstop_console::failure::Failure;
use toml::Table;

use super::OptimizeArguments;
use super::configuration::Task;
use super::named::Named;
use super::wishes::{self, Variable, link};
use crate::design::problem::Link;
use crate::design::space::{Axis, Interval};

/// What is searched if nothing else is said, in units of k1 and of F0/k1.
const DEFAULTS: [(Parameter, Interval); 2] = [
    (
        Parameter::StopStiffness,
        Interval {
            low: 1.0,
            high: 30.0,
        },
    ),
    (
        Parameter::Clearance,
        Interval {
            low: 2.0,
            high: 22.0,
        },
    ),
];
/// No bound: the zone itself and the margin limit the frequency.
const ANY: Interval = Interval {
    low: f64::MIN_POSITIVE,
    high: f64::INFINITY,
};

/// What one layer says about searched values. One that only states the machine's value has no range.
#[derive(Default)]
pub(super) struct Words {
    ranges: Vec<Named<[f64; 2]>>,
    catalogues: Vec<Named<Vec<f64>>>,
    stated: Vec<String>,
}

/// What `[vary]` says: ranges and catalogues, and links.
pub(super) fn variables(machine: &Machine, table: &Table) -> Result<(Words, Vec<Link>), Failure> {
    let (mut words, mut links) = (Words::default(), Vec::<Link>::new());
    for Named { name, value } in wishes::variables(table)? {
        wishes::parameter(machine, &name)?;
        match value {
            Variable::Range(value) => words.ranges.push(Named { name, value }),
            Variable::Catalogue(value) => words.catalogues.push(Named { name, value }),
            Variable::Follows(follow) => links.push(link(machine, &name, &follow)?),
        }
    }
    for (index, it) in links.iter().enumerate() {
        let is_twice = links[..index]
            .iter()
            .any(|one| one.parameter == it.parameter);
        if is_twice || links.iter().any(|one| one.parameter == it.follows) {
            let name = machine.name(it.parameter);
            return Err(Failure::usage(format!(
                "vary.{name}: must follow one parameter that follows no other"
            )));
        }
    }
    Ok((words, links))
}

pub(super) fn spoken(arguments: &OptimizeArguments) -> Words {
    let held = arguments.fix.iter().map(|word| Named {
        name: word.name.clone(),
        value: [word.value, word.value],
    });
    Words {
        ranges: arguments.bounds.iter().cloned().chain(held).collect(),
        stated: arguments.machine.keys(),
        ..Words::default()
    }
}

pub(super) fn written(task: &Task, mut words: Words) -> Result<Words, Failure> {
    let stated = task.scene.given().into_iter();
    words.ranges.extend(task.words()?);
    words.stated = stated.map(|(name, _)| name.to_owned()).collect();
    Ok(words)
}

/// The axes and the range of the drive's frequency. The first layer that speaks of a parameter decides; it
/// may do so only once. The usual ones are searched if they are not said to be something else.
pub(super) fn axes(
    machine: &Machine,
    layers: &[Words],
    with_usual: bool,
) -> Result<(Vec<Axis>, Interval), Failure> {
    let mut said: Vec<Axis> = Vec::new();
    for words in layers {
        let above = said.len();
        let mut say = |axis: Axis| {
            if said[above..]
                .iter()
                .any(|it| it.parameter == axis.parameter)
            {
                return Err(only_one(machine, axis.parameter));
            }
            said.push(axis);
            Ok(())
        };
        for word in &words.ranges {
            let (parameter, unit) = stated(machine, &word.name)?;
            let range = interval(machine, parameter, word.value.map(|end| end * unit))?;
            say(Axis::new(parameter, range))?;
        }
        for word in &words.catalogues {
            let (parameter, unit) = stated(machine, &word.name)?;
            let values = word.value.iter().map(|value| value * unit).collect();
            let axis = Axis::of_catalogue(parameter, values);
            if parameter == Parameter::Frequency {
                return Err(Failure::usage(format!(
                    "{}: can be a range or a value to hold, not a catalogue",
                    word.name
                )));
            }
            interval(machine, parameter, [axis.range.low, axis.range.high])?;
            say(axis)?;
        }
        for name in &words.stated {
            // What is stated of the machine is held, if the search would choose it.
            let Ok(parameter) = machine.parameter(name) else {
                continue;
            };
            let usual = DEFAULTS.iter().any(|(usual, _)| *usual == parameter);
            let (true, Some(value)) = (
                usual || parameter == Parameter::Frequency,
                machine.value(parameter),
            ) else {
                continue;
            };
            say(Axis::new(parameter, Interval::held(value)))?;
        }
    }
    let usual = DEFAULTS
        .into_iter()
        .filter(|(parameter, _)| with_usual && machine.value(*parameter).is_some())
        .map(|(parameter, range)| Axis::new(parameter, scaled(machine, parameter, range)));
    let mut axes: Vec<Axis> = usual.collect();
    let mut frequency = ANY;
    let mut done = Vec::new();
    for axis in said {
        if done.contains(&axis.parameter) {
            continue;
        }
        done.push(axis.parameter);
        let known = axes.iter_mut().find(|it| it.parameter == axis.parameter);
        match known {
            _ if axis.parameter == Parameter::Frequency => frequency = axis.range,
            Some(known) => *known = axis,
            None => axes.push(axis),
        }
    }
    Ok((axes, frequency))
}

/// The parameter of a key and the key's unit in the machine's own.
fn stated(machine: &Machine, name: &str) -> Result<(Parameter, f64), Failure> {
    let stated = machine.stated(name);
    stated.map_err(|error| Failure::usage(error.to_string()))
}

fn only_one(machine: &Machine, parameter: Parameter) -> Failure {
    let name = machine.name(parameter);
    Failure::usage(format!(
        "{name}: only one value to hold or one range can be given"
    ))
}

fn interval(
    machine: &Machine,
    parameter: Parameter,
    [low, high]: [f64; 2],
) -> Result<Interval, Failure> {
    let name = machine.name(parameter);
    let allowed = parameter.about().allowed;
    for value in [low, high] {
        let checked = allowed.check(name, value);
        checked.map_err(|error| Failure::usage(error.to_string()))?;
    }
    if low > high {
        let message = format!("bounds {name} = {low}:{high}: low must be <= high");
        return Err(Failure::usage(message));
    }
    Ok(Interval { low, high })
}

/// A range in units of k1 or F0/k1 in the machine's own units.
fn scaled(machine: &Machine, parameter: Parameter, range: Interval) -> Interval {
    let scene = &machine.scene;
    let unit = match parameter.about().dimension {
        Dimension::Stiffness => scene.stiffness,
        _ => scene.excitation.amplitude / scene.stiffness,
    };
    Interval {
        low: range.low * unit,
        high: range.high * unit,
    }
}
