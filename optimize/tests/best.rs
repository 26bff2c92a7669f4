//! The best design, and known to be: random tasks beside a differential evolution (Storn and Price 1997) and beside the search
//! with more evaluations; what stands beside a design never contradicts it, and no machine within its tolerances does.

mod hammer;
mod random_task;

use argmin::core::CostFunction;
use softstop::{Machine, Parameter};
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::zone::ZoneKind;
use softstop_optimize::design::figure::{Figure, Sense};
use softstop_optimize::design::problem::{Tolerance, Width};
use softstop_optimize::design::requirement::{Requirement, Scope};
use softstop_optimize::design::search::{SearchError, SearchSettings, Unmonitored, search};
use softstop_optimize::design::solution::{SideTasks, Solution};
use softstop_optimize::design::space::{Axis, Interval};
use softstop_optimize::design::{Design, Problem};
use softstop_optimize::robust::{self, verify};

use crate::Outcome;
pub(crate) use random_task::PRESS;
use random_task::{Numbers, task};

const SETTINGS: SearchSettings = SearchSettings { evaluations: 1200 };

/// No machine of some thousand within the tolerances loses the motion or violates a requirement.
fn assert_holds(problem: &Problem, design: &Design, machines: usize) -> Outcome {
    let Some(spread) = problem.spread(&design.machine) else {
        return Ok(());
    };
    let settings = robust::VerifySettings {
        machines,
        ..robust::VerifySettings::default()
    };
    let required = problem.requirements.iter().copied();
    let required: Vec<Requirement> = required.filter(Requirement::is_of_each_motion).collect();
    let verdict = verify(&spread, &design.orbit, (settings, &required), &unmonitored)?;
    assert_eq!(verdict.drawing.lost, 0);
    assert!(
        verdict.drawing.violating.iter().all(|count| *count == 0),
        "{verdict:?}"
    );
    Ok(())
}

/// What contradicts the design, in words: nothing must.
fn contradictions(problem: &Problem, solution: &Solution) -> Vec<String> {
    let score = |it: &Design| problem.objective.score(problem.sought_of(it));
    let own = score(&solution.found.design);
    let relaxed = solution.relaxed.iter().map(score);
    let relaxed = relaxed.filter(|score| *score < (1.0 - ROUNDING) * own);
    let relaxed = relaxed.map(|score| format!("without tolerances {score}, with them {own}"));
    let rivals = solution.found.rivals.iter().map(score);
    let rivals = rivals.filter(|score| *score > (1.0 + ROUNDING) * own);
    let rivals = rivals.map(|score| format!("a rival with {score}, not {own}"));
    let fronts = solution.fronts.iter().flat_map(|front| {
        let is_good = |it: &(f64, f64)| {
            let gain = it.0 - front.design.0;
            let gain = match front.figure.sense() {
                Sense::Least => gain,
                Sense::Most => -gain,
            };
            let [one, own] = [it.1, front.design.1].map(|it| problem.objective.score(it));
            gain > 0.0 && one > own
        };
        let better = front.points.iter().filter(move |it| is_good(it));
        better.map(|it| format!("{}: {it:?} against {:?}", front.figure.name(), front.design))
    });
    relaxed.chain(rivals).chain(fronts).collect()
}

/// Relative difference between scores that is none.
const ROUNDING: f64 = 1e-9;

/// Trade-offs take most of the time: one task of so many has them.
fn nothing_contradicts(
    seeds: std::ops::Range<u64>,
    settings: SearchSettings,
    with_fronts: u64,
) -> Outcome {
    for seed in seeds {
        let problem = task(seed);
        let beside = SideTasks {
            relaxed: true,
            fronts: seed.is_multiple_of(with_fronts),
            ..SideTasks::default()
        };
        let solution = match Solution::of(&problem, settings, beside, (&Unmonitored, None)) {
            Err(SearchError::NoDesign { .. }) => continue,
            solution => solution?,
        };
        let contradictions = contradictions(&problem, &solution);
        assert!(contradictions.is_empty(), "seed {seed}: {contradictions:?}");
        assert_holds(&problem, &solution.found.design, 1024)?;
    }
    Ok(())
}

#[test]
fn nothing_beside_a_design_contradicts_it() -> Outcome {
    nothing_contradicts(0..10, SearchSettings { evaluations: 200 }, 5)
}

#[test]
#[ignore = "minutes: a hundred tasks"]
fn nothing_beside_a_hundred_designs_contradicts_them() -> Outcome {
    nothing_contradicts(100..200, SETTINGS, 1)
}

