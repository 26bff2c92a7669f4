//! Many motions, each of one of some machines, carried on together until it is known what they have come to.

use std::borrow::Cow;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::batch::follow;
use crate::monitor::{Monitor, stop_if};
use crate::orbit::OrbitError;
use softstop::internals::budget::{self, Fork};
use softstop::{Instant, MotionError, Scene, Start};
use softstop_lanes::{BatchObserver, Machine};

/// Motions that one thread follows at a time: several times as many as there are lanes.
const MEMBERS_AT_ONCE: usize = 64;

/// Drive periods for which they are followed before the monitor is asked again, where many motions cost little and
/// where they do not: a third of a second.
const PERIODS_AT_ONCE: (u64, u64) = (1 << 16, 256);

/// What an impact or a period that is kept costs, in scan windows.
const RECORD_COST: u64 = 32;

/// What a motion of an ensemble has come to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Outcome {
    /// It is on its way.
    Open,
    /// It has arrived at the attractor with this number.
    Arrived(usize),
    /// It returns, more and more closely, to this attractor.
    Approaching(usize),
    /// It has come to rest for good.
    AtRest,
    /// It does not repeat.
    Wandering,
    /// It cannot be computed.
    Lost,
}

impl Outcome {
    /// The attractor at which the motion has arrived, or will.
    pub(crate) fn attractor(self) -> Option<usize> {
        match self {
            Self::Arrived(attractor) | Self::Approaching(attractor) => Some(attractor),
            _ => None,
        }
    }

    /// True as long as the motion may come to something else.
    pub(crate) fn is_open(self) -> bool {
        matches!(self, Self::Open | Self::Approaching(_) | Self::Wandering)
    }
}

/// A motion of an ensemble.
#[derive(Debug, Clone)]
pub struct Member {
    /// The number of its machine.
    pub machine: usize,
    /// Its latest state at drive angle phi.
    pub state: Start,
    /// What it has come to.
    pub outcome: Outcome,
    /// Why it is lost.
    pub error: Option<MotionError>,
    /// Its states at drive angle phi while it was recorded, in order of time.
    pub states: Vec<Start>,
    /// When, since then, and before-impact velocity in m/s of each impact.
    pub impacts: Vec<(Instant, f64)>,
}

impl Member {
    /// A motion of a machine that begins at a state.
    pub fn new(machine: usize, state: Start) -> Self {
        Self {
            machine,
            state,
            outcome: Outcome::Open,
            error: None,
            states: Vec::new(),
            impacts: Vec::new(),
        }
    }

    /// Ends the motion.
    pub(crate) fn lose(&mut self, error: MotionError) {
        (self.outcome, self.error) = (Outcome::Lost, Some(error));
    }
}

/// Holds a motion of an ensemble and is told of its impacts and drive periods, which the motion keeps by default.
pub trait HasMember: Send {
    /// The motion.
    fn member(&mut self) -> &mut Member;

    /// An impact, at an instant since the beginning of the batch, with this velocity in m/s towards the stop.
    fn impact(&mut self, instant: Instant, velocity: f64) {
        // What is kept costs, so that a budget is one of memory, too.
        if budget::charge(RECORD_COST) {
            self.member().impacts.push((instant, velocity));
        }
    }

    /// A drive period has ended.
    fn period(&mut self, state: Start) {
        self.member().states.push(state);
    }
}

impl HasMember for Member {
    fn member(&mut self) -> &mut Self {
        self
    }
}

/// The machines of the motions, and how much work has been done.
pub struct Ensemble<'a> {
    pub(crate) machines: Cow<'a, [Machine]>,
    monitor: Monitor<'a>,
    done: AtomicU64,
    /// Work that will be done at most, in drive periods unless its owner counts otherwise.
    pub(crate) planned: u64,
}

impl<'a> Ensemble<'a> {
    /// An ensemble of motions of some machines.
    pub fn new(machines: impl Into<Cow<'a, [Machine]>>, monitor: Monitor<'a>) -> Self {
        Self {
            machines: machines.into(),
            monitor,
            done: AtomicU64::new(0),
            planned: 0,
        }
    }

    /// An ensemble of motions of one scene.
    ///
    /// # Errors
    /// [`OrbitError::Motion`] if it is invalid.
    pub fn of(scene: &Scene, monitor: Monitor<'a>) -> Result<Self, OrbitError> {
        Ok(Self::new(vec![Machine::new(scene)?], monitor))
    }

