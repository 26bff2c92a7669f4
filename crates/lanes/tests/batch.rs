//! The lanes against the scalar engine: the same impacts, the same states, whatever the instruction set.

mod leaps;
mod power;
mod single;
mod two_sided;

use softstop_testing::tolerance::{GROWN, SOLVED};
use std::collections::HashMap;

use softstop::{Clock, Ratios, Release, Scene, Slope, Start, Stop};
use softstop_lanes::{
    BatchObserver, InstructionLimit, Job, LoweredMachine, Outcome, run, run_one_by_one, run_with,
};
use softstop_testing::{Meets, assert_near, kelvin_voigt, preloaded, rigid_stop};

const PERIODS: u64 = 20;

/// Numbers in 0..1 without a pattern of their own (Weyl sequences of independent irrationals).
fn spread(index: usize, which: u32) -> f64 {
    let step = f64::from(2 + which * which).sqrt() * 1.618_033_988_749_895;
    (0.5 + step * index as f64).fract()
}

fn between(low: f64, high: f64, share: f64) -> f64 {
    low + (high - low) * share
}

/// Machines of all kinds that have linear laws, by turns.
fn scene(index: usize) -> Scene {
    let mut ratios = if index.is_multiple_of(3) {
        Ratios::loaded()
    } else {
        Ratios::unloaded()
    };
    ratios.frequency = between(0.5, 2.0, spread(index, 1));
    ratios.clearance = between(0.5, 20.0, spread(index, 2));
    let mut scene = ratios.scene().expect("valid");
    let stiffness = 10f64.powf(between(0.5, 4.0, spread(index, 3)));
    let slope = |from, stiffness| Slope { from, stiffness };
    if index % 3 == 1 {
        scene.stop = match index % 5 {
            0 => Stop::Rigid { restitution: 0.8 },
            1 => kelvin_voigt(stiffness, Release::Clearance),
            2 => kelvin_voigt(stiffness, Release::ZeroForce),
            3 => Stop::PiecewiseLinear {
                loading: vec![slope(0.0, stiffness), slope(0.3, 2.0 * stiffness)],
                unloading: vec![slope(0.0, 0.5 * stiffness)],
            },
            _ => preloaded(stiffness, 10.0),
        };
    }
    if index % 7 == 1 && !matches!(scene.stop, Stop::Rigid { .. }) {
        scene.rigid = Some(rigid_stop(0.5, 0.5));
    }
    scene
}

fn start(index: usize, scene: &Scene) -> Start {
    let wall = scene.wall().map_or(f64::INFINITY, |wall| wall.position);
    Start {
        position: between(-12.0, 12.0, spread(index, 4)).min(wall),
        velocity: between(-15.0, 15.0, spread(index, 5)),
    }
}

fn scalar(scene: &Scene, start: Start) -> (Start, u64) {
    scalar_for(scene, start, PERIODS)
}

fn scalar_for(scene: &Scene, start: Start, periods: u64) -> (Start, u64) {
    let (end, impacts, _) = single::safely(scene, start, periods);
    (end, impacts)
}

fn distance(a: Start, b: Start) -> f64 {
    assert!(
        a.position.is_finite() && a.velocity.is_finite(),
        "{a:?} for {b:?}"
    );
    (a.position - b.position)
        .abs()
        .max((a.velocity - b.velocity).abs())
}

/// How much a difference of the start grows: chaos cannot be compared.
fn growth(scene: &Scene, from: Start, end: Start, periods: u64) -> f64 {
    let small = 1e-9;
    let beside = Start {
        position: from.position - small,
        ..from
    };
    distance(scalar_for(scene, beside, periods).0, end) / small
}

/// How much a difference at the start or at the end of a period grows at most: a mass that lands forgets the one at its start.
fn largest_growth(scene: &Scene, from: Start, end: Start) -> f64 {
    let after = |passed| match passed {
        0 => from,
        _ => scalar_for(scene, from, passed).0,
    };
    let growths = (0..PERIODS).map(|passed| growth(scene, after(passed), end, PERIODS - passed));
    growths.fold(0.0, f64::max)
}

