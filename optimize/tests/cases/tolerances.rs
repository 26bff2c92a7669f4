//! Designs with tolerances in every case: derivatives, the worst machines, and what holds in each.

use std::slice;

use approx::assert_relative_eq;
use softstop::{Machine, Parameter};
use softstop_dynamics::figure::{Figure, Sense};
use softstop_optimize::design::critical::CriticalMachines;
use softstop_optimize::design::problem::{Objective, Tolerance, Width};
use softstop_optimize::design::requirement::{Requirement, Scope};
use softstop_optimize::design::search::{SearchSettings, Unmonitored, search};
use softstop_optimize::design::space::{Axis, Interval};
use softstop_optimize::design::{Design, Problem};
use softstop_optimize::robust::{self, FITTED, verify, verify_in_cases, worst};
use softstop_testing::docs;

use super::case;
use crate::Outcome;
use crate::gradients::{at, compare};

/// The press of the guide with tolerances and two cases, over stiffness and clearance of its stop.
fn press(objective: Objective) -> Outcome<Problem> {
    let machine = Machine::from_toml(&std::fs::read_to_string(docs("press/press.toml"))?)?;
    let axis = |(parameter, low, high)| Axis::new(parameter, Interval { low, high });
    let axes = [
        (Parameter::StopStiffness, 5e6, 8e7),
        (Parameter::Clearance, 5e-3, 40e-3),
    ];
    let share = |(parameter, share)| Tolerance::new(parameter, Width::Share(share));
    let tolerances = [
        (Parameter::StopStiffness, 0.03),
        (Parameter::Damping, 0.1),
        (Parameter::Frequency, 0.003),
    ];
    let problem = Problem {
        tolerances: tolerances.map(share).to_vec(),
        requirements: vec![Requirement::at_most(Figure::StopForce, 5e5)],
        objective,
        frequency: Interval::new(10.0, 40.0),
        ..Problem::of(machine, axes.map(axis).to_vec())
    };
    let cases = vec![
        case(&problem, (Parameter::Damping, 1.2), 0.5),
        case(&problem, (Parameter::PiercingFriction, 0.9), 1.0),
    ];
    Ok(Problem { cases, ..problem })
}

/// Scores and constraints of all operating points have the derivatives of differences.
#[test]
fn derivatives_are_those_of_differences() -> Outcome {
    for sense in [Sense::Least, Sense::Most] {
        let objective = Objective::new(Figure::ImpactEnergy, sense);
        // A bound of 0 would have a unit that changes.
        let problem = Problem {
            margin: 0.1,
            ..press(objective)?
        };
        let (known, here) = (CriticalMachines::default(), [0.15, 0.35, 0.45]);
        let found = at(&problem, &known, &here).ok_or("a motion")?;
        assert_eq!(found.scores.len(), 3);
        for index in 0..3 {
            let count = compare(&problem, &known, &here, index)?;
            assert!(count > Some(15), "{count:?}");
        }
    }
    Ok(())
}

/// Of the worst machines: each case has that of its own, the mean is theirs, and no machine of any case loses the motion or
/// violates the bound; each is counted as by itself.
#[test]
fn tolerances_hold_in_every_case() -> Outcome {
    let objective = Objective {
        scope: Scope::Tolerances,
        ..Objective::default()
    };
    let problem = press(objective)?;
    let found = search(
        &problem,
        SearchSettings { evaluations: 100 },
        &Unmonitored,
        None,
    )?;
    let design = &found.design;
    let problems = [&problem].into_iter().cloned().chain(problem.in_cases());
    let problems: Vec<Problem> = problems.collect();
    let points = slice::from_ref(design).iter().chain(&design.cases);
    let points: Vec<(&Problem, &Design)> = problems.iter().zip(points).collect();
    let settings = robust::VerifySettings::of_machines(1 << 12);
    let settings = (settings, &problem.requirements[..]);
    let unmonitored = &softstop_dynamics::monitor::unmonitored;
    let drawn = problem.drawn(design).ok_or("tolerances")?;
    let together = verify_in_cases(&drawn, settings, unmonitored)?;
    assert_eq!((together.machines, together.rejected), (1 << 12, 0));
    for (index, (problem, design)) in points.iter().enumerate() {
        let spread = problem.spread(&design.machine).ok_or("tolerances")?;
        let figures = [
            (Figure::Velocity, Sense::Least),
            (Figure::StopForce, Sense::Most),
        ];
        let found = worst(&spread, &design.orbit, &figures, unmonitored)?;
        assert_relative_eq!(found[0].value, design.value, max_relative = 1e-9);
        assert!(found[1].value <= 5e5 * (1.0 + 1e-9));
        let alone = verify(&spread.over(FITTED), &design.orbit, settings, unmonitored)?;
        assert_eq!((alone.drawing.lost, alone.rejected), (0, 0));
        if let Some(case) = index.checked_sub(1) {
            let case = &together.cases[case];
            let slowest = alone.drawing.slowest;
            assert_eq!(case.slowest.to_bits(), slowest.to_bits());
        }
    }
    let mean = (points[0].1.value + 0.5 * points[1].1.value + points[2].1.value) / 2.5;
    assert_relative_eq!(problem.sought_of(design), mean, max_relative = 1e-14);
    // Without levels of each case the mean of the worst would not be the best: that of the drawings has less of it.
    let mut nominal = problem.clone();
    nominal.objective.scope = Scope::Drawing;
    let other = search(
        &nominal,
        SearchSettings { evaluations: 100 },
        &Unmonitored,
        None,
    )?
    .design;
    let mut least = Vec::new();
    let others = slice::from_ref(&other).iter().chain(&other.cases);
    for (problem, design) in problems.iter().zip(others) {
        let spread = problem.spread(&design.machine).ok_or("tolerances")?;
        let figures = [(Figure::Velocity, Sense::Least)];
        least.push(worst(&spread, &design.orbit, &figures, unmonitored)?[0].value);
    }
    let other = (least[0] + 0.5 * least[1] + least[2]) / 2.5;
    assert!(other <= mean * (1.0 + 1e-6), "{other} {mean}");
    Ok(())
}
