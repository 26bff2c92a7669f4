//! The optimum against dense grids, and the promises of the search.

use approx::{assert_abs_diff_eq, assert_relative_eq};
use argmin::core::Executor;
use argmin::solver::neldermead::NelderMead;
use softstop::{Machine, Parameter, Units};
use softstop_optimize::design::search::{
    SearchError, SearchMonitor, SearchSettings, Unmonitored, search,
};
use softstop_optimize::design::space::{Axis, Interval};
use softstop_optimize::design::{Design, Problem};
use softstop_testing::tolerance::{MOTION, printed};

use crate::Outcome;
use crate::grid::{of_designs, shares};

const CLEARANCE: Interval = Interval::new(2.0, 22.0);
const ANY: Interval = Interval::new(0.01, f64::INFINITY);

const STIFFNESS: Interval = Interval::new(1.0, 30.0);

/// The paper's machine over its stiffness and clearance.
fn over(stiffness: Interval, clearance: Interval, margin: f64) -> Problem {
    let machine = Machine::named("unloaded").expect("the paper's machine");
    let axes = vec![
        Axis::new(Parameter::StopStiffness, stiffness),
        Axis::new(Parameter::Clearance, clearance),
    ];
    Problem {
        margin,
        frequency: ANY,
        ..Problem::of(machine, axes)
    }
}

fn problem(margin: f64) -> Problem {
    over(Interval::held(7.0), CLEARANCE, margin)
}

/// The paper's machine whose preload is a deflection.
fn deflected() -> Machine {
    let mut machine = Machine::named("unloaded").expect("the paper's machine");
    machine
        .apply([("preload_deflection", "10")])
        .expect("a machine with a preload");
    machine
}

fn solve(problem: &Problem, evaluations: u64) -> Result<Design, SearchError> {
    search(problem, SearchSettings { evaluations }, &Unmonitored, None).map(|found| found.design)
}

/// The hardest impact on a grid over the clearance and the places in the zone, with its clearance.
fn on_grid(problem: &Problem, clearances: usize, places: usize) -> (f64, f64) {
    let velocity = |it: &Design| Some((it.before_impact_velocity(), it.machine.scene.clearance));
    let all = of_designs(problem, (clearances, places), velocity).into_iter();
    all.max_by(|one, other| one.0.total_cmp(&other.0))
        .expect("a design")
}

/// No grid point is better, and the best one is as near as its distance from the optimum lets
/// it be: `slack` is what the velocity falls within one step of the grid.
#[track_caller]
fn agrees(optimum: f64, grid: f64, slack: f64) {
    assert!(
        grid <= optimum * (1.0 + 1e-9),
        "a grid point has {grid}, the optimum {optimum}"
    );
    assert!(
        optimum - grid <= slack,
        "the grid has {grid}, the optimum {optimum}"
    );
}

/// Over seven decades of the clearance, and twelve of the stiffness besides, the search finds what it finds in the usual ones, or better.
#[test]
fn ranges_of_decades_are_searched() -> Outcome {
    let usual = solve(&problem(0.25), 400)?;
    let wide = |low, high| Interval { low, high };
    for stiffness in [Interval::held(7.0), wide(1.0, 1e12)] {
        let found = solve(&over(stiffness, wide(1e-3, 1e4), 0.25), 1200)?;
        let [found, usual] = [&found, &usual].map(Design::before_impact_velocity);
        assert!(found >= usual * (1.0 - 1e-6), "{found} {usual}");
    }
    Ok(())
}

#[test]
fn best_clearance_of_the_papers_stop() -> Outcome {
    let problem = problem(0.25);
    let design = solve(&problem, 400)?;
    let best = on_grid(&problem, 401, 21);
    agrees(design.before_impact_velocity(), best.0, 1e-3);
    let step = 20.0 / 400.0;
    assert_abs_diff_eq!(design.machine.scene.clearance, best.1, epsilon = step);
    Ok(())
}

