//! The derivatives of the gradient stage against central differences, over random designs.

use proptest::prelude::*;
use softstop::internals::Expression;
use softstop::{Machine, Parameter};
use softstop_optimize::design::Problem;
use softstop_optimize::design::cost::{Cost, Term};
use softstop_optimize::design::critical::{Criterion, CriticalMachines, ExtremeMachine};
use softstop_optimize::design::figure::{Figure, Sense};
use softstop_optimize::design::local::{LocalModel, local};
use softstop_optimize::design::operating_point::SearchPoint;
use softstop_optimize::design::problem::{Tolerance, Width};
use softstop_optimize::design::requirement::Requirement;
use softstop_optimize::design::slope::Slope;
use softstop_optimize::design::space::{Axis, Interval};
use softstop_testing::random::cases;

use crate::best::PRESS;

/// What is looked at: the figures that have exact derivatives.
const FIGURES: &[Figure] = &[
    Figure::Velocity,
    Figure::ImpactEnergy,
    Figure::ImpactPower,
    Figure::DriveForce,
    Figure::DrivePower,
    Figure::MaxPosition,
    Figure::Stroke,
    Figure::StopForce,
    Figure::StopDeflection,
    Figure::Cost,
    Figure::FrequencyG0,
    Figure::FrequencySn,
    Figure::FrequencyPd,
];

/// The paper's machines, a press in SI units, a soft stop, one with parameters that follow others, an unbalanced drive; all
/// parameters that may be searched.
fn machines() -> Vec<Machine> {
    let mut soft = Machine::named("unloaded").expect("the paper's machine");
    let model = [("stop.model", "kelvinVoigt"), ("stop.stiffness", "20")];
    soft.apply(model).expect("a soft stop");
    let mut tied = Machine::named("unloaded").expect("the paper's machine");
    let ties = [
        ("stop.preload", "26.5 * stop.stiffness^0.5"),
        ("contact.damping", "0.0009 * rho^2"),
    ];
    tied.apply(ties).expect("parameters that follow others");
    let unbalance = "mass = 2.0\nstiffness = 3.0\ndamping = 0.1\nclearance = 3.0\n\
                     contact.damping = \"0.3 * excitation.frequency\"\n[excitation]\n\
                     amplitude = \"0.4 * mass * excitation.frequency^2\"\nfrequency = 1.4\n[stop]\n\
                     model = \"preloaded\"\nstiffness = \"40 + 5 * excitation.frequency\"\npreload_deflection = 0.2\n";
    vec![
        Machine::named("unloaded").expect("the paper's machine"),
        Machine::named("loaded").expect("the paper's machine"),
        Machine::from_toml(PRESS).expect("a press"),
        soft,
        tied,
        Machine::from_toml(unbalance).expect("an unbalanced drive"),
    ]
}

/// A cost over figures, parameters, and the preload as the machine states it.
fn cost(machine: &Machine) -> Option<Cost> {
    let formula = "2 + velocity^2 / stop.stiffness + sqrt(max(stop_force, drive_power)) * clearance + \
                   0.1 * contact.damping^0.5 / excitation.frequency";
    let preload = machine.value(Parameter::Preload);
    let preload = preload.map(|value| format!(" + {} / {value}", machine.name(Parameter::Preload)));
    let formula = formula.to_owned() + &preload.unwrap_or_default();
    let expression = Expression::parse(&formula).ok()?;
    let terms = expression.names().iter();
    let terms = terms
        .map(|name| Term::named(machine, name))
        .collect::<Option<Vec<_>>>()?;
    Some(Cost::new(&formula, expression, terms))
}

/// Each axis from 0.8 to 1.25 of the machine's value.
fn problem(machine: Machine) -> Problem {
    let searched = [
        Parameter::Mass,
        Parameter::Suspension,
        Parameter::Damping,
        Parameter::Amplitude,
        Parameter::Clearance,
        Parameter::ContactDamping,
        Parameter::StopStiffness,
        Parameter::Preload,
        Parameter::PiercingStiffness,
        Parameter::Thickness,
    ];
    let axis = |parameter: Parameter| {
        let (value, follows) = (machine.value(parameter)?, machine.expression(parameter));
        if value == 0.0 || follows.is_some() {
            return None;
        }
        let range = Interval::new(0.8 * value, 1.25 * value);
        Some(Axis::new(parameter, range))
    };
    let axes = searched.into_iter().filter_map(axis).collect();
    let unit = |figure: Figure| match figure {
        Figure::FrequencyG0 | Figure::FrequencySn | Figure::FrequencyPd => {
            machine.scene.excitation.frequency
        }
        _ => 1.0,
    };
    let requirement = |figure| Requirement::at_least(figure, unit(figure));
    let requirements = FIGURES.iter().copied().map(requirement).collect();
    let cost = cost(&machine).expect("a cost");
    Problem {
        requirements,
        cost: Some(cost),
        ..Problem::of(machine, axes)
    }
}

