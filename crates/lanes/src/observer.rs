//! Observers of a batch: told of impacts and of the ends of drive periods.

use std::ops::ControlFlow;

use softstop::Start;

/// Watches the motions of a batch. To add one, implement what it needs and say so in the constants.
pub trait BatchObserver {
    /// True if it wants to know of impacts.
    const IMPACTS: bool = false;
    /// True if it wants to know of the ends of drive periods.
    const PERIODS: bool = false;

    /// A mass touches, `offset` seconds into the drive period `cycle`, with this velocity towards the stop.
    fn impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64) {
        let _ = (job, cycle, offset, velocity);
    }

    /// Drive period `cycle` has begun.
    fn period(&mut self, job: usize, cycle: u64, state: Start) {
        let _ = (job, cycle, state);
    }

    /// Whether the batch goes on; asked hundreds of times a second. What is left of it stays where it is.
    fn goes_on(&mut self) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// Watches nothing.
impl BatchObserver for () {}

/// An observer of any type, so that the engine is compiled once for all.
pub(super) struct ObserverHandle<'a> {
    watch: &'a mut dyn DynamicObserver,
    /// Whether it is told of impacts and of periods.
    pub impacts: bool,
    pub periods: bool,
    /// Work in scan windows since it was asked whether the batch goes on.
    work: u64,
    /// The answer of the observer then.
    answer: ControlFlow<()>,
}

/// Work after which the observer is asked again whether the batch goes on, in scan windows: a millisecond, or a few.
const WORK_BETWEEN_QUESTIONS: u64 = 1 << 15;

impl<'a> ObserverHandle<'a> {
    /// The handle of an observer.
    pub fn new<W: BatchObserver>(watch: &'a mut W) -> Self {
        Self {
            watch,
            impacts: W::IMPACTS,
            periods: W::PERIODS,
            work: 0,
            answer: ControlFlow::Continue(()),
        }
    }

    /// Counts work, in scan windows; whether the batch goes on.
    pub fn count_work(&mut self, windows: u64) -> ControlFlow<()> {
        self.work += windows;
        if self.work >= WORK_BETWEEN_QUESTIONS && self.answer.is_continue() {
            (self.work, self.answer) = (0, self.watch.ask_to_go_on());
        }
        self.answer
    }

    /// As [`BatchObserver::impact`].
    pub fn tell_impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64) {
        self.watch.tell_impact(job, cycle, offset, velocity);
    }

    /// As [`BatchObserver::period`].
    pub fn tell_period(&mut self, job: usize, cycle: u64, state: Start) {
        self.watch.tell_period(job, cycle, state);
    }
}

/// [`BatchObserver`] without its constants.
trait DynamicObserver {
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
