//! What the stops cost: time of the exact integrator for 200 drive periods with one in the place of the preloaded one, at
//! eta = 1.15 from (6.9, 9.5). `softstop-lab throughput` measures periods per second of the engines. Reproduce with
//! `cargo xtask bench`.

#![allow(
    missing_docs,
    reason = "criterion's macros generate undocumented items"
)]

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use softstop::{Clock, Ratios, Release, Scene, Start, Stop};

/// Drive periods of a run.
const PERIODS: u64 = 200;

fn run(scene: &Scene) {
    let mut motion = scene.motion(Start::new(6.9, 9.5)).expect("valid");
    motion
        .advance(Clock::at_cycle(PERIODS), &mut ())
        .expect("bounded");
    black_box(motion.state());
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
        group.bench_function(name, |bencher| bencher.iter(|| run(&scene)));
    }
    group.finish();
}

criterion_group!(benches, kinds);
criterion_main!(benches);