/// What cannot be made exactly; with that of the speed the box reaches beyond the fold.
fn tolerances() -> Vec<Tolerance> {
    let share = |(parameter, share)| Tolerance::new(parameter, Width::Share(share));
    [
        (Parameter::Clearance, 0.005),
        (Parameter::Damping, 0.02),
        (Parameter::StopStiffness, 0.01),
        (Parameter::Frequency, 0.3),
    ]
    .map(share)
    .to_vec()
}

/// A direction to the fold, and machines that are extreme in a figure.
fn known() -> CriticalMachines {
    let extreme = |figure: &Figure| ExtremeMachine {
        target: Criterion::Bound(*figure, Sense::Least),
        at: vec![1.0, -1.0, 0.7, 0.02],
    };
    CriticalMachines {
        losses: vec![vec![0.6, -0.3, 0.2, 1.0]],
        extremes: FIGURES[..9].iter().map(extreme).collect(),
        ..CriticalMachines::default()
    }
}

/// What is known at the coordinates of a search, the place last.
pub(crate) fn at(
    problem: &Problem,
    known: &CriticalMachines,
    coordinates: &[f64],
) -> Option<LocalModel> {
    let (place, unit) = coordinates.split_last()?;
    let moved: Vec<usize> = (0..unit.len()).collect();
    let at = SearchPoint {
        unit,
        moved: &moved,
        place: Some(*place),
    };
    local(problem, &at, known)
}

/// Steps of the differences, in edges of the cube.
const STEPS: [f64; 2] = [2e-4, 1e-4];

/// The objective, the scores of all operating points and the constraints.
fn all(problem: &Problem, known: &CriticalMachines, coordinates: &[f64]) -> Option<Vec<Slope>> {
    let found = at(problem, known, coordinates)?;
    let objective = [found.objective(&problem.objective)].into_iter();
    let scores = found.scores.into_iter().map(|it| it.own);
    let constraints = found.constraints.into_iter().map(|it| it.slope);
    Some(objective.chain(scores).chain(constraints).collect())
}

/// Central differences of the fourth order by one coordinate, and how far those of the second order are from them.
fn differences(
    problem: &Problem,
    known: &CriticalMachines,
    coordinates: &[f64],
    index: usize,
) -> Option<Vec<(f64, f64)>> {
    let central = |step: f64| {
        let aside = |by: f64| {
            let mut coordinates = coordinates.to_vec();
            coordinates[index] += by;
            all(problem, known, &coordinates)
        };
        let (before, after) = (aside(-step)?, aside(step)?);
        let pairs = before.into_iter().zip(after);
        Some(
            pairs
                .map(|(before, after)| (after.value - before.value) / (2.0 * step))
                .collect::<Vec<f64>>(),
        )
    };
    let (wide, narrow) = (central(STEPS[0])?, central(STEPS[1])?);
    let pairs = wide.into_iter().zip(narrow);
    let fourth = |(wide, narrow): (f64, f64)| ((4.0 * narrow - wide) / 3.0, (wide - narrow).abs());
    Some(pairs.map(fourth).collect())
}

/// Whether all derivatives by a coordinate are those of differences; how many there are, none without a motion here or beside.
pub(crate) fn compare(
    problem: &Problem,
    known: &CriticalMachines,
    coordinates: &[f64],
    index: usize,
) -> Result<Option<usize>, String> {
    let found = all(problem, known, coordinates);
    let expected = differences(problem, known, coordinates, index);
    let Some((found, expected)) = found.zip(expected) else {
        return Ok(None);
    };
    let count = expected.len();
    for (number, (own, (expected, doubt))) in found.iter().zip(expected).enumerate() {
        let own_value = own.by[index];
        // What the differences themselves do not tell: where a figure has a kink, or rounding of the value.
        let size = own_value.abs().max(expected.abs()).max(own.value.abs());
        let is_held = doubt > 1e-3 * size || (own_value - expected).abs() <= 1e-6 * size;
        if !is_held {
            return Err(format!(
                "figure {number} by coordinate {index} of {coordinates:?}: {own_value} against {expected}"
            ));
        }
    }
    Ok(Some(count))
}

proptest! {
    #![proptest_config(cases(40))]

    #[test]
    fn derivatives_are_those_of_differences(
        which in 0..machines().len(),
        unit in prop::collection::vec(0.05..0.95f64, 10),
        place in 0.1..0.9f64,
        axis in 0..11usize,
    ) {
        let exact = problem(machines().swap_remove(which));
        let mut coordinates = unit[..exact.axes.len()].to_vec();
        coordinates.push(place);
        let index = axis % coordinates.len();
        let tolerated = Problem { tolerances: tolerances(), ..exact.clone() };
        let follows = !exact.machine.scene.followers.is_empty();
        let problems = [(exact, CriticalMachines::default()), (tolerated, known())];
        // Nothing has a tolerance where something follows the frequency.
        for (problem, known) in problems.into_iter().take(if follows { 1 } else { 2 }) {
            let held = compare(&problem, &known, &coordinates, index);
            held.map_err(|fault| TestCaseError::fail(format!("{which}: {fault}")))?;
        }
    }
}