#[test]
fn best_clearance_to_a_millionth() -> Outcome {
    let problem = problem(0.25);
    let design = solve(&problem, 400)?;
    let near = design.machine.scene.clearance;
    let fine = Interval::new(near - 0.05, near + 0.05);
    let (best, _) = on_grid(&over(Interval::held(7.0), fine, 0.25), 201, 11);
    agrees(design.before_impact_velocity(), best, 1e-6 * best);
    Ok(())
}

#[test]
fn best_stiffness_and_clearance() -> Outcome {
    let problem = over(STIFFNESS, CLEARANCE, 0.25);
    let design = solve(&problem, 800)?;
    let best = shares(16)
        .map(|it| over(Interval::held(STIFFNESS.at(it)), CLEARANCE, 0.25))
        .map(|problem| on_grid(&problem, 31, 5).0)
        .fold(f64::NEG_INFINITY, f64::max);
    agrees(design.before_impact_velocity(), best, 0.02 * best);
    Ok(())
}

/// With a wider margin the best design of a small clearance falls behind that of another ridge: near there both are told.
#[test]
fn where_the_optimum_jumps_both_ridges_are_told() -> Outcome {
    let found = |margin| {
        let settings = SearchSettings { evaluations: 400 };
        search(&problem(margin), settings, &Unmonitored, None)
    };
    let clearance = |design: &Design| design.machine.scene.clearance;
    let (before, after) = (found(0.1)?, found(0.11)?);
    assert_eq!(clearance(&before.design), CLEARANCE.low);
    let rivals: Vec<f64> = before.rivals.iter().map(clearance).collect();
    let [rival] = rivals[..] else {
        return Err(format!("one rival, not {rivals:?}").into());
    };
    assert_abs_diff_eq!(rival, clearance(&after.design), epsilon = 0.5);
    Ok(())
}

/// With the preload following the stiffness, the best velocity stands on a ridge beside a jump
/// (a second pair of folds inside the zone) and far from the broad summit of the grid's middle.
#[test]
fn a_narrow_ridge_is_found_with_few_and_many_evaluations() -> Outcome {
    let problem = Problem {
        machine: deflected(),
        ..over(STIFFNESS, CLEARANCE, 0.25)
    };
    for evaluations in [300, 600] {
        let velocity = solve(&problem, evaluations)?.before_impact_velocity();
        println!("{evaluations} evaluations");
        assert_abs_diff_eq!(velocity, 16.28637, epsilon = 1e-3);
    }
    Ok(())
}

/// The problem is a cost function of `argmin`: each of its solvers that needs no derivatives can take the place of the search.
#[test]
fn another_solver_finds_the_same_optimum() -> Outcome {
    let problem = over(STIFFNESS, CLEARANCE, 0.25);
    let simplex = vec![vec![0.2, 0.4], vec![0.3, 0.4], vec![0.2, 0.5]];
    let solver = NelderMead::new(simplex).with_sd_tolerance(1e-12)?;
    let found = Executor::new(&problem, solver)
        .configure(|state| state.max_iters(200))
        .run()?;
    let velocity = solve(&problem, 800)?.before_impact_velocity();
    assert_relative_eq!(
        -found.state().get_best_cost(),
        velocity,
        max_relative = 1e-9
    );
    Ok(())
}

/// Watches nothing, and lets all zones cost so many scan windows.
struct Within(u64);

impl SearchMonitor for Within {
    fn evaluated(&self, _: Option<f64>) {}
    fn stop(&self) -> bool {
        false
    }
    fn budget(&self) -> u64 {
        self.0
    }
}

#[test]
fn a_search_over_its_budget_has_no_design_whatever_it_met() {
    let settings = SearchSettings { evaluations: 100 };
    let found = |budget| search(&problem(0.3), settings, &Within(budget), None);
    assert!(found(1 << 40).is_ok());
    for budget in [1, 10_000, 1_000_000] {
        assert!(matches!(found(budget), Err(SearchError::OverBudget)));
    }
}

