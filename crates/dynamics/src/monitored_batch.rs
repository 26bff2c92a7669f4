//! Batches of motions in the lanes, which end at once where a monitor wants to stop.

use std::ops::ControlFlow;

use softstop::Start;
use softstop::internals::budget;
use softstop_lanes::{BatchObserver, Job, LoweredMachine, Outcome};

/// Follows motions (machine index, state, drive periods) in the lanes on this thread and charges their work to the budget. `ask`
/// is asked now and then whether to go on; none if it or the budget ended the batch.
pub(crate) fn follow_batch(
    machines: &[LoweredMachine],
    motions: impl IntoIterator<Item = (usize, Start, u64)>,
    watch: &mut dyn BatchObserver,
    ask: impl FnMut() -> ControlFlow<()>,
) -> Option<Vec<Outcome>> {
    let job = |(machine, start, periods)| Job {
        machine,
        start,
        periods,
    };
    let jobs: Vec<Job> = motions.into_iter().map(job).collect();
    let mut asking = MonitoredObserver {
        watch,
        ask,
        answer: ControlFlow::Continue(()),
        left: budget::windows_left(),
    };
    let outcomes = softstop_lanes::run(machines, &jobs, &mut asking);
    budget::charge(BATCH_COST + outcomes.len() as u64);
    asking.answer.is_continue().then_some(outcomes)
}

/// Work of the lanes and the safe engine, in scan windows, between two questions to a batch's monitor.
const WORK_BETWEEN_QUESTIONS: u64 = 1 << 15;
/// Charge to the budget for a unit of the lanes' own work, in scan windows.
const LANE_WORK_COST: u64 = 2;
/// Charge to the budget for a batch besides its work, in scan windows: it may end before the first question.
const BATCH_COST: u64 = 1 << 10;

/// Passes on to an observer what happens in a batch, charges its work to the budget, and asks a monitor.
struct MonitoredObserver<'a, A> {
    watch: &'a mut dyn BatchObserver,
    ask: A,
    answer: ControlFlow<()>,
    /// Scan windows of the budget that were left when the monitor was asked last.
    left: u64,
}

impl<A: FnMut() -> ControlFlow<()>> BatchObserver for MonitoredObserver<'_, A> {
    fn observed(&self) -> (bool, bool) {
        self.watch.observed()
    }

    fn impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64) {
        self.watch.impact(job, cycle, offset, velocity);
    }

    fn period(&mut self, job: usize, cycle: u64, state: Start) {
        self.watch.period(job, cycle, state);
    }

    fn goes_on(&mut self) -> ControlFlow<()> {
        // The engine that motions are handed over to has charged its part.
        let charged = self.left.saturating_sub(budget::windows_left());
        let is_left =
            budget::charge(LANE_WORK_COST * WORK_BETWEEN_QUESTIONS.saturating_sub(charged));
        self.left = budget::windows_left();
        self.answer = match is_left {
            true => (self.ask)(),
            // What the motions have come to is discarded with all the work.
            false => ControlFlow::Break(()),
        };
        self.answer
    }
}
