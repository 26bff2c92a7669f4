//! Fronts of designs: against all designs of a grid, against searches by one objective alone, and as files; what a design costs.

use softstop::internals::Expression;
use softstop::{Machine, Parameter};
use softstop_dynamics::zone;
use softstop_optimize::design::Problem;
use softstop_optimize::design::cost::{Cost, Term};
use softstop_optimize::design::figure::{Figure, Sense};
use softstop_optimize::design::judge::ZoneMotion;
use softstop_optimize::design::pareto::Pareto;
use softstop_optimize::design::problem::{Objective, Tolerance, Width};
use softstop_optimize::design::requirement::{Requirement, Scope};
use softstop_optimize::design::search::{SearchSettings, Unmonitored, search};
use softstop_optimize::design::space::{Axis, Interval};
use softstop_optimize::robust::Distribution;

use crate::grid::of_designs;
use crate::{Outcome, SOFTSTOP};

const SETTINGS: SearchSettings = SearchSettings { evaluations: 400 };

const fn objective(figure: Figure, sense: Sense) -> Objective {
    Objective::new(figure, sense)
}

/// The paper's unloaded machine with a softer stop, whose clearance and frequency are searched.
fn problem(traded: Vec<Objective>) -> Outcome<Problem> {
    let mut machine = Machine::named("unloaded").ok_or("the paper's machine")?;
    machine.set(Parameter::StopStiffness, 7.0);
    let (low, high) = (4.0, 20.0);
    let axes = vec![Axis::new(Parameter::Clearance, Interval { low, high })];
    Ok(Problem {
        margin: 0.1,
        traded,
        requirements: vec![Requirement::at_most(Figure::MaxPosition, 13.0)],
        ..Problem::of(machine, axes)
    })
}

fn front(problem: &Problem) -> Outcome<Pareto> {
    let found = search(problem, SETTINGS, &Unmonitored, None)?;
    Ok(Pareto::search(problem, &found, (SETTINGS, &Unmonitored))?)
}

/// Values by their good side: the more the better.
fn graded(objectives: &[Objective], values: &[f64]) -> Vec<f64> {
    let pairs = objectives.iter().zip(values);
    let graded = pairs.map(|(it, value)| match it.sense {
        Sense::Least => *value,
        Sense::Most => -value,
    });
    graded.collect()
}

/// Each point is as required when it is computed anew, has the values that are stated, and none dominates another one.
fn is_front(problem: &Problem, front: &Pareto) -> Outcome {
    for point in &front.points {
        let machine = &point.found.design.machine;
        let zone = zone::hysteresis(&machine.scene)?;
        let width = zone.high.frequency - zone.low.frequency;
        let place = (machine.scene.excitation.frequency - zone.low.frequency) / width;
        let orbit = zone.orbit_of(&zone.point_at(place)?)?;
        let motion = ZoneMotion::new(machine, &zone, place, &orbit)?;
        assert!(place > problem.margin - 1e-7 && place < 1.0 - problem.margin + 1e-7);
        for met in problem.met(&motion) {
            let bound = met
                .requirement
                .most
                .or(met.requirement.least)
                .ok_or("a bound")?;
            assert!(
                met.requirement.margin(met.value) > -1e-7 * bound.abs(),
                "{met:?}"
            );
        }
        for (objective, value) in front.objectives.iter().zip(&point.values) {
            let own = problem.value(&motion, objective.figure);
            assert!((own - value).abs() < 1e-7 * value.abs(), "{own} {value}");
        }
    }
    let grades = front
        .points
        .iter()
        .map(|it| graded(&front.objectives, &it.values));
    let grades: Vec<Vec<f64>> = grades.collect();
    for (index, one) in grades.iter().enumerate() {
        for (other_index, other) in grades.iter().enumerate() {
            let is_better = other.iter().zip(one).all(|(other, one)| other >= one);
            assert!(index == other_index || !is_better, "{one:?} {other:?}");
        }
    }
    Ok(())
}

