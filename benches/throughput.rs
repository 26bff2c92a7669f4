//! Forcing periods per second of the exact integrator on one core: the unloaded machine at
//! frequencies over 0.95..1.4, 200 periods each from (0, 14). Reproduce with `cargo xtask bench`.

#![allow(
    missing_docs,
    reason = "criterion's macros generate undocumented items"
)]

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use softstop::{Clock, Ratios, Scene, Start};

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

fn run(scenes: &[Scene]) {
    for scene in scenes {
        let mut motion = scene
            .motion(Start {
                position: 0.0,
                velocity: 14.0,
            })
            .expect("valid");
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
        group.bench_function(name, |bencher| bencher.iter(|| run(&scenes)));
    }
    group.finish();
}

criterion_group!(benches, periods);
criterion_main!(benches);
