//! Designs with tolerances, catalogues and trials against everything that could be chosen instead.

use rayon::prelude::*;
use softstop::{Machine, Parameter};
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::zone;
use softstop_optimize::design::constraint::Limit;
use softstop_optimize::design::figure::Figure;
use softstop_optimize::design::judge::{RequirementValue, ZoneMotion};
use softstop_optimize::design::problem::{Tolerance, Width};
use softstop_optimize::design::requirement::Requirement;
use softstop_optimize::design::search::{
    SearchError, SearchResult, SearchSettings, Unmonitored, search,
};
use softstop_optimize::design::space::{Axis, Interval};
use softstop_optimize::design::{Design, Problem};
use softstop_optimize::robust::{self, Norm, nearest, verify};

use crate::Outcome;
use crate::grid::of_designs;

const SETTINGS: SearchSettings = SearchSettings { evaluations: 300 };

/// A machine whose hysteresis zone has a second pair of folds: above 1.364 a motion of more than twice the velocity.
fn two_folds() -> Outcome<Machine> {
    let mut machine = Machine::named("unloaded").ok_or("the paper's machine")?;
    machine.apply([
        ("stop.stiffness", "2"),
        ("preload_deflection", "10"),
        ("clearance", "2.5"),
        ("contact.damping", "0.02"),
    ])?;
    Ok(machine)
}

const CLEARANCE: Interval = Interval::new(2.3, 2.7);

/// Its hardest impact below a frequency just above that fold.
fn above_a_fold(width: f64) -> Outcome<Problem> {
    let share = |parameter, share: f64| Tolerance::new(parameter, Width::Share(share * width));
    Ok(Problem {
        frequency: Interval::new(1.2, 1.37),
        tolerances: vec![
            share(Parameter::Clearance, 0.01),
            share(Parameter::StopStiffness, 0.02),
            share(Parameter::Frequency, 0.002),
        ],
        ..Problem::of(
            two_folds()?,
            vec![Axis::new(Parameter::Clearance, CLEARANCE)],
        )
    })
}

/// How many of some machines all over the tolerances of a design lose the motion.
fn lost(problem: &Problem, design: &Design) -> Outcome<usize> {
    let spread = problem.spread(&design.machine).ok_or("tolerances")?;
    let some = robust::VerifySettings {
        machines: 4096,
        enough: usize::MAX,
        first: 0,
    };
    Ok(verify(&spread, &design.orbit, (some, &[]), &unmonitored)?
        .drawing
        .lost)
}

/// By how much all tolerances of a design may grow until the motion is lost; infinite beyond three times.
fn factor(problem: &Problem, design: &Design) -> Outcome<f64> {
    let spread = problem.spread(&design.machine).ok_or("tolerances")?;
    let found = nearest(&spread, &design.orbit, Norm::Box, 3.0, &unmonitored)?;
    Ok(found.first().map_or(f64::INFINITY, |it| it.distance))
}

#[test]
fn no_machine_is_lost_to_a_fold_inside_the_zone() -> Outcome {
    let problem = above_a_fold(1.0)?;
    let exact = Problem {
        tolerances: Vec::new(),
        ..problem.clone()
    };
    let without = search(&exact, SETTINGS, &Unmonitored, None)?.design;
    assert!(lost(&problem, &without)? > 400, "the search must give way");
    let SearchResult { design, limits, .. } = search(&problem, SETTINGS, &Unmonitored, None)?;
    assert_eq!(lost(&problem, &design)?, 0);
    let factor_of_design = factor(&problem, &design)?;
    assert!(factor_of_design > 1.0 - 1e-6, "{factor_of_design}");
    let is_loss = limits.iter().any(|it| it.limit == Limit::Loss);
    assert!(is_loss, "{limits:?}");
    assert_eq!(problem.border_within(&design).as_deref(), Some("fold"));
    let better = of_designs(&problem, (17, 35), |it| {
        (it.value > design.value * (1.0 + 1e-6)).then(|| it.clone())
    });
    for other in better {
        assert!(factor(&problem, &other)? < 1.0, "{other:?}");
    }
    Ok(())
}