#[test]
fn without_margin_the_fold_itself_is_allowed() -> Outcome {
    let problem = over(Interval::held(7.0), Interval::held(10.0), 0.0);
    let design = solve(&problem, 100)?;
    let fold = design.zone.high.point.before_impact_velocity();
    assert!(
        design.before_impact_velocity() >= fold * (1.0 - 1e-7),
        "{} below {fold}",
        design.before_impact_velocity()
    );
    Ok(())
}

#[test]
fn frequency_bounds_cut_the_zone() -> Outcome {
    let frequency = Interval::new(1.1, 1.2);
    let bounded = Problem {
        frequency,
        ..over(Interval::held(7.0), Interval::held(10.0), 0.1)
    };
    let design = solve(&bounded, 100)?;
    assert_abs_diff_eq!(design.frequency(), 1.2, epsilon = MOTION);
    let fixed = Problem {
        frequency: Interval::held(1.15),
        ..bounded
    };
    let design = solve(&fixed, 100)?;
    assert_abs_diff_eq!(
        design.before_impact_velocity(),
        6.494627,
        epsilon = printed(6)
    );
    Ok(())
}

/// A press of 120 kg on 2.4 MN/m that the drive bends by 3.75 mm: the best design is that of the ratios.
#[test]
fn a_machine_in_si_units_has_the_same_optimum() -> Outcome {
    let units = Units {
        mass: 120.0,
        stiffness: 2.4e6,
        force: 9000.0,
    };
    let ratios = problem(0.25);
    let length = units.force / units.stiffness;
    let in_units = |range: Interval, unit: f64| Interval::new(range.low * unit, range.high * unit);
    let press = Problem {
        machine: Machine::from(ratios.machine.scene.in_units(units)?),
        ..over(
            in_units(Interval::held(7.0), units.stiffness),
            in_units(CLEARANCE, length),
            0.25,
        )
    };
    let (ratios, press) = (solve(&ratios, 400)?, solve(&press, 400)?);
    let speed = length * (units.stiffness / units.mass).sqrt();
    let velocity = press.before_impact_velocity() / speed;
    let same = |a: f64, b: f64, within: f64| assert_relative_eq!(a, b, max_relative = within);
    same(velocity, ratios.before_impact_velocity(), 1e-9);
    let clearance = |design: &Design| design.machine.scene.clearance;
    // Where the velocity is flat the place is known to the root of that.
    same(clearance(&press) / length, clearance(&ratios), 1e-4);
    Ok(())
}

/// A rigid stop has no stiffness: the clearance alone is searched, and no grid point is better.
#[test]
fn a_rigid_stop_has_an_optimum_too() -> Outcome {
    let mut machine = Machine::named("unloaded").expect("the paper's machine");
    machine.apply([("stop.model", "rigid"), ("stop.restitution", "0.6")])?;
    let problem = Problem {
        machine,
        axes: vec![Axis::new(Parameter::Clearance, CLEARANCE)],
        ..problem(0.25)
    };
    let design = solve(&problem, 300)?;
    let best = shares(81)
        .filter_map(|share| problem.at(&[CLEARANCE.at(share)]).ok())
        .map(|design| design.before_impact_velocity())
        .fold(f64::NEG_INFINITY, f64::max);
    agrees(design.before_impact_velocity(), best, 0.02 * best);
    Ok(())
}

#[test]
fn nothing_feasible_is_an_error_that_says_why() {
    let problem = over(Interval::held(7.0), Interval::new(26.0, 40.0), 0.25);
    let error = solve(&problem, 100).expect_err("no zone there").to_string();
    assert!(
        error.contains("clearance = 26"),
        "the nearest try is at the lower bound: {error}"
    );
}

#[test]
fn a_stopped_search_has_no_result() {
    struct Stop;
    impl SearchMonitor for Stop {
        fn evaluated(&self, _: Option<f64>) {}
        fn stop(&self) -> bool {
            true
        }
    }
    let problem = over(STIFFNESS, CLEARANCE, 0.25);
    let outcome = search(&problem, SearchSettings { evaluations: 2000 }, &Stop, None);
    assert!(matches!(outcome, Err(SearchError::Stopped(_))));
}
