//! Sections of the report's data, each from what a run has found of it.

use softstop::{Dimension, Machine, Parameter};
use softstop_console::table::number;
use softstop_dynamics::basin::{ErosionProfile, Integrity};
use softstop_dynamics::run_up::{Attempt, Way};

use crate::design::Design;
use crate::design::figure::Figure;
use crate::design::front::{Front, front};
use crate::design::judge::{Met, bound};
use crate::design::problem::Problem;
use crate::design::space::Axis;
use crate::optimize::outcome::{EROSION_STARTS, Outcome};
use crate::optimize::study::Study;
use crate::page::computed::map;
use crate::page::data::{self, Label};
use crate::robust::{Scatter, Tolerance};

/// Maps at most.
const MAPS: usize = 2;
/// Bars of the histogram.
const BARS: usize = 40;

/// A value with its unit.
pub(super) fn told(machine: &Machine, dimension: Dimension, value: f64) -> String {
    let own = machine.to_own(dimension, value);
    crate::page::quantity(own, machine.unit(dimension))
}

pub(super) fn requirement(machine: &Machine, met: &Met) -> data::Requirement {
    let figure = met.requirement.figure;
    let own = |value: f64| machine.to_own(figure.dimension(), value);
    data::Requirement {
        name: figure.name().to_owned(),
        meaning: figure.meaning().to_owned(),
        unit: machine.unit(figure.dimension()).to_owned(),
        required: bound(machine, &met.requirement),
        value: own(met.value),
        margin: own(met.margin()),
        met: met.is_met(),
    }
}

/// Half-width of the tolerance of a parameter, in the machine's own units.
fn half_width(problem: &Problem, design: &Design, parameter: Parameter) -> Option<f64> {
    let tolerance = problem
        .tolerances
        .iter()
        .find(|it| it.parameter == parameter)?;
    Some(tolerance.width.around(design.machine.value(parameter)?))
}

pub(super) fn maps(problem: &Problem, design: &Design) -> Vec<data::Map> {
    let axes = problem.axes.iter().filter(|axis| !axis.range.is_held());
    let one = |axis: &Axis| {
        let [across, upwards] =
            [Parameter::Frequency, axis.parameter].map(|it| half_width(problem, design, it));
        let tolerance = (across.is_some() || upwards.is_some())
            .then(|| [across.unwrap_or(0.0), upwards.unwrap_or(0.0)]);
        data::Map {
            tolerance,
            ..map(design, axis.parameter, [axis.range.low, axis.range.high])
        }
    };
    axes.take(MAPS).map(one).collect()
}

/// The frequencies within the tolerance of the drive's speed.
pub(super) fn speed(problem: &Problem, design: &Design) -> Option<[f64; 2]> {
    let width = half_width(problem, design, Parameter::Frequency)?;
    let own = design.frequency();
    Some([own - width, own + width])
}

/// What is traded for what is sought.
const TRADED: [Figure; 3] = [Figure::Share, Figure::StopForce, Figure::DrivePower];

pub(super) fn fronts(problem: &Problem, outcome: &Outcome) -> Vec<data::Front> {
    let sought = problem.objective.figure;
    let machine = &problem.machine;
    let label = |figure: Figure| Label::new(figure.meaning(), "", machine.unit(figure.dimension()));
    let own = |figure: Figure, value: f64| machine.to_own(figure.dimension(), value);
    let traded = TRADED.into_iter().filter(|figure| *figure != sought);
    let told = |Front { figure, points }: Front| {
        let place = |(x, y): &(f64, f64)| [own(figure, *x), own(sought, *y)];
        let at = match figure {
            Figure::Share => Some(outcome.design.place.min(1.0 - outcome.design.place)),
            _ => outcome.design.judged().ok().map(|it| it.value(figure)),
        };
        data::Front {
            title: format!("{} against {}", sought.meaning(), figure.meaning()),
            x: label(figure),
            y: label(sought),
            points: points.iter().map(place).collect(),
            design: at.map(|at| place(&(at, outcome.design.value))),
        }
    };
    let found = traded.map(|figure| front(problem, (&outcome.unit, &outcome.design), figure));
    found.filter(|it| it.points.len() > 2).map(told).collect()
}

