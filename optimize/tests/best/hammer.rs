//! The best hammer of `hammer.toml`, on the drawing and as all are built.

use softstop::{Machine, Parameter};
use softstop_optimize::design::constraint::{ActiveLimit, Limit};
use softstop_optimize::design::figure::{Figure, Sense};
use softstop_optimize::design::problem::{Link, Objective, Tolerance, Width};
use softstop_optimize::design::requirement::{Requirement, Scope};
use softstop_optimize::design::search::{Unmonitored, search};
use softstop_optimize::design::solution::{SideTasks, Solution};
use softstop_optimize::design::space::{Axis, Interval};
use softstop_optimize::design::{Design, Problem};

use super::random_task::HAMMER;
use super::{SETTINGS, assert_holds, contradictions};
use crate::Outcome;

/// The task of `hammer.toml`.
fn hammer(scope: Scope) -> Problem {
    let machine = Machine::from_toml(HAMMER).expect("a hammer");
    let range = |low, high| Interval { low, high };
    let catalogue = vec![3e4, 4.5e4, 6e4, 9e4, 1.2e5, 1.8e5];
    let own = |parameter, width| Tolerance::new(parameter, Width::Own(width));
    let share = |parameter, share| Tolerance::new(parameter, Width::Share(share));
    let most = |figure, most| Requirement {
        scope,
        ..Requirement::at_most(figure, most)
    };
    let least = |figure, least| Requirement {
        scope,
        ..Requirement::at_least(figure, least)
    };
    Problem {
        frequency: Interval::held(50.0),
        links: vec![Link {
            parameter: Parameter::ContactDamping,
            follows: Parameter::StopStiffness,
            factor: 2e-4,
            offset: 0.0,
        }],
        tolerances: vec![
            own(Parameter::Clearance, 1e-4),
            share(Parameter::StopStiffness, 0.03),
            share(Parameter::Suspension, 0.03),
            share(Parameter::Damping, 0.2),
            own(Parameter::Frequency, 0.2),
        ],
        objective: Objective::new(Figure::ImpactPower, Sense::Least),
        requirements: vec![
            most(Figure::StopForce, 400.0),
            most(Figure::Stroke, 0.03),
            least(Figure::Certainty, 0.5),
            least(Figure::RunUp, 1.0),
        ],
        ..Problem::of(
            machine,
            vec![
                Axis::new(Parameter::Clearance, range(0.5e-3, 8e-3)),
                Axis::new(Parameter::Suspension, range(4e3, 3e4)),
                Axis::of_catalogue(Parameter::StopStiffness, catalogue),
            ],
        )
    }
}

/// A differential evolution of ten thousand evaluations finds 115.205 W, one of more 115.206 W.
#[test]
fn the_best_hammer_of_the_drawing_is_found() -> Outcome {
    let problem = hammer(Scope::Drawing);
    let beside = SideTasks {
        relaxed: true,
        ..SideTasks::default()
    };
    let solution = Solution::of(&problem, SETTINGS, beside, (&Unmonitored, None))?;
    let design = &solution.found.design;
    assert!(
        (design.value / 115.206 - 1.0).abs() < 1e-5,
        "{}",
        design.value
    );
    assert!((design.before_impact_velocity() - 4.80012).abs() < 1e-5);
    assert_holds(&problem, design, 4096)?;
    assert!(contradictions(&problem, &solution).is_empty());
    Ok(())
}

/// The hammer as all are built: force and stroke bind in the worst machines.
#[test]
fn no_hammer_within_the_tolerances_violates_what_is_required() -> Outcome {
    let problem = hammer(Scope::Tolerances);
    let found = search(&problem, SETTINGS, &Unmonitored, None)?;
    assert!(found.residue < 1e-6, "{}", found.residue);
    assert_holds(&problem, &found.design, 1 << 16)?;
    let worst = problem.worst_of_required(&found.design);
    for (figure, bound) in [(Figure::StopForce, 400.0), (Figure::Stroke, 0.03)] {
        let own = worst.iter().find(|it| it.0 == figure).ok_or("a figure")?;
        let share = own.2.value / bound;
        assert!((share - 1.0).abs() < 1e-6, "{figure:?}: {share}");
        let limit = Limit::Required(figure, Sense::Most);
        let limit = ActiveLimit { limit, case: None };
        assert!(found.limits.contains(&limit), "{:?}", found.limits);
    }
    Ok(())
}

/// The worst machine of the design that is best in its own worst is better than that of the design which is best on the drawing.
#[test]
fn the_best_of_the_worst_machines_is_found() -> Outcome {
    let mut problem = hammer(Scope::Tolerances);
    problem.requirements.retain(|it| !it.figure.is_trial());
    let drawing = search(&problem, SETTINGS, &Unmonitored, None)?.design;
    problem.objective.scope = Scope::Tolerances;
    let design = search(&problem, SETTINGS, &Unmonitored, None)?.design;
    let power = Requirement::at_least(Figure::ImpactPower, 0.0);
    let with_power = Problem {
        requirements: vec![power],
        ..problem.clone()
    };
    let worst = |design: &Design| with_power.worst_of_required(design)[0].2.value;
    assert!(worst(&design) >= worst(&drawing) * (1.0 - 1e-6));
    assert!((worst(&design) / design.value - 1.0).abs() < 1e-6);
    assert_holds(&problem, &design, 4096)
}
