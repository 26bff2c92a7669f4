//! Many motions of one scene, carried on together.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use crate::batch::follow;
use crate::monitor::{Monitor, stop_if};
use crate::orbit::OrbitError;
use softstop::internals::budget::{self, Fork};
use softstop::{MotionError, Scene, Start};
use softstop_lanes::{BatchObserver, Machine};

/// Motions that one thread follows at a time: several times as many as there are lanes.
const MEMBERS_AT_ONCE: usize = 64;

/// Drive periods for which they are followed before the monitor is asked again, where many motions cost little and
/// where they do not: a third of a second.
const PERIODS_AT_ONCE: (u64, u64) = (1 << 16, 256);

/// One motion.
#[derive(Debug, Clone)]
pub(crate) struct EnsembleMember {
    /// Its latest state at drive angle phi.
    pub state: Start,
    /// Its last states there, in order of time; the latest is the last.
    pub log: Vec<Start>,
    /// Why it ended.
    pub error: Option<MotionError>,
}

impl EnsembleMember {
    pub(crate) fn new(state: Start) -> Self {
        Self {
            state,
            log: Vec::new(),
            error: None,
        }
    }
}

/// The machine they share, and how much work has been done.
pub(crate) struct Ensemble<'a> {
    pub machine: [Machine; 1],
    monitor: Monitor<'a>,
    done: AtomicU64,
    /// Work that will be done at most, in drive periods unless its owner counts otherwise.
    pub planned: u64,
}

impl<'a> Ensemble<'a> {
    pub(crate) fn new(scene: &Scene, monitor: Monitor<'a>) -> Result<Self, OrbitError> {
        Ok(Self {
            machine: [Machine::new(scene)?],
            monitor,
            done: AtomicU64::new(0),
            planned: 0,
        })
    }

    /// True if many motions cost little.
    pub(crate) fn is_fast(&self) -> bool {
        self.machine[0].is_for_lanes()
    }

    /// True if long motions that settle cost as little as short ones.
    pub(crate) fn leaps(&self) -> bool {
        self.machine[0].leaps()
    }

    pub(crate) fn done(&self) -> u64 {
        self.done.load(Ordering::Relaxed)
    }

    /// Counts work; an error if the monitor wants to stop, or the budget is spent.
    pub(crate) fn note(&self, periods: u64) -> Result<(), OrbitError> {
        let done = self.done.fetch_add(periods, Ordering::Relaxed) + periods;
        match (self.monitor)(done, self.planned.max(done)) {
            ControlFlow::Continue(()) if !budget::is_spent() => Ok(()),
            _ => Err(OrbitError::Stopped),
        }
    }

    /// Carries all on for `periods` drive periods and keeps a log of the last `logged` of them.
    pub(crate) fn advance(
        &self,
        members: &mut [&mut EnsembleMember],
        periods: u64,
        logged: usize,
    ) -> Result<(), OrbitError> {
        let fork = Fork::default();
        let chunks = members.par_chunks_mut(MEMBERS_AT_ONCE);
        let sailed = chunks
            .try_for_each(|chunk| fork.part(|| self.advance_together(chunk, periods, logged)));
        fork.join();
        sailed
    }

    /// Carries motions on in stretches, so that the monitor is asked often.
    fn advance_together(
        &self,
        members: &mut [&mut EnsembleMember],
        periods: u64,
        logged: usize,
    ) -> Result<(), OrbitError> {
        let stretch = if self.is_fast() {
            PERIODS_AT_ONCE.0
        } else {
            PERIODS_AT_ONCE.1
        };
        let logged = periods.min(logged as u64);
        let mut left = periods - logged;
        while left > 0 {
            let now = left.min(stretch);
            self.advance_by(members, now, &mut ())?;
            left -= now;
        }
        let mut log = Log(vec![Vec::with_capacity(logged as usize); members.len()]);
        self.advance_by(members, logged, &mut log)?;
        for (member, log) in members.iter_mut().zip(log.0) {
            member.log = log;
        }
        Ok(())
    }

    /// Carries those on that can be, under a watch that knows them by their numbers.
    fn advance_by(
        &self,
        members: &mut [&mut EnsembleMember],
        periods: u64,
        watch: &mut impl BatchObserver,
    ) -> Result<(), OrbitError> {
        let open = members.iter().filter(|member| member.error.is_none());
        let all = periods * open.count() as u64;
        let lasts = |member: &EnsembleMember| if member.error.is_none() { periods } else { 0 };
        let motions = members.iter().map(|it| (0, it.state, lasts(it)));
        let ask = || stop_if(self.note(0).is_err());
        let outcomes = follow(&self.machine, motions, watch, ask).ok_or(OrbitError::Stopped)?;
        let open = members.iter_mut().zip(outcomes);
        for (member, outcome) in open.filter(|(member, _)| member.error.is_none()) {
            member.state = outcome.end;
            member.error = outcome.error;
        }
        self.note(all)
    }
}

/// Keeps all states.
struct Log(Vec<Vec<Start>>);

impl BatchObserver for Log {
    const PERIODS: bool = true;

    fn period(&mut self, job: usize, _: u64, state: Start) {
        self.0[job].push(state);
    }
}
