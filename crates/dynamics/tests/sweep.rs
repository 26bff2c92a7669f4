//! Sweeps against the figures of the paper and of the continuation.

use std::collections::HashMap;
use std::ops::ControlFlow;
use std::sync::Mutex;

use rayon::ThreadPoolBuilder;
use softstop::{Below, Parameter, Ratios, Release, Start, Stop};
use softstop_dynamics::monitor::{Memory, unmonitored};
use softstop_dynamics::sweep::{PlanError, find_coexistences};
use softstop_dynamics::{Chain, Direction, MotionKind, Plan, Regime, SweepStep, orbit};
use softstop_testing::tolerance::{GROWN, MOTION};
use softstop_testing::{assert_near, is_near, kelvin_voigt, rigid_stop, unloaded};

/// Frequency at which the impact-less motion grazes, rho = 10.
const G0: f64 = 1.04444;
/// Frequency of the fold of z = 1, rho = 10.
const FOLD: f64 = 1.369_036;
const NONE: Regime = Regime {
    impacts: 0,
    periods: 1,
};

fn chain(ratios: Ratios, way: Direction) -> Chain {
    Chain::new(ratios.scene().expect("there is one"), way)
}

fn both(ratios: Ratios) -> Vec<Chain> {
    [Direction::Up, Direction::Down]
        .map(|way| chain(ratios, way))
        .into()
}

/// Runs a plan to its end.
fn run(plan: &Plan, mut chains: Vec<Chain>) -> Vec<Chain> {
    assert!(plan.run_chains(&mut chains, &unmonitored));
    assert!(chains.iter().all(|chain| chain.error.is_none()));
    assert!(chains.iter().all(|chain| chain.steps.len() == plan.steps));
    chains
}

fn frequencies(range: (f64, f64), steps: usize, periods: u64) -> Plan {
    Plan::new(Parameter::Frequency, range, steps, periods).expect("there is one")
}

/// Value of the first step with fewer impacts than one per drive period, after at least one with one.
fn lost(chain: &Chain) -> f64 {
    let strikes = |step: &&SweepStep| step.impacts_per_period == 1.0;
    let first = chain
        .steps
        .iter()
        .position(|step| strikes(&step))
        .expect("there is one");
    let rest = &chain.steps[first..];
    rest.iter()
        .find(|step| !strikes(step))
        .expect("there is one")
        .value
}

#[test]
fn between_grazing_and_fold_the_way_matters() {
    // 1e-3 per 50 drive periods.
    let mut plan = frequencies((0.99, 1.42), 431, 50);
    // A step of 1e-3 moves the orbit by some 5e-3 of its size, and the map contracts by sqrt(0.786) per period:
    // 25 periods, from which on it is looked at, leave 5 % of that. At the fold, where it contracts less, some steps
    // do not settle.
    plan.tolerance = 1e-3;
    let chains = run(&plan, both(Ratios::unloaded()));
    let zones = find_coexistences(&chains[0], &chains[1]);
    let zone = zones
        .iter()
        .find(|zone| zone.from > 1.03)
        .expect("there is one");
    assert!(
        zone.up.regime() == Some(Regime::ONE) && zone.down.regime() == Some(NONE),
        "{zone:?}"
    );
    assert!(zone.from >= G0 && zone.from < G0 + 5e-3, "{zone:?}");
    assert!(is_near(zone.to, FOLD, 2e-3), "{zone:?}");
    let up = chains[0].find_jumps();
    let jump = up.last().expect("there is one");
    assert!(jump.before.regime() == Some(Regime::ONE) && jump.after.regime() == Some(NONE));
    assert!(jump.velocities.0 > 16.0 && jump.velocities.1 == 0.0);
}

#[test]
fn a_sweep_loses_the_motion_after_its_end() {
    // The paper's 1.37083; an independent integrator loses it at 1.371 at both rates.
    let slow = frequencies((1.3, 1.4), 101, 50);
    // Which motion it is on is told by its impacts alone: nothing settles within 5 periods.
    let fine = frequencies((1.3, 1.4), 1001, 5);
    for plan in [slow, fine] {
        assert_near(plan.sweep_rate(), 2e-5, MOTION);
        // From the motion with impacts, as a sweep from below comes.
        let orbit = orbit::find(&unloaded(1.3));
        let plan = Plan {
            start: orbit.expect("there is one").state().into(),
            ..plan
        };
        let chains = run(&plan, vec![chain(Ratios::unloaded(), Direction::Up)]);
        let lost = lost(&chains[0]);
        assert!(lost > FOLD && is_near(lost, 1.371, 2e-3), "{lost}");
    }
}

