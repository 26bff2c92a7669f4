//! The report's data from what a run has found.

mod parts;

use rayon::join;
use softstop::{Dimension, Machine, Parameter};
use softstop_dynamics::Orbit;

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
use parts::{
    corners, erosion, fronts, histogram, maps, requirement, run_up, sensitivities, speed, told,
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
    let chosen: Vec<Parameter> = chosen(problem);
    let others: Vec<(String, &Machine, &Orbit)> = references
        .iter()
        .map(|it| (called(it), &it.machine, &it.orbit))
        .collect();
    let named: Vec<(String, Machine)> = references
        .iter()
        .map(|it| (called(it), it.machine.clone()))
        .collect();
    let corners = study.map_or_else(Vec::new, |it| corners(machine, it));
    let ((maps, response), (basin, bands)) = join(
        || join(|| maps(problem, design), || response(design, &named)),
        || join(|| basin(design).ok(), || bands(&corners)),
    );
    Report {
        machine: machine.name.clone().unwrap_or_else(|| "machine".to_owned()),
        task: task(problem),
        warnings: warnings(problem, outcome, study),
        highlights: highlights(problem, design, study),
        comparison: Some(comparison(design, &chosen, &others)),
        limit: limit(problem, outcome),
        requirements: outcome
            .met
            .iter()
            .map(|it| requirement(machine, it))
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
        computed: computed(job, outcome, study),
    }
}

/// What a reference is called: a point of the paper, or the machine as it was given.
fn called(reference: &Reference) -> String {
    match reference.name {
        "given" => "as given".to_owned(),
        point => format!("paper's {point}"),
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
            told(&rival.machine, figure.dimension(), rival.value),
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
    let machine = &design.machine;
    let zone = &design.zone;
    let frequency = design.orbit.scene.excitation.frequency;
    let figure = problem.objective.figure;
    let fact = |name: &str, dimension, value| Fact {
        name: name.to_owned(),
        value: told(machine, dimension, value),
    };
    let below = Dimension::Frequency;
    let tolerated = study.map(|it| {
        let velocity = Dimension::Velocity;
        let machines = count(it.verdict.machines as u64);
        [
            fact(
                "least velocity within the tolerances",
                velocity,
                it.slowest(),
            ),
            Fact {
                name: format!("of {machines} machines lose the motion"),
                value: count(it.verdict.lost as u64),
            },
        ]
    });
    let nominal = [
        fact(figure.meaning(), figure.dimension(), design.value),
        fact("drive frequency", below, frequency),
        fact(
            "below the fold s_SN by",
            below,
            zone.frequency_sn - frequency,
        ),
        fact(
            "above the grazing boundary g0 by",
            below,
            frequency - zone.frequency_g0,
        ),
    ];
    nominal
        .into_iter()
        .chain(tolerated.into_iter().flatten())
        .collect()
}

fn limit(problem: &Problem, outcome: &Outcome) -> Option<String> {
    let limits = at_limits(problem, outcome, |value| quantity(value, "")).into_iter();
    let limits: Vec<String> = limits.map(|it| it.words).collect();
    Some(match limits.is_empty() {
        true => format!(
            "Nothing holds the design back: the {} lies inside all bounds.",
            problem.objective.words()
        ),
        false => format!("The design is held back by {}.", limits.join(", and by ")),
    })
}

fn computed(job: &Job, outcome: &Outcome, study: Option<&Study>) -> Vec<Fact> {
    let fact = |name: &str, value: String| Fact {
        name: name.to_owned(),
        value,
    };
    let samples = study.map(|it| {
        let machines = count(it.verdict.machines as u64);
        let links = match job.problem.links.is_empty() {
            true => "",
            false => "; what follows another value keeps to the design's: links are rules of design and carry no tolerance",
        };
        let words = format!("{machines} machines, Owen-scrambled Sobol points{links}");
        fact("tolerances", words)
    });
    let all = [
        fact("program", format!("softstop {}", env!("CARGO_PKG_VERSION"))),
        fact(
            "motions",
            "exact between crossings; crossings proven; figures to some 1e-10".to_owned(),
        ),
        fact(
            "search",
            format!(
                "{} hysteresis zones (survey), sequential quadratic programming from the best",
                outcome.evaluations
            ),
        ),
    ];
    all.into_iter().chain(samples).collect()
}
