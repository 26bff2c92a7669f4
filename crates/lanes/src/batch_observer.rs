//! Observers of a batch: told of impacts and of the ends of drive periods.

use std::ops::ControlFlow;

use softstop::Start;

/// An observer of the motions of a batch: it implements what it observes, and sets the constants for that to true.
pub trait BatchObserver {
    /// True if the observer is told of impacts.
    const IMPACTS: bool = false;
    /// True if the observer is told of the ends of drive periods.
    const PERIODS: bool = false;

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

/// An observer of whatever type behind one type, so that the engine is compiled once for all observers.
pub(super) struct ObserverHandle<'a> {
    pub observer: &'a mut dyn DynamicObserver,
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
    /// Wraps an observer.
    pub fn new<W: BatchObserver>(observer: &'a mut W) -> Self {
        Self {
            observer,
            impacts: W::IMPACTS,
            periods: W::PERIODS,
            work: 0,
            answer: ControlFlow::Continue(()),
        }
    }

    /// Counts work, in scan windows, and asks the observer from time to time; returns its last answer.
    pub fn count_work(&mut self, windows: u64) -> ControlFlow<()> {
        self.work += windows;
        if self.work >= WORK_BETWEEN_QUESTIONS && self.answer.is_continue() {
            (self.work, self.answer) = (0, self.observer.ask_to_go_on());
        }
        self.answer
    }
}

/// The methods of [`BatchObserver`] without its constants, so that it can be a trait object.
pub(super) trait DynamicObserver {
    fn tell_impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64);
    fn tell_period(&mut self, job: usize, cycle: u64, state: Start);
    fn ask_to_go_on(&mut self) -> ControlFlow<()>;
}

impl<W: BatchObserver> DynamicObserver for W {
    fn tell_impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64) {
        self.impact(job, cycle, offset, velocity);
    }

    fn tell_period(&mut self, job: usize, cycle: u64, state: Start) {
        self.period(job, cycle, state);
    }

    fn ask_to_go_on(&mut self) -> ControlFlow<()> {
        self.goes_on()
    }
}
