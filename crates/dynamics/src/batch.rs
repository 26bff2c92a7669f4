//! Batches of motions that end at once where a watcher wants to stop.

use std::ops::ControlFlow;

use softstop::Start;
use softstop_lanes::{Job, Machine, Outcome, Watch};

/// Follows all jobs on this thread; none if they were stopped on the way.
pub(crate) fn follow<W: Watch>(
    machines: &[Machine],
    jobs: &[Job],
    watch: &mut W,
    ask: impl FnMut() -> ControlFlow<()>,
) -> Option<Vec<Outcome>> {
    let mut asking = Asking {
        watch,
        ask,
        answer: ControlFlow::Continue(()),
    };
    let outcomes = softstop_lanes::run(machines, jobs, &mut asking);
    asking.answer.is_continue().then_some(outcomes)
}

/// A watch that asks whether to go on.
struct Asking<'a, W, A> {
    watch: &'a mut W,
    ask: A,
    answer: ControlFlow<()>,
}

impl<W: Watch, A: FnMut() -> ControlFlow<()>> Watch for Asking<'_, W, A> {
    const IMPACTS: bool = W::IMPACTS;
    const PERIODS: bool = W::PERIODS;

    fn impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64) {
        self.watch.impact(job, cycle, offset, velocity);
    }

    fn period(&mut self, job: usize, cycle: u64, state: Start) {
        self.watch.period(job, cycle, state);
    }

    fn goes_on(&mut self) -> ControlFlow<()> {
        self.answer = (self.ask)();
        self.answer
    }
}