    /// True if many motions cost little.
    pub(crate) fn is_fast(&self) -> bool {
        self.machines[0].is_for_lanes()
    }

    /// True if long motions that settle cost as little as short ones.
    pub(crate) fn leaps(&self) -> bool {
        self.machines[0].skips_periods()
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

    /// Carries open motions on for `periods` drive periods on all threads, counts that work, and records the states of
    /// the last `recorded` periods.
    pub(crate) fn advance<M: HasMember>(
        &self,
        members: &mut [&mut M],
        periods: u64,
        recorded: usize,
    ) -> Result<(), OrbitError> {
        let fork = Fork::default();
        let chunks = members.par_chunks_mut(MEMBERS_AT_ONCE);
        let advanced = chunks.try_for_each(|chunk| {
            fork.run_part(|| self.advance_together(chunk, periods, recorded))
        });
        fork.charge_parts();
        advanced
    }

    /// Carries motions on in stretches, so that the monitor is asked often.
    fn advance_together<M: HasMember>(
        &self,
        members: &mut [&mut M],
        periods: u64,
        recorded: usize,
    ) -> Result<(), OrbitError> {
        let stretch = if self.is_fast() {
            PERIODS_AT_ONCE.0
        } else {
            PERIODS_AT_ONCE.1
        };
        let recorded = periods.min(recorded as u64);
        let mut left = periods - recorded;
        while left > 0 {
            let now = left.min(stretch);
            self.note(now * self.advance_batch::<false, false, _>(members, now)?)?;
            left -= now;
        }
        for member in &mut *members {
            member.member().states = Vec::with_capacity(recorded as usize);
        }
        self.note(recorded * self.advance_batch::<false, true, _>(members, recorded)?)
    }

    /// Carries open motions on for some drive periods on this thread and records states and impacts of the last
    /// `recorded` periods, the state at their beginning among them.
    pub(crate) fn observe<M: HasMember>(
        &self,
        members: &mut [&mut M],
        periods: u64,
        recorded: u64,
    ) -> Result<(), OrbitError> {
        self.advance_batch::<false, false, _>(members, periods - recorded)?;
        for member in &mut *members {
            let member = member.member();
            member.states = Vec::with_capacity(recorded as usize + 1);
            member.states.push(member.state);
            member.impacts.clear();
            budget::charge(RECORD_COST * recorded);
        }
        self.advance_batch::<true, true, _>(members, recorded)?;
        Ok(())
    }

    /// Carries open motions on for some drive periods on this thread, and returns how many they are; they are told of
    /// their impacts if `IMPACTS`, and of the ends of drive periods if `PERIODS`.
    ///
    /// # Errors
    /// [`OrbitError::Stopped`].
    pub fn advance_batch<const IMPACTS: bool, const PERIODS: bool, M: HasMember>(
        &self,
        members: &mut [&mut M],
        periods: u64,
    ) -> Result<u64, OrbitError> {
        let members = members.iter_mut().map(|it| &mut **it);
        let open = members.filter_map(|it| it.member().outcome.is_open().then_some(it));
        let mut open = Open::<IMPACTS, PERIODS, M>(open.collect());
        let motions = open.0.iter_mut().map(|it| {
            let member = it.member();
            (member.machine, member.state, periods)
        });
        let motions: Vec<_> = motions.collect();
        let ask = || stop_if(self.note(0).is_err());
        let outcomes = follow(&self.machines, motions, &mut open, ask);
        let outcomes = outcomes.ok_or(OrbitError::Stopped)?;
        let count = outcomes.len() as u64;
        for (member, outcome) in open.0.into_iter().zip(outcomes) {
            let member = member.member();
            member.state = outcome.end;
            if let Some(error) = outcome.error {
                member.lose(error);
            }
        }
        Ok(count)
    }
}

/// Motions of a batch, in order, each of which is told what happens in it.
struct Open<'a, const IMPACTS: bool, const PERIODS: bool, M>(Vec<&'a mut M>);

impl<const IMPACTS: bool, const PERIODS: bool, M: HasMember> BatchObserver
    for Open<'_, IMPACTS, PERIODS, M>
{
    const IMPACTS: bool = IMPACTS;
    const PERIODS: bool = PERIODS;

    fn impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64) {
        let cycles = cycle as f64;
        self.0[job].impact(Instant { cycles, offset }, velocity);
    }

    fn period(&mut self, job: usize, _: u64, state: Start) {
        self.0[job].period(state);
    }
}
