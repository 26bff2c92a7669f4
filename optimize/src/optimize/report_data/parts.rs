//! Sections of the report's data, each from what a run has found of it.

use softstop::{Dimension, Machine, Parameter};
use softstop_dynamics::basin::{ErosionProfile, Integrity};
use softstop_dynamics::run_up::{Attempt, Way};

use crate::design::Design;
use crate::design::figure::Figure;
use crate::design::problem::Problem;
use crate::design::space::Axis;
use crate::design::trial::STARTS;
use crate::optimize::outcome::Outcome;
use crate::optimize::study::Study;
use crate::page::computed::{label_of, map};
use crate::page::data::{self, Label};
use crate::page::quantity;
use crate::robust::{Scatter, Tolerance, Tolerances};
use crate::tolerated::half_width;

/// Maps at most.
const MAPS: usize = 2;
/// Bars of the histogram.
const BARS: usize = 40;

/// A value with its unit.
pub(super) fn format_quantity(machine: &Machine, dimension: Dimension, value: f64) -> String {
    let own = machine.to_own(dimension, value);
    quantity(own, machine.unit(dimension))
}

/// Half-width of the tolerance of a parameter, in the machine's own units.
fn half_width_of(problem: &Problem, design: &Design, parameter: Parameter) -> Option<f64> {
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
            [Parameter::Frequency, axis.parameter].map(|it| half_width_of(problem, design, it));
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
    let width = half_width_of(problem, design, Parameter::Frequency)?;
    let own = design.frequency();
    Some([own - width, own + width])
}

pub(super) fn fronts(problem: &Problem, outcome: &Outcome) -> Vec<data::Front> {
    let sought = problem.objective.figure;
    let machine = &problem.machine;
    let label = |figure: Figure| Label::new(figure.meaning(), "", machine.unit(figure.dimension()));
    let own = |figure: Figure, value: f64| machine.to_own(figure.dimension(), value);
    let all = outcome.fronts.iter();
    all.map(|it| {
        let figure = it.figure;
        let place = |(x, y): &(f64, f64)| [own(figure, *x), own(sought, *y)];
        data::Front {
            name: figure.name().to_owned(),
            title: format!("{} against {}", sought.meaning(), figure.meaning()),
            x: label(figure),
            y: label(sought),
            points: it.points.iter().map(place).collect(),
            design: Some(place(&it.design)),
            note: it.note(),
        }
    })
    .collect()
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
        worst: Some(own(study.slowest())),
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
        let [low, high] = ends.map(|end| machine.to_own(dimension, end));
        let (low, high) = (quantity(low, ""), quantity(high, machine.unit(dimension)));
        format!("{low} to {high}")
    };
    let region = &profile.region;
    let widened = match profile.widened {
        true => ", made wider to hold all motions of the zone",
        false => "",
    };
    data::Erosion {
        points: profile.places.iter().map(point).collect(),
        design: Some(outcome.design.place),
        required: required.and_then(|it| it.least),
        starts: format!(
            "{STARTS} at each place, in the box of requirements and basin{widened}: positions {}, velocities {}",
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
        (Way::SwitchedOn, ..) if attempt.share == 0.0 => "from no drive angle".to_owned(),
        (Way::SwitchedOn, ..) => String::new(),
        (way, _, Some(lost)) => match way.changes() {
            Some(parameter) => {
                let dimension = parameter.about().dimension;
                format!(
                    "z = 1 is lost at {}",
                    format_quantity(machine, dimension, lost)
                )
            }
            None => String::new(),
        },
        _ => match &attempt.ends {
            Some(motion) if attempt.share < 1.0 => format!("ends in {motion}"),
            _ => begun(machine, attempt),
        },
    };
    data::RunUp {
        way: attempt.way.name().to_owned(),
        succeeds: attempt.share == 1.0,
        note,
    }
}

/// Corners of tolerances that are looked at: all of as many tolerances as this power of two, an even choice of more.
const CORNERS: u32 = 6;

/// Machines at corners of the tolerances but that of the drive's frequency.
pub(super) fn corners(machine: &Machine, study: &Study) -> Vec<Machine> {
    let is_kept = |it: &&Tolerance| it.parameter != Parameter::Frequency;
    let all: Vec<Tolerance> = study.tolerances.iter().filter(is_kept).copied().collect();
    let Ok(spread) = Tolerances::new(machine, &all) else {
        return Vec::new();
    };
    // Each tolerance changes its side with the parity of its own bits of the corner's number (Walsh).
    let mut bits: Vec<u32> = (1..1 << CORNERS).collect();
    bits.sort_by_key(|bits| bits.count_ones());
    let side = |corner: u32, bits: &u32| match (corner & bits).count_ones() % 2 {
        0 => 1.0,
        _ => -1.0,
    };
    let place = |corner| {
        let sides = bits.iter().take(all.len()).map(|bits| side(corner, bits));
        sides.collect::<Vec<f64>>()
    };
    let count = CORNERS.min(all.len() as u32);
    let machines = (0..1 << count).map(|corner| spread.machine(&place(corner)));
    machines.filter(|_| !all.is_empty()).collect()
}

/// Where a slow way begins.
fn begun(machine: &Machine, attempt: &Attempt) -> String {
    let changes = attempt.way.changes().zip(attempt.from);
    changes.map_or_else(String::new, |(parameter, from)| {
        format!(
            "begun at {}",
            format_quantity(machine, parameter.about().dimension, from)
        )
    })
}

/// What each tolerance does to the velocity.
pub(super) fn sensitivities(machine: &Machine, study: &Study) -> Vec<data::Sensitivity> {
    let one = |(index, it): (usize, &Tolerance)| {
        let scatter: Option<&Scatter> = study.scatter.as_ref();
        let shares = scatter.map(|all| all.velocity[index]);
        data::Sensitivity {
            label: label_of(machine, it.parameter),
            value: machine.value(it.parameter).unwrap_or(f64::NAN),
            tolerance: half_width(machine, it),
            effect: machine.to_own(Dimension::Velocity, study.sensitivities.velocity[index]),
            effect_unit: machine.unit(Dimension::Velocity).to_owned(),
            share: shares.map(|it| it.first.value),
            total: shares.map(|it| it.total.value),
            margin: scatter.map(|all| all.place[index].total.value),
        }
    };
    study.tolerances.iter().enumerate().map(one).collect()
}