pub(super) fn histogram(machine: &Machine, study: &Study) -> data::Histogram {
    let bins = study.verdict.histogram(BARS);
    let own = |value: f64| machine.to_own(Dimension::Velocity, value);
    let ends = [bins.first().map(|it| it.low), bins.last().map(|it| it.high)];
    data::Histogram {
        x: Label::new(
            "before-impact velocity",
            "",
            machine.unit(Dimension::Velocity),
        ),
        range: ends.map(|end| own(end.unwrap_or(0.0))),
        counts: bins.iter().map(|it| it.machines as u64).collect(),
        nominal: own(study.nominal),
        worst: study
            .verdict
            .slowest
            .as_ref()
            .map(|(_, it)| own(it.velocity)),
        samples: study.verdict.machines as u64,
        lost: study.verdict.lost as u64,
    }
}

pub(super) fn erosion(
    problem: &Problem,
    outcome: &Outcome,
    profile: &ErosionProfile,
) -> data::Erosion {
    let machine = &outcome.design.machine;
    let point = |it: &Integrity| data::ErosionPoint {
        place: it.place,
        frequency: machine.to_own(Dimension::Frequency, it.frequency),
        share: it.certainty.share,
        interval: it.certainty.interval,
        integrity: Some(it.radius),
    };
    let required = problem
        .requirements
        .iter()
        .find(|it| it.figure == Figure::Certainty);
    let ends = |dimension, ends: [f64; 2]| {
        let [low, high] = ends.map(|end| number(machine.to_own(dimension, end)));
        format!("{low} to {high} {}", machine.unit(dimension))
            .trim_end()
            .to_owned()
    };
    let region = &profile.region;
    data::Erosion {
        points: profile.places.iter().map(point).collect(),
        design: Some(outcome.design.place),
        required: required.and_then(|it| it.least),
        starts: format!(
            "{EROSION_STARTS} starts in the box that all commands take: positions {}, velocities {}",
            ends(Dimension::Length, region.position),
            ends(Dimension::Velocity, region.velocity)
        ),
    }
}

pub(super) fn run_up(machine: &Machine, attempt: &Attempt) -> data::RunUp {
    let angle = attempt.angle.filter(|_| attempt.share < 1.0);
    let note = match (attempt.way, angle, attempt.lost) {
        (Way::SwitchedOn, Some(angle), _) if attempt.share > 0.0 => format!(
            "from {:.0} % of the drive angles, best at {angle:.2} rad",
            100.0 * attempt.share
        ),
        (Way::SwitchedOn, ..) => String::new(),
        (way, _, Some(lost)) => match way.changes() {
            Some(parameter) => {
                let dimension = parameter.about().dimension;
                format!("z = 1 is lost at {}", told(machine, dimension, lost))
            }
            None => String::new(),
        },
        _ => match &attempt.ends {
            Some(motion) if attempt.share < 1.0 => format!("ends in {motion}"),
            _ => String::new(),
        },
    };
    data::RunUp {
        way: attempt.way.name().to_owned(),
        succeeds: attempt.share == 1.0,
        note,
    }
}

/// What each tolerance does to the velocity.
pub(super) fn sensitivities(machine: &Machine, study: &Study) -> Vec<data::Sensitivity> {
    let one = |(index, it): (usize, &Tolerance)| {
        let about = it.parameter.about();
        let own = |value: f64| match it.parameter {
            Parameter::Preload if machine.preload_deflection.is_some() => value,
            _ => machine.to_own(about.dimension, value),
        };
        let index_of = |all: &Scatter| all.velocity[index];
        let shares = study.scatter.as_ref().map(index_of);
        data::Sensitivity {
            label: Label::new(about.meaning, "", machine.unit(about.dimension)),
            value: machine.value(it.parameter).unwrap_or(f64::NAN),
            tolerance: own(it.half_width),
            effect: machine.to_own(Dimension::Velocity, study.sensitivities.velocity[index]),
            effect_unit: machine.unit(Dimension::Velocity).to_owned(),
            share: shares.map(|it| it.first.value),
            total: shares.map(|it| it.total.value),
        }
    };
    study.tolerances.iter().enumerate().map(one).collect()
}