/// The best cost of a differential evolution (DE/rand/1/bin, F = 0.6, CR = 0.9) over the unit cube.
fn differential_evolution(problem: &Problem, seed: u64, evaluations: usize) -> (Vec<f64>, f64) {
    let dimensions = problem.free_axes().count();
    let count = 10 * dimensions.max(2);
    let mut numbers = Numbers::of_seed(seed);
    let cost = |unit: &Vec<f64>| (&problem).cost(unit).unwrap_or(f64::INFINITY);
    let mut all: Vec<(Vec<f64>, f64)> = (0..count)
        .map(|_| {
            let unit: Vec<f64> = (0..dimensions).map(|_| numbers.next()).collect();
            let cost = cost(&unit);
            (unit, cost)
        })
        .collect();
    for _ in 0..evaluations / count - 1 {
        for index in 0..count {
            let [a, b, c] = [(); 3].map(|()| numbers.below(count));
            let forced = numbers.below(dimensions);
            let trial = (0..dimensions).map(|axis| {
                let moved = all[a].0[axis] + 0.6 * (all[b].0[axis] - all[c].0[axis]);
                match axis == forced || numbers.next() < 0.9 {
                    true => moved.clamp(0.0, 1.0),
                    false => all[index].0[axis],
                }
            });
            let trial: Vec<f64> = trial.collect();
            let own = cost(&trial);
            if own <= all[index].1 {
                all[index] = (trial, own);
            }
        }
    }
    let best = all.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
    best.expect("some")
}

/// By as much as others may be better, relative.
const NEAR: f64 = 1e-4;

/// `SOFTSTOP_TASKS` says how many, `SOFTSTOP_FIRST` from which seed on.
#[test]
#[ignore = "half a minute of processor time for each task"]
fn no_other_search_finds_better_designs() -> Outcome {
    let number = |name: &str, usual: u64| {
        let said = std::env::var(name).ok();
        said.and_then(|it| it.parse().ok()).unwrap_or(usual)
    };
    let first = number("SOFTSTOP_FIRST", 300);
    let mut worse = Vec::new();
    for seed in first..first + number("SOFTSTOP_TASKS", 30) {
        let mut problem = task(seed);
        // What a differential evolution over the motions of drawings can seek, too.
        for requirement in &mut problem.requirements {
            requirement.scope = Scope::Drawing;
        }
        let value = |evaluations| {
            let beside = SideTasks {
                relaxed: true,
                ..SideTasks::default()
            };
            let settings = SearchSettings { evaluations };
            let found = Solution::of(&problem, settings, beside, (&Unmonitored, None));
            found.map_or(0.0, |it| it.found.design.value)
        };
        let (own, more) = (value(1200), value(12_000));
        let (unit, cost) = differential_evolution(&problem, seed, 10_000);
        let design = problem.at(&problem.axis_values(&unit));
        let holds = design.is_ok_and(|design| problem.has_box(&design).is_ok());
        let evolved = if holds { -cost } else { 0.0 };
        let axes = problem.free_axes().count();
        let tolerances = problem.tolerances.len();
        println!(
            "{seed}: {axes} axes, {tolerances} tolerances: {own} ({more} of more, {evolved} evolved)"
        );
        if own < (1.0 - NEAR) * more.max(evolved) {
            worse.push((seed, own, more, evolved));
        }
    }
    assert!(worse.is_empty(), "{worse:?}");
    Ok(())
}

/// Of this pile driver the zone's lower end leaps from a flip to a Neimark-Sacker bifurcation where the stiffness changes by half a per
/// cent, and the place in the zone with it: an ascent that ends there goes on from other places.
#[test]
fn no_design_stands_where_the_end_of_its_zone_leaps() -> Outcome {
    let machine = Machine::from_toml(include_str!("../../docs/pile-driver.toml"))?;
    let range = |low, high| Interval { low, high };
    let (low, high) = (10.0, 25.0);
    let hertz = std::f64::consts::TAU;
    let share = |parameter, share| Tolerance::new(parameter, Width::Share(share));
    let problem = Problem {
        zone: ZoneKind::SingleImpact {
            between: (hertz * low, hertz * high),
        },
        frequency: range(low, high),
        margin: 0.05,
        tolerances: vec![
            share(Parameter::StopStiffness, 0.082_785_095_397_207_85),
            share(Parameter::Preload, 0.029_168_647_034_134_216),
            share(Parameter::ContactDamping, 0.166_265_756_535_422_97),
        ],
        requirements: vec![Requirement::at_most(
            Figure::StopForce,
            507_385.164_101_511_7,
        )],
        ..Problem::of(
            machine,
            vec![
                Axis::new(Parameter::Clearance, range(2e-3, 30e-3)),
                Axis::new(Parameter::Suspension, range(1e6, 5e6)),
            ],
        )
    };
    let found = search(
        &problem,
        SearchSettings { evaluations: 300 },
        &Unmonitored,
        None,
    )?;
    let worst = problem.worst_of_required(&found.design);
    let share = worst[0].2.value / 507_385.164_101_511_7;
    assert!(found.residue < 1e-6, "{}", found.residue);
    assert!((share - 1.0).abs() < 1e-6, "{share}");
    Ok(())
}
