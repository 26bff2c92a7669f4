//! Forcing periods per second of the exact integrator on one core: the unloaded and the loaded machine at
//! frequencies over 0.95..1.4, 200 periods each from (0, 14); and what other stops cost in the place
//! of the preloaded one, at eta = 1.15 from (6.9, 9.5). The same of the batch engine, with each instruction
//! set. Reproduce with `cargo xtask bench`.

#![allow(
    missing_docs,
    reason = "criterion's macros generate undocumented items"
)]

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use softstop::{Clock, Ratios, Release, Scene, Start, Stop};
use softstop_lanes::{Instructions, Job, Machine, run_with};

const FREQUENCIES: u64 = 100;
const PERIODS: u64 = 200;

fn machines(base: Ratios) -> Vec<Scene> {
    (0..FREQUENCIES)
        .map(|k| {
            let share = k as f64 / (FREQUENCIES - 1) as f64;
            let frequency = 0.95 + 0.45 * share;
            Ratios { frequency, ..base }
                .scene()
                .expect("a valid machine")
        })
        .collect()
}

fn run(scenes: &[Scene], position: f64, velocity: f64) {
    for scene in scenes {
        let mut motion = scene.motion(Start::new(position, velocity)).expect("valid");
        motion
            .advance(Clock::at_cycle(PERIODS), &mut ())
            .expect("bounded");
        black_box(motion.state());
    }
}

fn periods(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("forcing periods");
    group.throughput(Throughput::Elements(FREQUENCIES * PERIODS));
    for (name, base) in [
        ("unloaded", Ratios::unloaded()),
        ("loaded", Ratios::loaded()),
    ] {
        let scenes = machines(base);
        group.bench_function(name, |bencher| bencher.iter(|| run(&scenes, 0.0, 14.0)));
        for set in [
            Instructions::Widest,
            Instructions::Avx2,
            Instructions::Portable,
        ] {
            let name = format!("{name}, lanes {set:?}");
            group.bench_function(name, |bencher| bencher.iter(|| lanes(&scenes, set)));
        }
    }
    group.finish();
}

/// The same in lanes, the machines lowered each time as the scalar engine does.
fn lanes(scenes: &[Scene], set: Instructions) {
    let machines: Vec<Machine> = scenes
        .iter()
        .map(|scene| Machine::new(scene).expect("valid"))
        .collect();
    let (position, velocity) = (0.0, 14.0);
    let job = |machine| Job {
        machine,
        start: Start::new(position, velocity),
        periods: PERIODS,
    };
    let jobs: Vec<Job> = (0..machines.len()).map(job).collect();
    black_box(run_with(set, &machines, &jobs, &mut ()));
}

/// The machine at point A with other stops; the stiff one has a contact damping ratio of 0.09.
fn stops() -> Vec<(&'static str, f64, Stop)> {
    let hertz = |exponent| Stop::Hertz {
        stiffness: 100.0,
        exponent,
        dissipation: 0.0,
    };
    let kelvin_voigt = |release| Stop::KelvinVoigt {
        stiffness: 100.0,
        release,
    };
    let preloaded = |stiffness, preload| Stop::Preloaded { stiffness, preload };
    vec![
        ("preloaded", 0.18, preloaded(7.0, 70.0)),
        ("stiff, k4 = 1e6", 180.0, preloaded(1e6, 0.0)),
        ("kelvin-voigt", 0.18, kelvin_voigt(Release::Clearance)),
        (
            "kelvin-voigt, zero force",
            0.18,
            kelvin_voigt(Release::ZeroForce),
        ),
        ("hertz 3/2", 0.18, hertz(1.5)),
        ("hertz 6/5", 0.18, hertz(1.2)),
        ("rigid", 0.04, Stop::Rigid { restitution: 0.6 }),
    ]
}

fn kinds(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("stops");
    group.throughput(Throughput::Elements(PERIODS));
    for (name, contact_damping, stop) in stops() {
        let scene = Scene {
            contact_damping,
            stop,
            ..Ratios::unloaded().scene().expect("valid")
        };
        let scenes = [scene];
        group.bench_function(name, |bencher| bencher.iter(|| run(&scenes, 6.9, 9.5)));
    }
    group.finish();
}

criterion_group!(benches, periods, kinds);
criterion_main!(benches);
