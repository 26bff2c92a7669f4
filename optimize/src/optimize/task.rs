//! The task as command line and TOML file state it together, checked.

use std::path::PathBuf;

use serde::Serialize;
use softstop::{Dimension, Machine, Parameter};
use softstop_console::failure::Failure;
use softstop_console::machine::{Regime, SceneSettings};
use softstop_console::output::Format;
use softstop_console::range::require;
use softstop_console::report::MachineReport;
use softstop_console::scene_file;

use super::OptimizeArguments;
use super::configuration::Task;
use super::named::Named;
use crate::design::Problem;
use crate::design::search::{LEAST_EVALUATIONS, Settings};
use crate::design::space::{Axis, Interval};

const MARGIN: f64 = 0.25;
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
/// Zones to compute at most, unless that is said.
const EVALUATIONS: u64 = 1200;
const OUTPUT: &str = "softstop-design";

/// All that a run needs to know.
#[derive(Debug)]
pub(super) struct Job {
    pub problem: Problem,
    pub settings: Settings,
    pub output: PathBuf,
    pub format: Format,
}

impl Job {
    /// Joins command line, file and defaults.
    pub(super) fn new(arguments: &OptimizeArguments) -> Result<Self, Failure> {
        let task: Task = match &arguments.config {
            Some(path) => scene_file::read_toml(path)?,
            None => Task::default(),
        };
        let machine = machine(arguments, &task)?;
        let margin = arguments.margin.or(task.margin).unwrap_or(MARGIN);
        require(
            (0.0..=0.5).contains(&margin),
            "margin",
            margin,
            "in [0, 0.5]",
        )?;
        let (axes, frequency) = axes(&machine, &[spoken(arguments), written(&task)?])?;
        let evaluations = arguments
            .evaluations
            .or(task.evaluations)
            .unwrap_or(EVALUATIONS);
        if evaluations < LEAST_EVALUATIONS {
            let message = format!("evaluations = {evaluations}: must be >= {LEAST_EVALUATIONS}");
            return Err(Failure::usage(message));
        }
        Ok(Self {
            problem: Problem {
                machine,
                margin,
                axes,
                frequency,
            },
            settings: Settings {
                seed: arguments.seed.or(task.seed).unwrap_or(0),
                evaluations,
            },
            output: arguments
                .output
                .clone()
                .or(task.output)
                .unwrap_or_else(|| OUTPUT.into()),
            format: arguments.format.or(task.format).unwrap_or_default(),
        })
    }
}

impl Job {
    /// What comes of the search follows from this.
    pub(super) fn identity(&self) -> impl Serialize {
        let Problem {
            machine,
            margin,
            axes,
            frequency,
        } = &self.problem;
        let axes = axes.iter();
        let axes = axes.map(|axis| (axis.parameter.name(), axis.range.low, axis.range.high));
        let axes: Vec<_> = axes.collect();
        let settings = (self.settings.seed, self.settings.evaluations);
        let frequency = (frequency.low, frequency.high);
        (
            &machine.scene,
            MachineReport::of(machine),
            margin,
            axes,
            frequency,
            settings,
        )
    }
}

/// The command line's machine, or else the file's.
fn machine(arguments: &OptimizeArguments, task: &Task) -> Result<Machine, Failure> {
    arguments.machine.refuse_start()?;
    let mut stated = arguments.machine.clone();
    let says_scene = task.regime.is_some() || task.scene != SceneSettings::default();
    if let Some(machine) = &task.machine {
        if says_scene {
            return Err(Failure::usage(
                "machine and scene: only one of the two can be given in a task",
            ));
        }
        let is_named = Regime::called(machine).is_some();
        let folder = arguments.config.as_ref().and_then(|path| path.parent());
        let place = folder
            .filter(|_| !is_named)
            .map_or(machine.clone(), |folder| folder.join(machine));
        stated.machine.get_or_insert(place);
    }
    stated.machine_over(&scene(task)?)
}

/// The file's ratios; its regime may stand at the top or in `[scene]`.
fn scene(task: &Task) -> Result<SceneSettings, Failure> {
    let mut scene = task.scene.clone();
    if task.regime.is_some() && scene.regime.is_some() {
        return Err(Failure::usage(
            "regime and scene.regime: only one of the two can be given",
        ));
    }
    scene.regime = task.regime.or(scene.regime);
    Ok(scene)
}

/// What one layer says about searched values. One that only states the machine's value has no range.
struct Words {
    ranges: Vec<Named<[f64; 2]>>,
    stated: Vec<String>,
}

fn spoken(arguments: &OptimizeArguments) -> Words {
    let held = arguments.fix.iter().map(|word| Named {
        name: word.name.clone(),
        value: [word.value, word.value],
    });
    Words {
        ranges: arguments.bounds.iter().cloned().chain(held).collect(),
        stated: arguments.machine.keys(),
    }
}

fn written(task: &Task) -> Result<Words, Failure> {
    let stated = task.scene.given().into_iter();
    Ok(Words {
        ranges: task.words()?,
        stated: stated.map(|(name, _)| name.to_owned()).collect(),
    })
}

/// The axes and the range of the drive's frequency. The first layer that speaks of a parameter decides; it
/// may do so only once.
fn axes(machine: &Machine, layers: &[Words]) -> Result<(Vec<Axis>, Interval), Failure> {
    let mut ranges: Vec<(Parameter, Interval)> = Vec::new();
    for words in layers {
        let above = ranges.len();
        for word in &words.ranges {
            let stated = machine.stated(&word.name);
            let (parameter, unit) = stated.map_err(|error| Failure::usage(error.to_string()))?;
            if ranges[above..].iter().any(|(other, _)| *other == parameter) {
                return Err(only_one(machine, parameter));
            }
            ranges.push((
                parameter,
                interval(machine, parameter, word.value.map(|end| end * unit))?,
            ));
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
            if ranges[above..].iter().any(|(other, _)| *other == parameter) {
                return Err(only_one(machine, parameter));
            }
            ranges.push((parameter, Interval::held(value)));
        }
    }
    let first = |parameter| {
        let mut all = ranges.iter();
        all.find(|(other, _)| *other == parameter)
            .map(|(_, range)| *range)
    };
    let frequency = first(Parameter::Frequency).unwrap_or(ANY);
    let usual = DEFAULTS
        .into_iter()
        .filter(|(parameter, _)| machine.value(*parameter).is_some())
        .map(|(parameter, range)| (parameter, scaled(machine, parameter, range)));
    let mut axes: Vec<Axis> = Vec::new();
    for (parameter, range) in usual.chain(ranges.iter().copied()) {
        let known = axes.iter().any(|axis| axis.parameter == parameter);
        if parameter != Parameter::Frequency && !known {
            let range = first(parameter).unwrap_or(range);
            axes.push(Axis { parameter, range });
        }
    }
    Ok((axes, frequency))
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
