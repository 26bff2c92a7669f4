//! Motions that are followed, and what is written down of them.

use std::ops::ControlFlow;

use crate::batch::follow;
use softstop::internals::budget;
use softstop::{Instant, MotionError, Start};
use softstop_lanes::{BatchObserver, Machine};

/// Follows motions, each of the machine with this number from a state, first unwatched, then watched; none if they were
/// stopped on the way.
pub(crate) fn watched(
    machines: &[Machine],
    starts: &[(usize, Start)],
    settling: u64,
    watched: u64,
    ask: impl Fn() -> ControlFlow<()>,
) -> Option<Vec<Result<MotionRecord, MotionError>>> {
    let from = starts.iter();
    let from = from.map(|(machine, start)| (*machine, *start, settling));
    let settled = follow(machines, from, &mut (), &ask)?;
    let records = settled.iter();
    let records = records.map(|outcome| MotionRecord::new(outcome.end, watched as usize));
    let mut log = RecordLog {
        periods: watched as usize,
        records: records.collect(),
    };
    let on = starts.iter().zip(&settled);
    let on = on.map(|((machine, _), outcome)| (*machine, outcome.end, watched));
    let outcomes = follow(machines, on, &mut log, &ask)?;
    let errors = settled.into_iter().zip(outcomes);
    let errors = errors.map(|(settled, outcome)| settled.error.or(outcome.error));
    let records = log.records.into_iter().zip(errors);
    let records = records.map(|(record, error)| error.map_or(Ok(record), Err));
    Some(records.collect())
}

/// What is seen of one motion.
#[derive(Debug, Clone)]
pub(crate) struct MotionRecord {
    /// States at drive angle phi: that at the beginning, and one after each drive period.
    pub states: Vec<Start>,
    /// When, from the beginning on, and before-impact velocity in m/s of each impact.
    pub impacts: Vec<(Instant, f64)>,
}

impl MotionRecord {
    fn new(start: Start, periods: usize) -> Self {
        let mut states = Vec::with_capacity(periods + 1);
        states.push(start);
        Self {
            states,
            impacts: Vec::new(),
        }
    }
}

/// What an impact or a period that is kept costs, in scan windows.
const KEPT: u64 = 32;

/// Keeps records.
struct RecordLog {
    /// How long they are.
    periods: usize,
    records: Vec<MotionRecord>,
}

impl BatchObserver for RecordLog {
    const IMPACTS: bool = true;
    const PERIODS: bool = true;

    fn impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64) {
        let instant = Instant {
            cycles: cycle as f64,
            offset,
        };
        let impacts = &mut self.records[job].impacts;
        if impacts.capacity() == 0 {
            impacts.reserve(self.periods);
        }
        // What is kept costs, so that a budget is one of memory, too.
        if budget::charge(KEPT) {
            impacts.push((instant, velocity));
        }
    }

    fn period(&mut self, job: usize, _: u64, state: Start) {
        budget::charge(KEPT);
        self.records[job].states.push(state);
    }
}