#[test]
fn tolerances_that_no_design_has_are_told_with_how_much_is_lacking() -> Outcome {
    let mut problem = above_a_fold(4.0)?;
    problem.frequency.low = 1.366;
    problem.axes[0].range = Interval::new(2.49, 2.51);
    let found = search(&problem, SETTINGS, &Unmonitored, None);
    let Err(SearchError::NoDesign { reason, .. }) = found else {
        return Err(format!("{found:?}").into());
    };
    assert!(reason.contains("within the tolerances"), "{reason}");
    assert!(reason.contains("of them only"), "{reason}");
    Ok(())
}

#[test]
fn of_catalogues_the_best_of_all_combinations_is_found() -> Outcome {
    let machine = Machine::named("loaded").ok_or("the paper's machine")?;
    let stiffness = [3.0, 5.0, 7.0, 9.0, 12.0, 16.0, 21.0];
    let clearance = [5.0, 6.5, 8.0, 9.5, 11.0, 12.5, 14.0];
    let peak = Requirement::at_most(Figure::StopForce, 90.0);
    let problem = |stiffness: &[f64], clearance: &[f64]| Problem {
        margin: 0.1,
        requirements: vec![peak],
        ..Problem::of(
            machine.clone(),
            vec![
                Axis::of_catalogue(Parameter::StopStiffness, stiffness.to_vec()),
                Axis::of_catalogue(Parameter::Clearance, clearance.to_vec()),
            ],
        )
    };
    let few = SearchSettings { evaluations: 100 };
    let found = search(&problem(&stiffness, &clearance), few, &Unmonitored, None)?;
    let all = stiffness
        .into_par_iter()
        .flat_map_iter(|k| clearance.map(|rho| [k, rho]));
    let each = all.filter_map(|[k, rho]| Some(problem(&[k], &[rho]).at(&[k, rho]).ok()?.value));
    let best = each.reduce(|| 0.0, f64::max);
    let value = found.design.value;
    assert!(value >= best * (1.0 - 1e-9), "{value} {best}");
    assert!(value <= best * (1.0 + 1e-4), "{value} {best}");
    Ok(())
}

#[test]
fn certainty_is_met_as_hard_as_a_fine_scan_finds() -> Outcome {
    let machine = Machine::named("loaded").ok_or("the paper's machine")?;
    let certainty = Requirement::at_least(Figure::Certainty, 0.5);
    let range = Interval::new(6.5, 8.5);
    let problem = Problem {
        requirements: vec![certainty],
        ..Problem::of(machine, vec![Axis::new(Parameter::Clearance, range)])
    };
    let found = search(&problem, SETTINGS, &Unmonitored, None)?;
    let resolution = found.resolution.ok_or("trials are in the way")?;
    assert!(resolution.axes < 1e-3 && resolution.place < 1e-3);
    let passes = |design: &Design| {
        problem
            .tried(design)
            .is_ok_and(|all| all.iter().all(RequirementValue::is_met))
    };
    assert!(passes(&found.design));
    for index in 0..9 {
        let machine = problem.machine_at(&[range.at(f64::from(index) / 8.0)]);
        let zone = zone::hysteresis(&machine.scene)?;
        for place in (0..32).map(|index| f64::from(index) / 32.0) {
            let orbit = zone.orbit_at(place)?;
            let motion = ZoneMotion::new(&machine, &zone, place, &orbit)?;
            let value = problem.sought(&motion).ok_or("a velocity")?;
            let is_better = value > found.design.value * 1.001 && orbit.is_stable();
            let design = Design {
                machine: machine.clone(),
                place,
                zone: zone.clone(),
                orbit,
                value,
                cases: Vec::new(),
            };
            assert!(
                !(is_better && passes(&design)),
                "{value} at {place}, {index}: {}",
                found.design.value
            );
        }
    }
    Ok(())
}