#[test]
fn no_design_of_a_grid_is_better_than_a_front() -> Outcome {
    let problem = problem(vec![objective(Figure::StopForce, Sense::Most)])?;
    let front = front(&problem)?;
    assert!(front.points.len() >= 10, "{:?}", front.tally);
    is_front(&problem, &front)?;
    let grid = of_designs(&problem, (161, 81), |it| {
        let (motion, objectives) = (it.judged().ok()?, problem.objectives());
        let values = objectives.iter();
        let values = values.map(|it| problem.value(&motion, it.figure));
        Some(graded(&objectives, &values.collect::<Vec<f64>>()))
    });
    assert!(grid.len() > 5000, "{}", grid.len());
    for point in &front.points {
        let own = graded(&front.objectives, &point.values);
        let is_better = |it: &&Vec<f64>| {
            let mut pairs = it.iter().zip(&own);
            pairs.all(|(it, own)| *it > own + 1e-3 * own.abs())
        };
        assert_eq!(grid.iter().find(is_better), None, "{own:?}");
    }
    Ok(())
}

#[test]
fn the_ends_of_a_front_are_the_designs_by_each_objective_alone() -> Outcome {
    let power = objective(Figure::DrivePower, Sense::Most);
    let of_two = problem(vec![power])?;
    let found = front(&of_two)?;
    is_front(&of_two, &found)?;
    let of_three = problem(vec![power, objective(Figure::StopForce, Sense::Most)])?;
    let three = front(&of_three)?;
    is_front(&of_three, &three)?;
    for (index, objective) in three.objectives.iter().enumerate() {
        let alone = Problem {
            objective: *objective,
            ..problem(Vec::new())?
        };
        let best = search(&alone, SETTINGS, &Unmonitored, None)?.design.value;
        for (front, has_it) in [(&found, index < 2), (&three, true)] {
            let values = front.points.iter().filter_map(|it| it.values.get(index));
            let best_of_front = match objective.sense {
                Sense::Least => values.copied().fold(f64::NEG_INFINITY, f64::max),
                Sense::Most => values.copied().fold(f64::INFINITY, f64::min),
            };
            let is_same = (best_of_front - best).abs() < 1e-4 * best.abs();
            assert!(is_same || !has_it, "{objective:?}: {best_of_front} {best}");
        }
    }
    Ok(())
}

/// What a search by one of three objectives finds with bounds of the others, a design of their front has nearly.
#[test]
fn a_front_of_three_leaves_no_gap_in_which_single_searches_find_designs() -> Outcome {
    let traded = vec![
        objective(Figure::FrequencySn, Sense::Least),
        objective(Figure::StopForce, Sense::Most),
    ];
    let of_three = Problem {
        margin: 0.25,
        requirements: Vec::new(),
        axes: vec![
            Axis::new(Parameter::Clearance, Interval::new(4.0, 20.0)),
            Axis::new(Parameter::Damping, Interval::new(0.02, 0.1)),
        ],
        ..problem(traded)?
    };
    let front = front(&of_three)?;
    is_front(&of_three, &front)?;
    let range = |index: usize| {
        let values = || front.points.iter().map(|it| it.values[index]);
        let low = values().fold(f64::INFINITY, f64::min);
        (low, values().fold(f64::NEG_INFINITY, f64::max))
    };
    for share in [0.1, 0.2, 0.3, 0.5, 0.7, 0.9] {
        let (low, high) = range(0);
        let bound = low + share * (high - low);
        let softest = Problem {
            objective: objective(Figure::StopForce, Sense::Most),
            traded: Vec::new(),
            requirements: vec![Requirement::at_least(Figure::Velocity, bound)],
            ..of_three.clone()
        };
        let best = search(&softest, SETTINGS, &Unmonitored, None)?.design.value;
        let (least, most) = range(2);
        let is_beside = |values: &[f64]| {
            (values[0] - bound).abs() < 0.12 * (high - low)
                && values[2] - best < 0.15 * (most - least)
        };
        let all = front.points.iter().map(|it| &it.values);
        assert!(
            all.clone().any(|it| is_beside(it)),
            "{bound} {best}: {:?}",
            all.collect::<Vec<_>>()
        );
    }
    Ok(())
}

