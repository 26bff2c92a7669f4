//! The task as command line and TOML file state it together, checked.

use std::io::{self, Write};
use std::path::PathBuf;

use serde::Serialize;
use softstop::{Machine, Parameter};
use softstop_console::budget::Budget;
use softstop_console::failure::Failure;
use softstop_console::machine::{Regime, SceneSettings};
use softstop_console::output::Format;
use softstop_console::range::require;
use softstop_console::report::MachineReport;
use softstop_console::scene_file;

use super::OptimizeArguments;
use super::configuration::Task;
use super::layers;
use super::required::requirements;
use super::wishes::{objective, tolerances};
use crate::design::Problem;
use crate::design::figure::Figure;
use crate::design::problem::{Link, Tolerance};
use crate::design::search::{LEAST_EVALUATIONS, Settings};

const MARGIN: f64 = 0.25;
/// Zones to compute at most, unless that is said.
const EVALUATIONS: u64 = 1200;
const OUTPUT: &str = "softstop-design";

/// All that a run needs to know.
#[derive(Debug)]
pub(super) struct Job {
    pub problem: Problem,
    pub settings: Settings,
    /// Machines looked at within the tolerances.
    pub samples: usize,
    /// Work that the search may cost for each evaluation.
    pub budget: Budget,
    /// Whether there is to be a report.
    pub report: bool,
    pub output: PathBuf,
    pub format: Format,
}

impl Job {
    /// Joins command line, file and defaults.
    pub(super) fn new(arguments: &OptimizeArguments) -> Result<Self, Failure> {
        let task = task(arguments)?;
        let machine = machine(arguments, &task)?;
        let tolerances = tolerances(&machine, &task.tolerance)?;
        let mut requirements = requirements(&machine, &task.require)?;
        let objective = objective(&machine, &task.objective)?;
        let share = requirements.iter().find(|it| it.figure == Figure::Share);
        if share.is_some_and(|it| it.most.is_some()) {
            return Err(Failure::usage(
                "require.margin: can be at least so much, not at most",
            ));
        }
        let share = share.and_then(|it| it.least);
        if share.is_some() && task.margin.is_some() {
            return Err(Failure::usage(
                "margin and require.margin: only one of the two can be given",
            ));
        }
        let says_where = tolerances.iter().any(|it| !it.is_exact())
            || requirements.iter().any(|it| it.figure.is_margin());
        let usual = if says_where { 0.0 } else { MARGIN };
        let margin = arguments.margin.or(task.margin).or(share).unwrap_or(usual);
        requirements.retain(|it| it.figure != Figure::Share);
        require(
            (0.0..=0.5).contains(&margin),
            "margin",
            margin,
            "in [0, 0.5]",
        )?;
        let (variables, links) = layers::variables(&machine, &task.vary)?;
        let said = [
            layers::spoken(arguments),
            layers::written(&task, variables)?,
        ];
        let (axes, frequency) = layers::axes(&machine, &said, task.vary.is_empty())?;
        for tolerance in &tolerances {
            let axis = axes.iter().find(|it| it.parameter == tolerance.parameter);
            let highest = axis.map(|it| it.range.high);
            leaves_machines(&machine, tolerance, highest)?;
        }
        let both = |link: &&Link| axes.iter().any(|axis| axis.parameter == link.parameter);
        if let Some(link) = links.iter().find(both) {
            return Err(Failure::usage(format!(
                "vary.{}: follows another parameter, and is searched or held as well; only one of the two can be given",
                machine.name(link.parameter)
            )));
        }
        if arguments.seed.or(task.seed).or(task.search.seed).is_some() {
            // If nobody reads it, there is nobody to tell.
            let _ = writeln!(
                io::stderr(),
                "seed: the search is deterministic and needs none"
            );
        }
        let evaluations = arguments
            .evaluations
            .or(task.evaluations)
            .or(task.search.evaluations)
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
                links,
                tolerances,
                objective,
                requirements,
            },
            settings: Settings { evaluations },
            samples: arguments.samples,
            budget: arguments.budget,
            report: !arguments.no_report,
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
            links,
            tolerances,
            objective,
            requirements,
        } = &self.problem;
        let wishes = format!("{links:?} {tolerances:?} {objective:?} {requirements:?}");
        let axes = axes.iter();
        let axes = axes.map(|it| {
            (
                it.parameter.name(),
                it.range.low,
                it.range.high,
                &it.catalogue,
            )
        });
        let axes: Vec<_> = axes.collect();
        let frequency = (frequency.low, frequency.high);
        (
            &machine.scene,
            MachineReport::of(machine),
            margin,
            axes,
            frequency,
            self.settings.evaluations,
            wishes,
        )
    }
}

/// Refuses a task beside a machine in its file that no search could take up.
///
/// # Errors
/// [`Failure::Usage`] naming the key, its value and what is allowed.
pub(super) fn check(machine: &Machine, text: &str) -> Result<(), Failure> {
    let task = Task::beside_machine(text)?;
    tolerances(machine, &task.tolerance)?;
    requirements(machine, &task.require)?;
    objective(machine, &task.objective)?;
    layers::variables(machine, &task.vary)?;
    Ok(())
}

/// Refuses a tolerance within which there are no machines even about the highest value that is searched.
fn leaves_machines(
    machine: &Machine,
    tolerance: &Tolerance,
    highest: Option<f64>,
) -> Result<(), Failure> {
    let (parameter, name) = (tolerance.parameter, machine.name(tolerance.parameter));
    let is_searched = highest.is_none() && parameter == Parameter::Frequency;
    let Some(value) = highest
        .or(machine.value(parameter))
        .filter(|_| !is_searched)
    else {
        return Ok(());
    };
    let width = tolerance.width.around(value);
    let least = parameter.about().allowed.check(name, value - width);
    least.map(|_| ()).map_err(|error| {
        Failure::usage(format!(
            "tolerance.{name} = {width}: is too wide about {value}: {error}"
        ))
    })
}

/// The task of `--config`, or the one that stands beside the machine in its file.
fn task(arguments: &OptimizeArguments) -> Result<Task, Failure> {
    let machine = arguments.machine.machine.as_ref();
    let file = machine.filter(|path| Regime::called(path).is_none());
    let beside = match file {
        Some(path) => {
            Task::beside_machine(&scene_file::text(path)?).map_err(|error| error.in_file(path))?
        }
        None => Task::default(),
    };
    let Some(path) = &arguments.config else {
        return Ok(beside);
    };
    if beside.is_any() {
        return Err(Failure::usage(format!(
            "--config {}: the machine's file has a task of its own; only one of the two can be given",
            path.display()
        )));
    }
    scene_file::read_toml(path)
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