#[test]
fn a_slower_sweep_loses_it_nearer_to_the_fold() {
    let at = |periods| {
        let plan = frequencies((1.36, 1.38), 41, periods);
        let scene = unloaded(1.36);
        let start = orbit::find(&scene).expect("there is one").state().into();
        let chains = run(
            &Plan { start, ..plan },
            vec![chain(Ratios::unloaded(), Direction::Up)],
        );
        lost(&chains[0])
    };
    let (fast, slow) = (at(10), at(1000));
    assert!(
        fast > slow && slow > FOLD && slow < FOLD + 1e-3,
        "{fast} {slow}"
    );
}

#[test]
fn steps_have_the_motions_of_newtons_method() {
    let plan = frequencies((1.05, 1.15), 3, 300);
    // From rest the first value may lead to either motion.
    let mut plan = plan;
    plan.start = orbit::find(&unloaded(1.05))
        .expect("there is one")
        .state()
        .into();
    let chains = run(&plan, vec![chain(Ratios::unloaded(), Direction::Up)]);
    for step in &chains[0].steps {
        let scene = unloaded(step.value);
        let orbit = orbit::find(&scene).expect("there is one");
        assert_eq!(step.motion.regime(), Some(Regime::ONE));
        assert_near(step.hardest_impact(), orbit.before_impact_velocity(), GROWN);
        assert_near(step.max_position, orbit.max_position, GROWN);
    }
}

#[test]
fn chaos_is_told_from_rest_and_order() {
    // Between grazing at 0.95265 and the first windows of order.
    let plan = frequencies((0.96, 0.975), 4, 200);
    let chains = run(&plan, both(Ratios::unloaded()));
    let chaotic = |step: &SweepStep| {
        let grows = step.growth.is_some_and(|growth| growth > 0.05);
        step.motion == MotionKind::Chaos && grows && step.velocities.len() > 10
    };
    assert!(chains[0].steps.iter().any(chaotic));
}

#[test]
fn any_parameter_can_be_swept() {
    let plan = Plan::new(Parameter::Clearance, (8.0, 12.0), 9, 100).expect("there is one");
    let chains = run(
        &plan,
        both(Ratios {
            frequency: 1.0,
            ..Ratios::unloaded()
        }),
    );
    let values: Vec<f64> = chains[1].steps.iter().map(|step| step.value).collect();
    assert_eq!(values[0], 12.0);
    assert!(values.is_sorted_by(|a, b| a > b));
    // Farther away, the mass swings farther.
    let far = chains[0].steps.windows(2);
    assert!(
        far.into_iter()
            .all(|pair| pair[0].max_position < pair[1].max_position)
    );
}

/// Several chains with different numbers of phases.
fn fleet() -> Vec<Chain> {
    [2.0, 6.0, 10.0, 14.0, 18.0, 22.0]
        .into_iter()
        .flat_map(|clearance| {
            both(Ratios {
                clearance,
                ..Ratios::unloaded()
            })
        })
        .collect()
}

#[test]
fn threads_and_interruptions_change_nothing() {
    let plan = frequencies((0.8, 1.8), 21, 50);
    let on = |threads| {
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("there is one");
        pool.install(|| run(&plan, fleet()))
    };
    let whole = on(1);
    assert_eq!(whole, on(2));
    let mut parts = fleet();
    let mut rounds = 0;
    // Stopped after each step of each group.
    while !plan.run_chains(&mut parts, &|_, _| ControlFlow::Break(())) {
        rounds += 1;
    }
    assert!(rounds >= plan.steps / 2);
    assert_eq!(whole, parts);
}

/// Pieces of work by their keys.
#[derive(Default)]
struct Pieces(Mutex<HashMap<Vec<u8>, Vec<u8>>>);

impl Memory for Pieces {
    fn recall_piece(&self, key: &[u8]) -> Option<Vec<u8>> {
        self.0.lock().expect("no panic").get(key).cloned()
    }

    fn store_piece(&self, key: &[u8], piece: &[u8]) {
        let known = self
            .0
            .lock()
            .expect("no panic")
            .insert(key.to_vec(), piece.to_vec());
        assert_eq!(known, None, "done twice");
    }
}

/// A chain that fails on its way fails in the same words when it is recalled, without being tried again.
#[test]
fn a_failed_chain_is_recalled_as_such() {
    let plan = Plan::new(Parameter::Preload, (-20.0, 100.0), 13, 20).expect("valid");
    let pieces = Pieces::default();
    let run = || {
        let mut chains = vec![
            chain(Ratios::unloaded(), Direction::Down),
            chain(Ratios::loaded(), Direction::Up),
        ];
        assert!(plan.run_chains_with_memory(&mut chains, &unmonitored, Some(&pieces)));
        chains
    };
    let done = run();
    assert_eq!([done[0].steps.len(), done[1].steps.len()], [11, 0]);
    let message = done[0].error.as_deref().expect("no such machine");
    assert!(message.contains("preload"), "{message}");
    let count = pieces.0.lock().expect("no panic").len();
    assert_eq!(run(), done);
    assert_eq!(pieces.0.lock().expect("no panic").len(), count);
}

