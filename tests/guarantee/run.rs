//! Runs numbered cases on all processors.

use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use super::cases::case;
use super::check::{Stop, check};
use super::law::Machine;
use super::record::{Leg, Refusal, record};
use super::tally::Tally;

/// Crossings that are checked in one case.
pub const MOST: usize = 60;
const CHUNK: u64 = 64;

/// The tally of one seed.
pub fn one(seed: u64) -> Tally {
    let mut tally = Tally {
        cases: 1,
        ..Tally::default()
    };
    let case = case(seed);
    let legs = match record(&case.scene, case.start, case.periods, MOST) {
        Ok(legs) => legs,
        // Bounces on a stiff face that the drive presses: too many to follow, and said so.
        Err(Refusal::Endless) => {
            tally.refused = 1;
            return tally;
        }
        Err(Refusal::Failure(refusal)) => {
            tally
                .failures
                .push(format!("seed {seed}: {refusal}\n{case:?}"));
            return tally;
        }
    };
    let machine = Machine::new(&case.scene);
    match check(&machine, &legs, &mut tally) {
        Ok(()) => {}
        Err((_, Stop::Cut)) => tally.cut = 1,
        Err((_, Stop::Undecidable)) => tally.left = 1,
        Err((index, Stop::Wrong(what))) => {
            let shown = |leg: Option<&Leg>| leg.map_or(String::new(), |leg| format!("{leg:?}"));
            tally.failures.push(format!(
                "seed {seed}, leg {index}: {what}\n  scene {:?}\n  start {:?}\n  leg {}\n  next {}",
                case.scene,
                case.start,
                shown(legs.get(index)),
                shown(legs.get(index + 1)),
            ));
        }
    }
    tally
}

/// The tally of a range of seeds.
pub fn many(first: u64, count: u64) -> Tally {
    let (next, sum) = (AtomicU64::new(first), Mutex::new(Tally::default()));
    let end = first + count;
    let work = || loop {
        let begin = next.fetch_add(CHUNK, Ordering::Relaxed);
        if begin >= end {
            return;
        }
        let mut part = Tally::default();
        for seed in begin..end.min(begin + CHUNK) {
            part.add(one(seed));
        }
        sum.lock()
            .expect("no thread panics with the lock")
            .add(part);
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(work);
        }
    });
    sum.into_inner().expect("no thread panics with the lock")
}