struct Batch {
    machines: Vec<LoweredMachine>,
    jobs: Vec<Job>,
    scenes: Vec<Scene>,
}

/// Machines whose phases are each ended by one position alone.
fn is_plain(scene: &Scene) -> bool {
    let linear = matches!(
        scene.stop,
        Stop::Rigid { .. }
            | Stop::Preloaded { .. }
            | Stop::KelvinVoigt {
                release: Release::Clearance,
                ..
            }
    );
    linear && scene.rigid.is_none()
}

fn batch(count: usize) -> Batch {
    batch_of((0..count).map(scene).collect())
}

fn batch_of(scenes: Vec<Scene>) -> Batch {
    let machines = scenes
        .iter()
        .map(|scene| LoweredMachine::new(&scene.check().expect("valid")));
    let jobs = scenes.iter().enumerate().map(|(machine, scene)| Job {
        machine,
        start: start(machine, scene),
        periods: PERIODS,
    });
    Batch {
        machines: machines.collect(),
        jobs: jobs.collect(),
        scenes: scenes.clone(),
    }
}

#[test]
fn lanes_find_the_impacts_and_states_of_the_scalar_engine() {
    compare(batch(6000));
}

#[test]
fn plain_machines_among_themselves_do_too() {
    let plain: Vec<Scene> = (0..12_000).map(scene).filter(is_plain).collect();
    assert!(plain.len() > 4000, "{}", plain.len());
    compare(batch_of(plain));
}

#[test]
fn pressed_faces_and_contacts_that_must_not_pull_stay_in_lanes() {
    let scene = |index: usize| {
        let mut ratios = Ratios::unloaded().at_frequency(between(0.5, 2.0, spread(index, 1)));
        if index.is_multiple_of(2) {
            ratios.clearance = between(0.0, 1.0, spread(index, 2));
        }
        let mut scene = ratios.scene().expect("valid");
        if !index.is_multiple_of(2) {
            scene.stop = kelvin_voigt(100.0, Release::ZeroForce);
        }
        scene
    };
    let handed = compare(batch_of((0..2000).map(scene).collect()));
    assert!(handed < 0.01, "{handed} of the periods handed over");
}

/// The share of the periods that lanes hand over.
fn compare(batch: Batch) -> f64 {
    let Batch {
        machines,
        jobs,
        scenes,
    } = batch;
    let outcomes = run(&machines, &jobs, &mut ());
    let (mut compared, mut handed) = (0, 0);
    for (index, (outcome, job)) in outcomes.iter().zip(&jobs).enumerate() {
        assert_eq!(outcome.error, None, "{index}");
        let (end, impacts) = scalar(&scenes[index], job.start);
        handed += outcome.handed_over;
        let off = distance(outcome.end, end);
        if outcome.impacts != impacts || off > 1e-9 {
            let growth = largest_growth(&scenes[index], job.start, end);
            let chaotic = growth > 1e6;
            assert!(
                chaotic || (outcome.impacts == impacts && off < 1e-10 * growth),
                "{index}: {} impacts for {impacts}, off by {off:e}, growth {growth:e}",
                outcome.impacts,
            );
        } else {
            compared += 1;
        }
    }
    let share = compared as f64 / jobs.len() as f64;
    assert!(share > 0.9, "{compared} compared");
    let handed = handed as f64 / (jobs.len() as f64 * PERIODS as f64);
    assert!(handed < 0.1, "{handed} of the periods handed over");
    handed
}

#[test]
fn instructions_that_round_otherwise_give_nearly_the_same_motions() {
    let Batch { machines, jobs, .. } = batch(600);
    let widest = run(&machines, &jobs, &mut ());
    let others = run_with(InstructionLimit::Portable, &machines, &jobs, &mut ());
    let agree = widest
        .iter()
        .zip(&others)
        .filter(|(a, b)| a.impacts == b.impacts && distance(a.end, b.end) < 1e-8)
        .count();
    assert!(agree > 570, "{agree}");
}

