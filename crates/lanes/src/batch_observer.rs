//! Observers of a batch: told of impacts and of the ends of drive periods.

use std::ops::ControlFlow;

use softstop::Start;

/// An observer of the motions of a batch: it implements what it observes, and says so.
pub trait BatchObserver {
    /// Whether the observer is told of impacts, and of the ends of drive periods.
    fn observed(&self) -> (bool, bool) {
        (false, false)
    }

    /// Told of an impact of a job's motion `offset` seconds into drive period `cycle`, with its velocity towards the stop.
    fn impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64) {
        let _ = (job, cycle, offset, velocity);
    }

    /// Told that a job's motion begins the drive period `cycle` in this state.
    fn period(&mut self, job: usize, cycle: u64, state: Start) {
        let _ = (job, cycle, state);
    }

    /// Asked hundreds of times a second whether the batch goes on; on a break motions stay where they are.
    fn goes_on(&mut self) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// Watches nothing.
impl BatchObserver for () {}

/// An observer of a batch with what it observes, and its latest answer.
pub(super) struct ObserverHandle<'a> {
    observer: &'a mut dyn BatchObserver,
    /// The index of the batch's first job among those that the observer knows.
    first: usize,
    /// Whether it is told of impacts and of periods.
    pub impacts: bool,
    pub periods: bool,
    /// Work in scan windows since it was asked whether the batch goes on.
    work: u64,
    /// The answer of the observer then.
    answer: ControlFlow<()>,
}

/// Work, in scan windows, after which the observer is asked again whether the batch goes on: a millisecond, or a few.
const WORK_BETWEEN_QUESTIONS: u64 = 1 << 15;

impl<'a> ObserverHandle<'a> {
    /// The handle of an observer that knows the batch's first job by the index `first`.
    pub fn new(observer: &'a mut dyn BatchObserver, first: usize) -> Self {
        let (impacts, periods) = observer.observed();
        Self {
            observer,
            first,
            impacts,
            periods,
            work: 0,
            answer: ControlFlow::Continue(()),
        }
    }

    /// Counts work, in scan windows, and asks the observer from time to time; returns its last answer.
    pub fn count_work(&mut self, windows: u64) -> ControlFlow<()> {
        self.work += windows;
        if self.work >= WORK_BETWEEN_QUESTIONS && self.answer.is_continue() {
            (self.work, self.answer) = (0, self.observer.goes_on());
        }
        self.answer
    }

    /// Tells the observer of an impact of a job of the batch.
    pub fn tell_impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64) {
        let job = self.first + job;
        self.observer.impact(job, cycle, offset, velocity);
    }

    /// Tells the observer that a job of the batch begins the drive period `cycle`.
    pub fn tell_period(&mut self, job: usize, cycle: u64, state: Start) {
        self.observer.period(self.first + job, cycle, state);
    }
}
