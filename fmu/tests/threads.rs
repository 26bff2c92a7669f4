//! Instances that wander between threads: made in one, stepped in others, freed in the last.
#![allow(unsafe_code, reason = "calls the C functions as an importer does")]

use std::thread;

use crate::common::{OK, Unit};

const THREADS: usize = 4;
const UNITS: usize = 200;
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

fn advance(Parcel(unit): &Parcel, from: usize, to: usize) {
    for k in from..to {
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
    let values = names.map(|name| unit.get(name).to_bits());
    assert!(unit.take_log().is_empty());
    values.to_vec()
}

/// Runs `work` on shares of the units in several threads; the shares come back in order.
fn in_threads<T: Send, U: Send>(all: Vec<T>, work: impl Fn(T) -> U + Sync) -> Vec<U> {
    let mut shares: Vec<Vec<T>> = (0..THREADS).map(|_| Vec::new()).collect();
    for (number, one) in all.into_iter().enumerate() {
        shares[number % THREADS].push(one);
    }
    let done = thread::scope(|scope| {
        let running: Vec<_> = shares
            .into_iter()
            .map(|share| scope.spawn(|| share.into_iter().map(&work).collect::<Vec<_>>()))
            .collect();
        running
            .into_iter()
            .map(|thread| thread.join().expect("no panic"))
            .collect::<Vec<_>>()
    });
    let mut shares: Vec<_> = done.into_iter().map(Vec::into_iter).collect();
    let count = shares.iter().map(|share| share.len()).sum();
    (0..count)
        .map(|number| shares[number % THREADS].next().expect("as many as before"))
        .collect()
}

#[test]
fn results_do_not_depend_on_threads() {
    let alone: Vec<_> = (0..UNITS)
        .map(|number| {
            let unit = make(number);
            advance(&unit, 0, STEPS);
            outputs(&unit)
        })
        .collect();
    assert_ne!(alone[0], alone[1]);

    let mut units = in_threads((0..UNITS).collect(), make);
    // Each turn hands every unit to another thread.
    for turn in 0..3 {
        units.rotate_left(1);
        units = in_threads(units, |unit| {
            advance(&unit, STEPS * turn / 3, STEPS * (turn + 1) / 3);
            unit
        });
    }
    units.rotate_right(3);
    let together = in_threads(units, |unit| outputs(&unit));
    assert!(together == alone);
}
