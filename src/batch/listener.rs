//! Any watcher behind one type, so that the lanes' loop is compiled but once for each instruction set.

use super::Watch;
use crate::integrator::Start;

/// A watcher and what it wants to know.
pub(super) struct Listener<'a> {
    /// Of impacts.
    pub impacts: bool,
    /// Of the ends of drive periods.
    pub periods: bool,
    watch: &'a mut dyn Hear,
}

/// [`Watch`] without its constants.
trait Hear {
    fn hear_impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64);
    fn hear_period(&mut self, job: usize, cycle: u64, state: Start);
}

impl<W: Watch> Hear for W {
    fn hear_impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64) {
        self.impact(job, cycle, offset, velocity);
    }

    fn hear_period(&mut self, job: usize, cycle: u64, state: Start) {
        self.period(job, cycle, state);
    }
}

impl<'a> Listener<'a> {
    pub fn new<W: Watch>(watch: &'a mut W) -> Self {
        Self {
            impacts: W::IMPACTS,
            periods: W::PERIODS,
            watch,
        }
    }

    pub fn impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64) {
        self.watch.hear_impact(job, cycle, offset, velocity);
    }

    pub fn period(&mut self, job: usize, cycle: u64, state: Start) {
        self.watch.hear_period(job, cycle, state);
    }
}
