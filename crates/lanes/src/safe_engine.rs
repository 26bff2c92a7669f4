//! Follows motions with the safe engine: what lanes cannot decide, up to the end of a drive period.

use std::ops::ControlFlow;

use super::batch_observer::ObserverHandle;
use super::job::Outcome;
use super::lowered_machine::LoweredMachine;
use softstop::internals::{Mode, Motion};
use softstop::{Clock, Crossing, Instant, MotionError, Observer, Start};

/// The state of a job's motion where the safe engine takes it over from a lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct SafeStart {
    pub job: usize,
    /// Whole drive periods so far, and seconds into the present one.
    pub cycle: u64,
    pub offset: f64,
    pub state: Start,
    /// The phase it moves in; none where its state tells.
    pub phase: Option<usize>,
}

/// The state of a motion where a lane takes it up again from the safe engine, at the beginning of a drive period.
#[derive(Debug, Clone, Copy)]
pub(super) struct Resumed {
    pub cycle: u64,
    pub state: Start,
    /// The phase it moves in.
    pub phase: usize,
}

/// The phase in which the motion from a start moves; none if it does not move, or in no phase that lanes can follow.
///
/// # Errors
/// [`MotionError`] if it cannot start there.
pub(super) fn start_phase(
    machine: &LoweredMachine,
    start: Start,
) -> Result<Option<usize>, MotionError> {
    start.validate()?;
    if machine.is_free_at(start.position) {
        return Ok(Some(0));
    }
    let at = Clock::at_cycle(0);
    let motion = Motion::new(machine.scene(), at, start)?;
    Ok(lane_phase(machine, &motion))
}

/// The phase in which a motion of the safe engine moves; none if it does not move, or in no phase that lanes can follow.
fn lane_phase(machine: &LoweredMachine, motion: &Motion) -> Option<usize> {
    match motion.mode() {
        Mode::Moving(phase) if machine.is_for_lanes() => Some(phase.index()),
        _ => None,
    }
}

/// Follows a motion with the safe engine to the next beginning of a drive period at which it moves in a phase that lanes can
/// follow; none if that is not before its end after `periods`.
pub(super) fn follow_safely(
    machine: &LoweredMachine,
    place: SafeStart,
    periods: u64,
    watch: &mut ObserverHandle<'_>,
    outcome: &mut Outcome,
) -> Result<Option<Resumed>, MotionError> {
    let at = Instant {
        cycles: place.cycle as f64,
        offset: place.offset,
    };
    let mut motion = Motion::new(machine.scene(), at, place.state)?;
    if let Some(phase) = place.phase {
        motion.assume_phase(phase);
    }
    let mut counter = Counter {
        job: place.job,
        watch,
        impacts: 0,
        crossings: 0,
    };
    let mut followed = Ok(None);
    let mut kept: Option<KeptPeriod> = None;
    let mut cycle = place.cycle;
    while cycle < periods {
        cycle += 1;
        if let Err(error) = motion.advance(Clock::at_cycle(cycle), &mut counter) {
            followed = Err(error);
            break;
        }
        if counter.progress(WORK_PER_PERIOD).is_break() {
            break;
        }
        outcome.handed_over += 1;
        let state = motion.state();
        outcome.end = state;
        if counter.watch.periods {
            counter.watch.tell_period(place.job, cycle, state);
        }
        if cycle < periods
            && let Some(phase) = lane_phase(machine, &motion)
        {
            followed = Ok(Some(Resumed {
                cycle,
                state,
                phase,
            }));
            break;
        }
        if counter.watch.impacts || counter.watch.periods {
            continue;
        }
        let counts = [cycle, counter.impacts, counter.crossings];
        match &kept {
            Some(kept) if motion.repeats(&kept.motion) => {
                let [lasts, impacts, crossings] = [0, 1, 2].map(|it| counts[it] - kept.counts[it]);
                let times = (periods - cycle) / lasts;
                motion.skip_periods(times * lasts);
                cycle += times * lasts;
                outcome.handed_over += times * lasts;
                counter.impacts += times * impacts;
                counter.crossings += times * crossings;
            }
            Some(kept) if cycle < 2 * kept.counts[0] - place.cycle => {}
            _ => {
                let motion = motion.clone();
                kept = Some(KeptPeriod { motion, counts });
            }
        }
    }
    outcome.impacts += counter.impacts;
    outcome.crossings += counter.crossings;
    followed
}

/// A motion of the safe engine at the end of a drive period, to find that later periods repeat it. It is renewed when twice as
/// many have gone by, so that it comes to lie on what the motion settles on (Brent, BIT 20, 1980).
struct KeptPeriod {
    motion: Motion,
    /// Drive periods, impacts and crossings by then.
    counts: [u64; 3],
}

/// Work of the safe engine in a drive period besides its crossings, in scan windows.
const WORK_PER_PERIOD: u64 = 16;

struct Counter<'a, 'b> {
    job: usize,
    watch: &'a mut ObserverHandle<'b>,
    impacts: u64,
    crossings: u64,
}

impl Observer for Counter<'_, '_> {
    fn crossing(&mut self, crossing: &Crossing) {
        self.crossings += 1;
        if let Some(velocity) = crossing.impact_velocity() {
            self.impacts += 1;
            if self.watch.impacts {
                let Instant { cycles, offset } = crossing.instant;
                self.watch
                    .tell_impact(self.job, cycles as u64, offset, velocity);
            }
        }
    }
    fn progress(&mut self, windows: u64) -> ControlFlow<()> {
        self.watch.count_work(windows)
    }
}
