//! Normal tolerances.

use rayon::prelude::*;
use softstop::Parameter;
use softstop_dynamics::basin::wilson_interval;
use softstop_dynamics::figure::Figure;
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::spread_points::random_coordinate;
use softstop_dynamics::{CycleMetrics, Orbit};
use softstop_optimize::design::Problem;
use softstop_optimize::design::problem::{Tolerance, Width};
use softstop_optimize::design::requirement::Requirement;
use softstop_optimize::design::search::{SearchError, SearchSettings, Unmonitored};
use softstop_optimize::design::solution::{SideTasks, Solution};
use softstop_optimize::design::space::{Axis, Interval};
use softstop_optimize::robust::{self, Distribution, FITTED, Tolerances, normal_quantile, verify};

use super::{Outcome, press};

/// A press whose tolerances are normal, and the stop's force at most.
fn problem(force: f64) -> Result<Problem, Box<dyn std::error::Error>> {
    let normal = |parameter, share, cpk: f64| Tolerance {
        distribution: Distribution::Normal(3.0 * cpk),
        ..Tolerance::new(parameter, Width::Share(share))
    };
    let clearance = Interval::new(0.02, 0.04);
    Ok(Problem {
        tolerances: vec![
            normal(Parameter::Clearance, 0.01, 1.0),
            normal(Parameter::Damping, 0.1, 1.33),
            normal(Parameter::StopStiffness, 0.03, 1.0),
        ],
        requirements: vec![Requirement::at_most(Figure::StopForce, force)],
        ..Problem::of(press()?, vec![Axis::new(Parameter::Clearance, clearance)])
    })
}

const FEW: SearchSettings = SearchSettings { evaluations: 200 };
const BESIDE: SideTasks = SideTasks {
    relaxed: false,
    fronts: false,
    machines: 1 << 14,
};

/// A machine by chance: each value from a number of its own.
fn machine(spread: &Tolerances, index: u64) -> Vec<f64> {
    let dimensions = 0..spread.dimensions() as u32;
    let even = dimensions.map(|dimension| 2.0 * random_coordinate(7, index, dimension) - 1.0);
    spread.draw(&even.collect::<Vec<f64>>())
}

/// The design keeps as few standard deviations as the share allows, and of machines by chance, each with a motion of its own, as
/// many are rejected as it says.
#[test]
fn the_share_that_is_reported_is_that_of_machines_by_chance() -> Outcome {
    let problem = Problem {
        violating: 0.01,
        ..problem(7e5)?
    };
    let solution = Solution::of(&problem, FEW, BESIDE, (&Unmonitored, None))?;
    let kept = problem.with_deviations(solution.deviations);
    let design = &solution.found.design;
    let spread = kept.spread(&design.machine).ok_or("tolerances")?;
    let settings = robust::VerifySettings::of_machines(BESIDE.machines);
    let required = kept.required_of_each();
    let spread = spread.over(FITTED);
    let verdict = verify(&spread, &design.orbit, (settings, &required), &unmonitored)?;
    let [low, high] = verdict.share_rejected();
    assert!(
        (0.9 * problem.violating..=problem.violating).contains(&high),
        "{high}"
    );
    assert!(solution.deviations < 2.5, "{}", solution.deviations);
    let is_rejected = |index: u64| {
        let scene = spread.scene(&machine(&spread, index));
        let orbit = Orbit::find_near(&scene, design.orbit.state()).ok();
        let orbit = orbit.filter(|it| it.is_stable() && it.impacts.len() == 1);
        let stroke = orbit.as_ref().and_then(|it| CycleMetrics::of(it).ok());
        !stroke.is_some_and(|it| required[0].is_met(it.stop_force))
    };
    let trials = 50_000;
    let rejected = (0..trials)
        .into_par_iter()
        .filter(|it| is_rejected(*it))
        .count();
    let [least, most] = wilson_interval(rejected, trials as usize);
    assert!(
        least <= high && low <= most,
        "{low} to {high}, by chance {least} to {most}"
    );
    Ok(())
}

/// Where one linear bound is violated, the share outside it is that of the normal distribution.
#[test]
fn the_share_beyond_one_bound_is_that_of_the_normal_distribution() -> Outcome {
    let machine = press()?;
    let force = Parameter::Frequency;
    let all = [robust::AbsoluteTolerance {
        parameter: force,
        half_width: 0.02,
        distribution: Distribution::Normal(2.0),
    }];
    let spread = Tolerances::new(&machine, &all)?;
    for (even, deviations) in [
        (0.0, 0.0),
        (0.954_499_736_103_641_6, 2.0),
        (-0.5, normal_quantile(0.25)),
    ] {
        let at = spread.draw(&[even])[0];
        assert!((at - 0.5 * deviations).abs() < 1e-12, "{even}: {at}");
        let wide = spread.over(FITTED);
        let same = wide.machine(&wide.draw(&[even])).scene.excitation.frequency;
        let own = spread.machine(&[at]).scene.excitation.frequency;
        assert!((same / own - 1.0).abs() < 1e-14);
    }
    // A bound of the velocity at the velocity of the machine 1.5 standard deviations below.
    let nominal = softstop_dynamics::orbit::find(&machine.scene)?;
    let slow = Orbit::find_near(&spread.scene(&[-0.75]), nominal.state())?;
    let bound = Requirement::at_least(Figure::Velocity, slow.before_impact_velocity());
    let settings = robust::VerifySettings::of_machines(1 << 16);
    let verdict = verify(
        &spread.over(FITTED),
        &nominal,
        (settings, &[bound]),
        &unmonitored,
    )?;
    let share = verdict.rejected as f64 / verdict.machines as f64;
    assert!((normal_quantile(share) + 1.5).abs() < 1e-3, "{share}");
    Ok(())
}

/// A bound that no design can keep for so many of the machines is told with the share.
#[test]
fn a_share_that_no_design_has_is_refused() -> Outcome {
    let mut problem = problem(7e5)?;
    problem.requirements = vec![Requirement::at_most(Figure::StopForce, 1e5)];
    let found = Solution::of(&problem, FEW, BESIDE, (&Unmonitored, None));
    assert!(
        matches!(found, Err(SearchError::NoDesign { .. })),
        "{found:?}"
    );
    Ok(())
}
