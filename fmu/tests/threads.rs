//! Instances that wander between threads: made in one, stepped in others, freed in the last.
#![allow(unsafe_code, reason = "calls the C functions as an importer does")]

use std::ops::Range;
use std::thread;

use crate::common::{OK, Unit};

const THREADS: usize = 4;
/// Units of each.
const SHARE: usize = 50;
const STEPS: usize = 30;

/// An instance on its way to another thread.
struct Parcel(Unit);

// SAFETY: the standard lets an importer call an instance from any thread, one at a time; a parcel has
// one owner.
unsafe impl Send for Parcel {}

fn make(number: usize) -> Parcel {
    let unit = Unit::new();
    let velocity = 9.0 + 0.01 * number as f64;
    assert_eq!(unit.set("initial.velocity", velocity), OK);
    unit.begin();
    Parcel(unit)
}

fn advance(Parcel(unit): &Parcel, steps: Range<usize>) {
    for k in steps {
        assert_eq!(unit.set("force", 0.01 * (k % 7) as f64), OK);
        assert_eq!(unit.step(0.7 * k as f64, 0.7), OK);
    }
}

fn outputs(Parcel(unit): &Parcel) -> Vec<u64> {
    let names = [
        "position",
        "velocity",
        "energy.supplied",
        "energy.dissipated",
        "impact.time",
    ];
    assert!(unit.take_log().is_empty());
    names.map(|name| unit.get(name).to_bits()).to_vec()
}

/// Units of one thread each, made by it.
fn made_in_threads() -> Vec<Parcel> {
    thread::scope(|scope| {
        let share = |thread: usize| (thread * SHARE..(thread + 1) * SHARE).map(make);
        let spawn = |thread| scope.spawn(move || share(thread).collect::<Vec<_>>());
        let running: Vec<_> = (0..THREADS).map(spawn).collect();
        let made = running
            .into_iter()
            .map(|thread| thread.join().expect("no panic"));
        made.flatten().collect()
    })
}

#[test]
fn results_do_not_depend_on_threads() {
    let alone: Vec<_> = (0..THREADS * SHARE)
        .map(|number| {
            let unit = make(number);
            advance(&unit, 0..STEPS);
            outputs(&unit)
        })
        .collect();
    assert_ne!(alone[0], alone[1]);

    let mut units = made_in_threads();
    // Each turn hands every unit to another thread.
    for turn in 0..3 {
        units.rotate_left(SHARE);
        let steps = STEPS * turn / 3..STEPS * (turn + 1) / 3;
        thread::scope(|scope| {
            for share in units.chunks_mut(SHARE) {
                let steps = steps.clone();
                scope.spawn(move || share.iter_mut().for_each(|it| advance(it, steps.clone())));
            }
        });
    }
    units.rotate_right(3 * SHARE);
    let freed = thread::spawn(move || units.into_iter().map(|unit| outputs(&unit)).collect());
    let together: Vec<_> = freed.join().expect("no panic");
    assert!(together == alone);
}