/// One motion has one answer: whatever the width of the registers, and whoever is in the other lanes.
#[test]
fn a_motion_does_not_depend_on_its_neighbours() {
    let Batch { machines, jobs, .. } = leaps::long(600);
    let widest = run(&machines, &jobs, &mut ());
    assert_eq!(
        run_with(InstructionLimit::Avx2, &machines, &jobs, &mut ()),
        widest
    );
    assert_eq!(run_one_by_one(&machines, &jobs, &mut ()), widest);
    let backwards: Vec<Job> = jobs.iter().rev().copied().collect();
    let mut turned = run(&machines, &backwards, &mut ());
    turned.reverse();
    assert_eq!(turned, widest);
    for (block, expected) in jobs.chunks(7).zip(widest.chunks(7)) {
        assert_eq!(run(&machines, block, &mut ()), expected);
    }
}

#[test]
fn the_watcher_hears_of_every_impact_and_period() {
    let scene = Ratios::unloaded().scene().expect("valid");
    let starts = (0..40).map(|index| start(index, &scene));
    compare_told(&scene, starts.collect());
}

/// A bounce is faint or not by the speed after the impact before it.
#[test]
fn bounces_that_hardly_rebound_count_as_in_the_scalar_engine() {
    for restitution in [0.0, 1e-12, 1e-9, 1e-6, 1e-3] {
        for index in 0..20 {
            let ratios = Ratios::unloaded().at_frequency(between(0.8, 2.4, spread(index, 1)));
            let mut scene = ratios.scene().expect("valid");
            scene.stop = Stop::Rigid { restitution };
            scene.clearance = between(0.0, 1.0, spread(index, 2));
            compare_told(&scene, vec![Start::REST]);
        }
    }
}

/// Compares what a watcher of these motions of a machine hears with the scalar engine's trajectories.
fn compare_told(scene: &Scene, starts: Vec<Start>) {
    #[derive(Default)]
    struct Heard {
        impacts: HashMap<usize, Vec<(f64, f64)>>,
        periods: HashMap<usize, Vec<(u64, Start)>>,
        period: f64,
    }
    impl BatchObserver for Heard {
        fn observed(&self) -> (bool, bool) {
            (true, true)
        }
        fn impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64) {
            let time = cycle as f64 * self.period + offset;
            self.impacts.entry(job).or_default().push((time, velocity));
        }
        fn period(&mut self, job: usize, cycle: u64, state: Start) {
            self.periods.entry(job).or_default().push((cycle, state));
        }
    }
    let machines = [LoweredMachine::new(&scene.check().expect("valid"))];
    let job = |start| Job {
        machine: 0,
        start,
        periods: PERIODS,
    };
    let jobs: Vec<Job> = starts.into_iter().map(job).collect();
    let mut heard = Heard {
        period: scene.period(),
        ..Heard::default()
    };
    run(&machines, &jobs, &mut heard);
    for (index, job) in jobs.iter().enumerate() {
        let motion = scene.trajectory(job.start, PERIODS).expect("bounded");
        let expected: Vec<_> = motion.impacts().collect();
        let found = heard.impacts.remove(&index).unwrap_or_default();
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().zip(&expected) {
            assert_near(found.0, motion.clock.time(expected.instant), 10.0 * SOLVED);
            assert_near(found.1, expected.before_impact_velocity, GROWN);
        }
        let periods = &heard.periods[&index];
        assert_eq!(periods.len() as u64, PERIODS);
        for (place, (cycle, state)) in periods.iter().enumerate() {
            assert_eq!(*cycle, place as u64 + 1);
            let exact = motion.at(Clock::at_cycle(*cycle)).unwrap_or(motion.end);
            assert!(distance(*state, exact) < 1e-8);
        }
    }
}
