//! Records that lie: the checker must see it.

use softstop::CrossingKind;

use super::cases::case;
use super::check::{Stop, check};
use super::law::Machine;
use super::motion::{Departure, Motion};
use super::record::{Leg, record};
use super::run::MOST;
use super::tally::Tally;

/// What is done to a record.
#[derive(Debug, Clone, Copy)]
pub enum Lie {
    /// A crossing is left out, so that its leg goes on to the next one.
    Removed,
    /// A crossing is put later by this share of a period.
    Moved(f64),
    /// A surface is claimed to be passed in the middle of a leg.
    Invented,
}

/// How many of the lies in these seeds are told, and how many of those are seen.
pub fn told_and_seen(lie: Lie, seeds: u64) -> (u32, u32) {
    let (mut told, mut seen) = (0, 0);
    for seed in 0..seeds {
        let case = case(seed);
        let Ok(legs) = record(&case.scene, case.start, case.periods, MOST) else {
            continue;
        };
        let machine = Machine::new(&case.scene);
        let Some(doctored) = doctor(&machine, &legs, lie) else {
            continue;
        };
        if check(&machine, &legs, &mut Tally::default()).is_err() {
            continue;
        }
        let verdict = check(&machine, &doctored, &mut Tally::default());
        if matches!(verdict, Err((_, Stop::Cut))) {
            continue;
        }
        told += 1;
        seen += u32::from(matches!(verdict, Err((_, Stop::Wrong(_)))));
    }
    (told, seen)
}

/// Lies about the first passage of a surface between two legs of some length.
fn doctor(machine: &Machine, legs: &[Leg], lie: Lie) -> Option<Vec<Leg>> {
    let long = |leg: &Leg| leg.duration > 0.05 * machine.period() && leg.velocity != 0.0;
    let passes = |leg: &Leg| {
        let end = leg.end.filter(|end| end.velocity.abs() > 0.1);
        end.is_some_and(|end| matches!(end.kind, CrossingKind::Surface { .. }))
    };
    let at = legs
        .windows(2)
        .position(|two| long(&two[0]) && passes(&two[0]) && long(&two[1]))?;
    let mut doctored = legs.to_vec();
    match lie {
        Lie::Removed => {
            let next = doctored.remove(at + 1);
            let leg = &mut doctored[at];
            (leg.duration, leg.end) = (leg.duration + next.duration, next.end);
        }
        Lie::Moved(share) => {
            let shift = share * machine.period();
            doctored[at].duration += shift;
            doctored[at + 1].start.1 += shift;
            doctored[at + 1].angle += shift * machine.frequency;
            doctored[at + 1].duration -= shift;
        }
        Lie::Invented => invent(machine, &mut doctored, at)?,
    }
    Some(doctored)
}

/// Ends a free leg halfway, where the mass really is, as if it passed the clearance there.
fn invent(machine: &Machine, legs: &mut [Leg], at: usize) -> Option<()> {
    let leg = legs[at].clone();
    let half = 0.5 * leg.duration;
    let departure = Departure {
        layer: 0,
        forward: true,
        released: false,
        position: leg.position,
        velocity: leg.velocity,
        angle: leg.angle,
    };
    let free = leg.kind == softstop::PhaseKind::Free;
    let motion = free.then(|| Motion::new(machine, &departure, half, &mut 1000))??;
    let state = motion.end();
    let position = leg.position + state.u;
    let near = legs[at].end.as_mut()?;
    (near.position, near.velocity, near.velocity_after) = (position, state.v, state.v);
    legs[at].duration = half;
    let next = &mut legs[at + 1];
    (next.position, next.velocity) = (position, state.v);
    (next.start.1, next.angle) = (next.start.1 - half, next.angle - half * machine.frequency);
    Some(())
}
