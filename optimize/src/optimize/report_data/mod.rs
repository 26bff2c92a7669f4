//! The report's data from what a run has found.

mod parts;

use rayon::join;
use softstop::{Dimension, Parameter};

use super::outcome::Outcome;
use super::reference::Reference;
use super::study::Study;
use super::task::Job;
use crate::design::Design;
use crate::design::conflict::stated;
use crate::design::problem::Problem;
use crate::design::space::Interval;
use crate::limits::at_limits;
use crate::page::computed::{bands, basin, comparison, portrait, response};
use crate::page::data::{self, Fact, Report};
use crate::page::{count, quantity};
use crate::verdict;
use parts::{
    corners, erosion, format_quantity, fronts, histogram, maps, run_up, sensitivities, speed,
};

/// All that is told of a design.
pub(super) fn report(
    job: &Job,
    outcome: &Outcome,
    references: &[Reference],
    study: Option<&Study>,
) -> Report {
    let design = &outcome.design;
    let machine = &design.machine;
    let problem = &job.problem;
    let corners = study.map_or_else(Vec::new, |it| corners(machine, it));
    let ((maps, response), (basin, bands)) = join(
        || join(|| maps(problem, design), || response(design, references)),
        || join(|| basin(design).ok(), || bands(&corners)),
    );
    Report {
        machine: machine.name.clone().unwrap_or_else(|| "machine".to_owned()),
        task: task(problem),
        warnings: warnings(problem, outcome, study),
        highlights: highlights(problem, design, study),
        comparison: Some(comparison(design, &chosen(problem), references)),
        limit: limit(problem, outcome),
        requirements: outcome
            .met
            .iter()
            .map(|it| verdict::required(machine, it))
            .collect(),
        maps,
        response: Some(data::Response {
            tolerance: speed(problem, design),
            machines: corners.len() * usize::from(!bands.is_empty()),
            bands,
            ..response
        }),
        portrait: Some(portrait(design)),
        basin,
        erosion: outcome
            .erosion
            .as_ref()
            .map(|it| erosion(problem, outcome, it)),
        fronts: fronts(problem, outcome),
        histogram: study.map(|it| histogram(machine, it)),
        sensitivities: study.map_or_else(Vec::new, |it| sensitivities(machine, it)),
        run_up: outcome
            .run_up
            .iter()
            .flat_map(|it| &it.ways)
            .map(|it| run_up(machine, it))
            .collect(),
        computed: Some(data::Computed {
            zones: outcome.evaluations,
            samples: study.map(|it| it.verdict.machines as u64),
            has_links: !problem.links.is_empty(),
        }),
    }
}

/// The parameters that the search has set.
fn chosen(problem: &Problem) -> Vec<Parameter> {
    let axes = problem.axes.iter().filter(|axis| !axis.range.is_held());
    let links = problem.links.iter().map(|link| link.parameter);
    let frequency = (!problem.frequency.is_held()).then_some(Parameter::Frequency);
    axes.map(|axis| axis.parameter)
        .chain(links)
        .chain(frequency)
        .collect()
}

fn task(problem: &Problem) -> String {
    let machine = &problem.machine;
    let axes = problem.axes.iter().filter(|axis| !axis.range.is_held());
    let range = |parameter: Parameter, range: Interval| {
        let (what, unit) = (parameter.about().meaning, machine.unit_of(parameter));
        match range.is_held() {
            true => format!("{what} of {}", quantity(range.low, unit)),
            false => format!(
                "{what} from {} to {}",
                quantity(range.low, ""),
                quantity(range.high, unit)
            ),
        }
    };
    let axes = axes.map(|axis| match axis.catalogue.len() {
        0 => range(axis.parameter, axis.range),
        count => format!("{} one of {count} values", axis.parameter.about().meaning),
    });
    let frequency = problem.frequency;
    let is_bound = frequency.high.is_finite();
    let speed = is_bound.then(|| range(Parameter::Frequency, frequency));
    let within: Vec<String> = axes.chain(speed).collect();
    let margin = match problem.margin {
        0.0 => String::new(),
        margin => format!(", at least {margin} of the zone's width from both of its ends"),
    };
    let further = [
        ("requirements", problem.requirements.len()),
        ("tolerances", problem.tolerances.len()),
    ];
    let further = further.iter().filter(|(_, count)| *count > 0);
    let further: Vec<&str> = further.map(|(what, _)| *what).collect();
    let further = match further.is_empty() {
        true => String::new(),
        false => format!("; with the {} below", further.join(" and ")),
    };
    format!(
        "Wanted: the {} with {}{margin}{further}.",
        problem.objective.words(),
        within.join(", ")
    )
}

fn warnings(problem: &Problem, outcome: &Outcome, study: Option<&Study>) -> Vec<String> {
    let figure = problem.objective.figure;
    let rivals = outcome.rivals.iter().map(|rival| {
        let axes = problem.axes.iter().map(|axis| axis.parameter);
        let axes = axes.chain([Parameter::Frequency]);
        let place: Vec<String> = axes
            .filter_map(|it| Some(stated(&rival.machine, it, rival.machine.value(it)?)))
            .collect();
        format!(
            "Another design, far from this one, is nearly as good: {} at {}. A small change of the task may lead there.",
            format_quantity(&rival.machine, figure.dimension(), rival.value),
            place.join(", ")
        )
    });
    let lost = study.filter(|it| it.verdict.lost > 0).map(|it| {
        format!(
            "{} of {} machines within the tolerances lose the motion.",
            it.verdict.lost, it.verdict.machines
        )
    });
    rivals.chain(lost).collect()
}

fn highlights(problem: &Problem, design: &Design, study: Option<&Study>) -> Vec<Fact> {
    let (machine, zone) = (&design.machine, &design.zone);
    let frequency = design.orbit.scene.excitation.frequency;
    let figure = problem.objective.figure;
    let fact = |name, dimension, value| Fact::new(name, format_quantity(machine, dimension, value));
    let frequency_fact = |name, value| fact(name, Dimension::Frequency, value);
    let mut facts = vec![
        fact(figure.meaning(), figure.dimension(), design.value),
        frequency_fact("drive frequency", frequency),
        frequency_fact("below the fold s_SN by", zone.frequency_sn - frequency),
        frequency_fact(
            "above the grazing boundary g0 by",
            frequency - zone.frequency_g0,
        ),
    ];
    if let Some(study) = study {
        let least = "least velocity within the tolerances";
        facts.push(fact(least, Dimension::Velocity, study.slowest()));
        let machines = count(study.verdict.machines as u64);
        let lost = count(study.verdict.lost as u64);
        facts.push(Fact::new(
            format!("of {machines} machines lose the motion"),
            lost,
        ));
    }
    facts
}

fn limit(problem: &Problem, outcome: &Outcome) -> Option<String> {
    let limits = at_limits(problem, outcome).into_iter();
    let limits: Vec<String> = limits.map(|it| it.words).collect();
    Some(match limits.is_empty() {
        true => format!(
            "Nothing holds the design back: the {} lies inside all bounds.",
            problem.objective.words()
        ),
        false => format!("The design is held back by {}.", limits.join(", and by ")),
    })
}
