//! The task as command line and TOML file state it together, checked.

use std::path::{Path, PathBuf};

use serde::Serialize;
use softstop::{Dimension, Machine, Parameter};
use softstop_console::arguments::{WITHOUT_STOP, has_stop, refuse_without_zone};
use softstop_console::budget::Budget;
use softstop_console::change::Change;
use softstop_console::failure::Failure;
use softstop_console::machine::PaperMachine;
use softstop_console::output::Format;
use softstop_console::range::require;
use softstop_console::scene_file;
use softstop_dynamics::zone::ZoneKind;

use super::OptimizeArguments;
use super::cases::{self, cases};
use super::objective::{cost, objectives};
use super::require::read_requirements;
use super::task_spec::{Motions, Search, TaskSpec};
use super::title::{Source, Title};
use super::tolerance::{deviations, has_tolerances, refuse_too_wide, tolerances};
use super::vary::{SearchSpace, held, searched, variables};
use crate::design::Problem;
use crate::design::figure::Figure;
use crate::design::problem::{Objective, Tolerance};
use crate::design::search::{LEAST_EVALUATIONS, SearchSettings};
use crate::design::space::Axis;

const MARGIN: f64 = 0.25;
/// Zones to compute at most, unless that is said.
const EVALUATIONS: u64 = 1200;
const OUTPUT: &str = "softstop-design";

/// All that a run needs to know.
#[derive(Debug)]
pub(super) struct Job {
    pub problem: Problem,
    pub settings: SearchSettings,
    /// Machines looked at within the tolerances.
    pub samples: usize,
    /// Work that the search may cost for each evaluation.
    pub budget: Budget,
    /// Whether there is to be a report.
    pub report: bool,
    pub output: PathBuf,
    pub format: Format,
    /// What stands above the report.
    pub title: Title,
    /// The texts that state the task.
    pub sources: Vec<Source>,
}

impl Job {
    /// Joins command line, file and defaults.
    pub(super) fn new(arguments: &OptimizeArguments) -> Result<Self, Failure> {
        let (task, file) = task(arguments)?;
        let located = |failure: Failure| match &file {
            Some((path, text)) => failure.in_text(path, text),
            None => failure,
        };
        let place = place(arguments, &task);
        arguments.machine.refuse_start()?;
        let machine = arguments.machine.machine_over(place.clone(), &task.set)?;
        let sources = Source::all(arguments, place.as_deref())?;
        let (mut problem, share) = stated(&machine, &task).map_err(located)?;
        refuse_without_zone(&machine).map_err(located)?;
        let tolerances = &problem.tolerances;
        let is_exact = tolerances.iter().all(Tolerance::is_exact);
        if let (Some(tolerance), false) = (tolerances.first(), machine.scene.followers.is_empty()) {
            return Err(Failure::usage(format!(
                "tolerance.{}: no machine with tolerances may have values that follow {}; state them as numbers",
                machine.name(tolerance.parameter),
                machine.name(Parameter::Frequency)
            )));
        }
        has_tolerances(is_exact, &problem.objective, &task.require).map_err(located)?;
        let deviations = deviations(&problem, &task.require, arguments.samples)?;
        let mut figures = problem.requirements.iter().map(|it| it.figure);
        let says_where = !is_exact || figures.any(Figure::is_margin);
        let usual = if says_where { 0.0 } else { MARGIN };
        let margin = arguments.margin.or(share).unwrap_or(usual);
        require(
            (0.0..=0.5).contains(&margin),
            "margin",
            margin,
            "in [0, 0.5]",
        )?;
        let searched = searched_by(arguments, &task, &machine)?;
        cases::check((&machine, &problem.cases), &searched, tolerances).map_err(located)?;
        let SearchSpace {
            axes,
            frequency,
            links,
        } = searched;
        refuse_too_wide((&machine, &problem), deviations, &axes).map_err(located)?;
        has_effect(&machine, &axes)?;
        if !has_stop(&machine.scene) {
            return Err(located(Failure::usage(WITHOUT_STOP)));
        }
        let Search { evaluations, zone } = task.search;
        let evaluations = arguments.evaluations.or(evaluations).unwrap_or(EVALUATIONS);
        let least = format!(">= {LEAST_EVALUATIONS}");
        require(
            evaluations >= LEAST_EVALUATIONS,
            "evaluations",
            evaluations,
            &least,
        )?;
        let si = |end: f64| machine.to_si(Dimension::Frequency, end);
        let zone = match zone {
            Motions::Hysteresis => ZoneKind::Hysteresis,
            Motions::SingleImpact => ZoneKind::SingleImpact {
                between: (si(frequency.low), si(frequency.high)),
            },
        };
        let output = arguments.output.clone().or(task.output);
        problem = Problem {
            zone,
            margin,
            axes,
            frequency,
            links,
            deviations,
            ..problem
        };
        Ok(Self {
            problem,
            settings: SearchSettings { evaluations },
            samples: arguments.samples,
            budget: arguments.budget,
            report: !arguments.no_report,
            output: output.unwrap_or_else(|| OUTPUT.into()),
            format: arguments.format.or(task.format).unwrap_or_default(),
            title: task.report,
            sources,
        })
    }
}