#[test]
fn plans_and_parameters_that_cannot_be_are_refused() {
    let plan = |range, steps, periods| Plan::new(Parameter::Frequency, range, steps, periods);
    assert!(matches!(
        plan((1.0, 1.0), 3, 3),
        Err(PlanError::Range { .. })
    ));
    assert!(matches!(
        plan((f64::NAN, 1.0), 3, 3),
        Err(PlanError::Range { .. })
    ));
    assert!(matches!(plan((1.0, 2.0), 1, 3), Err(PlanError::Steps(1))));
    assert!(matches!(plan((1.0, 2.0), 3, 0), Err(PlanError::Periods(0))));
    let plan = plan((-1.0, 1.0), 3, 3).expect("there is one");
    let mut chains = both(Ratios::unloaded());
    assert!(plan.run_chains(&mut chains, &unmonitored));
    // A frequency below zero: one chain cannot begin, the other cannot end.
    assert!(chains[0].steps.is_empty() && chains[0].error.is_some());
    assert_eq!(chains[1].steps.len(), 1);
    assert!(chains[1].error.is_some());
}

/// The paper's (2/4)B, impacts 1-1-0-0, and its z = 1/2, on sweeps over the same frequencies.
#[test]
fn steps_tell_the_order_of_impacts() {
    let order_from = |position: f64, velocity: f64| {
        let plan = Plan::new(Parameter::Frequency, (0.9886, 0.9888), 3, 2000).expect("a plan");
        let start = Start::new(position, velocity);
        let plan = Plan { start, ..plan };
        let mut chain = [chain(Ratios::unloaded(), Direction::Up)];
        assert!(plan.run_chains(&mut chain, &unmonitored));
        let orders = chain[0].steps.iter().map(|step| step.motion.order());
        orders
            .map(|order| order.map_or_else(String::new, ToString::to_string))
            .collect::<Vec<String>>()
    };
    assert_eq!(order_from(9.360_532, 3.830_784), ["1-1-0-0"; 3]);
    assert_eq!(order_from(9.214_320, 3.694_000), ["1-0"; 3]);
}

/// A sweep tells complete chatter from motions with so many impacts, as the search for motions does.
#[test]
fn chatter_is_called_chatter() {
    let mut scene = unloaded(0.3);
    scene.stop = Stop::Rigid { restitution: 0.6 };
    scene.clearance = 0.0;
    let mut plan = frequencies((0.3, 0.301), 2, 60);
    plan.start = Start::new(-0.5, 0.1);
    let chains = run(&plan, vec![Chain::new(scene, Direction::Up)]);
    for step in &chains[0].steps {
        let name = step.motion.to_string();
        assert_eq!(name, "complete chatter every drive period");
    }
    assert_eq!(chains[0].find_jumps(), []);
}

/// A mass that dry friction of the strip holds is at rest, not a motion without impacts.
#[test]
fn a_mass_held_by_friction_is_at_rest() {
    let mut ratios = Ratios::loaded();
    ratios.piercing.as_mut().expect("a strip").friction = 500.0;
    for (position, is_held) in [(10.2, true), (0.0, false)] {
        let mut plan = frequencies((1.15, 1.16), 2, 200);
        plan.start = Start::new(position, 0.0);
        for step in &run(&plan, vec![chain(ratios, Direction::Up)])[0].steps {
            assert_eq!(step.motion == MotionKind::Rest, is_held, "{}", step.motion);
        }
    }
}

/// A state beyond a rigid stop, above or below or behind a spring, is put at rest on it, whatever its position rounds to.
#[test]
fn what_lies_beyond_a_rigid_stop_begins_at_rest_on_it() {
    let mut scene = unloaded(1.0);
    scene.stop = kelvin_voigt(3.0, Release::default());
    scene.rigid = Some(rigid_stop(0.7, 0.6));
    scene.below = Some(Box::new(Below {
        clearance: 1.1,
        stop: Stop::Rigid { restitution: 0.6 },
    }));
    let mut plan = Plan::new(Parameter::Clearance, (-0.7, 0.3), 7, 3).expect("there is one");
    for (start, is_beyond) in [(5.0, true), (-5.0, true), (-1.0, false)] {
        plan.start = Start::new(start, 0.1);
        let ways = [Direction::Up, Direction::Down];
        let chains = run(&plan, ways.map(|way| Chain::new(scene.clone(), way)).into());
        let begins = chains.iter().map(|chain| chain.steps[0].is_put_on_wall);
        assert_eq!(begins.collect::<Vec<_>>(), [is_beyond; 2]);
    }
}