#[test]
fn designs_of_a_front_keep_their_tolerances() -> Outcome {
    let worst = |figure, sense| Objective {
        scope: Scope::Tolerances,
        ..objective(figure, sense)
    };
    let share = |parameter, share| Tolerance {
        parameter,
        width: Width::Share(share),
        distribution: Distribution::Box,
    };
    let problem = Problem {
        margin: 0.0,
        objective: worst(Figure::Velocity, Sense::Least),
        tolerances: vec![
            share(Parameter::Clearance, 0.01),
            share(Parameter::Damping, 0.1),
        ],
        ..problem(vec![worst(Figure::StopForce, Sense::Most)])?
    };
    let front = front(&problem)?;
    assert!(front.points.len() >= 5, "{:?}", front.tally);
    for point in &front.points {
        let design = &point.found.design;
        assert_eq!(problem.has_box(design), Ok(()));
        let spread = problem.spread(&design.machine).ok_or("tolerances")?;
        let motion = design.judged()?;
        // The worst machine is worse than the drawing.
        assert!(point.values[0] < motion.value(Figure::Velocity));
        assert!(point.values[1] > motion.value(Figure::StopForce));
        assert_eq!(spread.all().len(), 2);
    }
    Ok(())
}

#[test]
fn a_cost_is_the_value_of_its_formula() -> Outcome {
    let text = "name = \"a\"\nmass = 2.0\nstiffness = 2e4\ndamping = 8.0\nclearance = 0.004\ncontact.damping = 20.0\n\
                excitation = { amplitude = 30.0, frequency_hz = 20.0 }\n\
                stop = { model = \"preloaded\", stiffness = 6e4, preload_deflection = 0.002 }\n";
    let machine = Machine::from_toml(text)?;
    let formula = "120 + 3e-5 * stop.stiffness + excitation.frequency_hz * stop.preload_deflection";
    let expression = Expression::parse(formula)?;
    let term = |name: &String| Term::named(&machine, name);
    let terms = expression.names().iter().map(term);
    let terms: Option<Vec<_>> = terms.collect();
    let cost = Cost::new(formula, expression, terms.ok_or("names")?);
    let zone = zone::hysteresis(&machine.scene)?;
    let orbit = zone.orbit_of(&zone.point_at(0.5)?)?;
    let motion = ZoneMotion::new(&machine, &zone, 0.5, &orbit)?;
    let hertz = orbit.scene.excitation.frequency / std::f64::consts::TAU;
    let expected = 120.0 + 1.8 + hertz * 0.002;
    let value = cost.value(motion.orbit, &motion.stroke);
    assert!(
        (value - expected).abs() < 1e-12 * expected,
        "{value} {expected}"
    );
    for name in [
        "cost",
        "certainty",
        "margin",
        "nowhere",
        "excitation.nowhere",
    ] {
        assert_eq!(Term::named(&machine, name), None, "{name}");
    }
    Ok(())
}

/// A front of a task with a cost, as a user states it, and its files.
#[test]
fn a_front_is_written_as_table_and_picture() -> Outcome {
    let task = "machine = \"unloaded\"\n[vary]\nstop.stiffness = 7.0\nclearance = [4, 20]\n[objective]\nmaximise = [\"velocity\"]\n\
         minimise = [\"cost\"]\ncost = \"10 + clearance^2 / 10 + 0.1 * stop_force\"\n[require]\ncost = 40\n";
    let report = SOFTSTOP.report_of("task.toml", task, "optimize --config FILE --no-report");
    let points = report.list("pareto/points");
    assert!(points.len() >= 8, "{points:?}");
    for point in points {
        let number = |key: &str| point[key].as_f64().ok_or(format!("{key} of {point}"));
        let clearance = number("clearance")?;
        let cost = 10.0 + clearance * clearance / 10.0 + 0.1 * number("stop_force")?;
        assert!((number("cost")? - cost).abs() < 1e-9 * cost && cost <= 40.0 + 1e-7);
    }
    let first = points.first().ok_or("a first")?;
    assert_eq!(&first["velocity"], report.at("objective/value"));
    let table = report.text("pareto.csv");
    assert_eq!(table.lines().count(), points.len() + 1);
    assert!(table.starts_with("number,velocity,cost,"));
    assert!(report.text("pareto.svg").contains("nearest to the best"));
    Ok(())
}