impl Job {
    /// What comes of the search follows from this.
    pub(super) fn identity(&self) -> impl Serialize {
        (format!("{:?}", self.problem), self.settings.evaluations)
    }
}

/// Refuses a task beside a machine in its file that no search could take up.
///
/// # Errors
/// [`Failure::Usage`] naming file, line, column, the key, its value and what is allowed.
pub(super) fn check(machine: &Machine, path: &Path, text: &str) -> Result<(), Failure> {
    let task = TaskSpec::beside_machine(path, text)?.unwrap_or_default();
    let stated = stated(machine, &task);
    stated
        .map(drop)
        .map_err(|failure| failure.in_text(path, text))
}

/// The problem that a task states of a machine, each part checked by itself, without what the command line may say, and the margin
/// from both ends of the zone, if it states one.
///
/// # Errors
/// [`Failure::Usage`] if no search of the machine could take it up.
fn stated(machine: &Machine, task: &TaskSpec) -> Result<(Problem, Option<f64>), Failure> {
    let mut problem = Problem {
        tolerances: tolerances(machine, &task.tolerance)?,
        ..Problem::of(machine.clone(), Vec::new())
    };
    let margin = read_requirements(&mut problem, &task.objective, &task.require)?;
    let mut objectives = objectives(machine, &task.objective)?;
    let formula = task.objective.cost.as_ref();
    problem.cost = formula.map(|text| cost(machine, text)).transpose()?;
    problem.cases = cases(machine, &task.case)?;
    if !task.case.is_empty() && objectives.len() > 1 {
        return Err(Failure::usage(
            "case: cannot be combined with a front of designs (lists under [objective])",
        ));
    }
    let may_lack = |it: &&Objective| matches!(it.figure, Figure::FrequencyG0 | Figure::FrequencySn);
    if task.search.zone == Motions::SingleImpact
        && let Some(it) = objectives.iter().find(may_lack)
    {
        return Err(Failure::usage(format!(
            "objective: {}: cannot be traded with search.zone = \"z = 1\": not all motions have a value; it goes to [require]",
            it.figure.name()
        )));
    }
    problem.traded = objectives.split_off(1);
    problem.objective = objectives.remove(0);
    let searched = searched(machine, &[variables(&task.vary)?], false)?;
    has_effect(machine, &searched.axes)?;
    Ok((problem, margin))
}

/// What the command line says of searched values, over what the task says.
fn searched_by(
    arguments: &OptimizeArguments,
    task: &TaskSpec,
    machine: &Machine,
) -> Result<SearchSpace, Failure> {
    let line = [
        arguments.vary.clone(),
        held(machine, arguments.machine.keys()),
    ];
    let below = [
        variables(&task.vary)?,
        held(machine, task.set.iter().map(Change::key)),
    ];
    let layers = [line, below].map(|layer| layer.concat());
    searched(machine, &layers, task.vary.is_empty())
}

/// Refuses to search a parameter without effect.
fn has_effect(machine: &Machine, axes: &[Axis]) -> Result<(), Failure> {
    let is_idle = |it: &Axis| it.parameter == Parameter::Phase && !it.range.is_held();
    match axes.iter().any(is_idle) {
        true => Err(Failure::usage(format!(
            "vary.{}: has no effect: it shifts the drive in time alone",
            machine.name(Parameter::Phase)
        ))),
        false => Ok(()),
    }
}

/// A file and its text.
type TaskText = (PathBuf, String);

/// The task of `--config`, or the one that stands beside the machine in its file; with that file.
fn task(arguments: &OptimizeArguments) -> Result<(TaskSpec, Option<TaskText>), Failure> {
    let machine = arguments.machine.machine.as_ref();
    let file = machine.filter(|path| PaperMachine::called(path).is_none());
    let beside = |path: &PathBuf| {
        let text = scene_file::text(path)?;
        let task = TaskSpec::beside_machine(path, &text)?;
        Ok(task.map(|task| (task, (path.clone(), text))))
    };
    let beside: Result<_, Failure> = file.map(beside).transpose();
    let beside = beside?.flatten();
    match (&arguments.config, beside) {
        (Some(path), Some(_)) => Err(Failure::usage(format!(
            "--config {}: the machine's file has a task of its own; only one of the two can be given",
            path.display()
        ))),
        (Some(path), None) => {
            let text = scene_file::text(path)?;
            let task = scene_file::parse(path, &text)?;
            Ok((task, Some((path.clone(), text))))
        }
        (None, Some((task, file))) => Ok((task, Some(file))),
        (None, None) => Ok(Default::default()),
    }
}

/// Where the machine is: what the command line says, or else the task, seen from the task's folder.
fn place(arguments: &OptimizeArguments, task: &TaskSpec) -> Option<PathBuf> {
    let folder = arguments.config.as_ref().and_then(|path| path.parent());
    let of_task =
        task.machine
            .as_ref()
            .map(|machine| match (PaperMachine::called(machine), folder) {
                (None, Some(folder)) => folder.join(machine),
                _ => machine.clone(),
            });
    arguments.machine.machine.clone().or(of_task)
}
