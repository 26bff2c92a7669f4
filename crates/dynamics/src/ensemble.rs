//! Ensembles: many motions, each of one of some machines, advanced together until it is known what they have come to.

use std::borrow::Cow;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};

use serde::{Deserialize, Serialize};

use crate::monitor::{Monitor, stop_if};
use crate::monitored_batch::follow_batch;
use crate::orbit::OrbitError;
use crate::parallel;
use softstop::internals::budget;
use softstop::{Instant, MotionError, Start};
use softstop_lanes::{BatchObserver, LoweredMachine};

/// Number of members of an ensemble that one thread advances at a time: several times as many as there are lanes.
const MEMBERS_AT_ONCE: usize = 64;

/// Drive periods between two questions to the monitor, for members that run in lanes and for others: a third of a second.
const PERIODS_BETWEEN_QUESTIONS: (u64, u64) = (1 << 16, 256);

/// Many motions that are advanced together: their machines, the monitor, and how much work has been done. The motions themselves
/// are [`Member`]s, which the caller holds.
pub struct Ensemble<'a> {
    pub(crate) machines: Cow<'a, [LoweredMachine]>,
    monitor: Monitor<'a>,
    done: AtomicU64,
    /// Work that will be done at most, in drive periods unless its owner counts otherwise.
    pub(crate) planned: u64,
}

impl<'a> Ensemble<'a> {
    /// An ensemble of motions of these machines, to which members refer by their index.
    pub fn new(machines: impl Into<Cow<'a, [LoweredMachine]>>, monitor: Monitor<'a>) -> Self {
        Self {
            machines: machines.into(),
            monitor,
            done: AtomicU64::new(0),
            planned: 0,
        }
    }

    /// True if the ensemble's motions run in the SIMD lanes, so that many cost little.
    pub(crate) fn runs_in_lanes(&self) -> bool {
        self.machines[0].is_for_lanes()
    }

    /// True if the lanes skip drive periods of settled motions, so that long motions cost as little as short ones.
    pub(crate) fn skips_periods(&self) -> bool {
        self.machines[0].skips_periods()
    }

    /// The work of the ensemble that was counted so far, in the caller's unit: drive periods, or cells.
    pub(crate) fn work_done(&self) -> u64 {
        self.done.load(Ordering::Relaxed)
    }

    /// Counts work in the caller's unit and asks the monitor; an error if the monitor ends the work or the budget is spent.
    pub(crate) fn count_work(&self, periods: u64) -> Result<(), OrbitError> {
        let done = self.done.fetch_add(periods, Ordering::Relaxed) + periods;
        match (self.monitor)(done, self.planned.max(done)) {
            ControlFlow::Continue(()) if !budget::is_spent() => Ok(()),
            _ => Err(OrbitError::Stopped),
        }
    }

    /// Advances the open members by some drive periods, on all threads, and records their states after the last `recorded` ones.
    pub(crate) fn advance<M: HasMember>(
        &self,
        members: &mut [&mut M],
        periods: u64,
        recorded: usize,
    ) -> Result<(), OrbitError> {
        parallel::try_change_chunks(members, MEMBERS_AT_ONCE, |members| {
            self.advance_together(members, periods, recorded)
        })
    }

    /// Advances some members on this thread as [`Ensemble::advance`] does, and asks the monitor between stretches of time.
    fn advance_together<M: HasMember>(
        &self,
        members: &mut [&mut M],
        periods: u64,
        recorded: usize,
    ) -> Result<(), OrbitError> {
        let stretch = if self.runs_in_lanes() {
            PERIODS_BETWEEN_QUESTIONS.0
        } else {
            PERIODS_BETWEEN_QUESTIONS.1
        };
        let recorded = periods.min(recorded as u64);
        let mut left = periods - recorded;
        while left > 0 {
            let now = left.min(stretch);
            self.count_work(now * self.advance_batch::<false, false, _>(members, now)?)?;
            left -= now;
        }
        for member in &mut *members {
            member.member_mut().states = Vec::with_capacity(recorded as usize);
        }
        self.count_work(recorded * self.advance_batch::<false, true, _>(members, recorded)?)
    }

    /// Advances the open members by some drive periods, on this thread, and records states and impacts of the `recorded` last.
    pub(crate) fn record_run<M: HasMember>(
        &self,
        members: &mut [&mut M],
        periods: u64,
        recorded: u64,
    ) -> Result<(), OrbitError> {
        self.advance_batch::<false, false, _>(members, periods - recorded)?;
        for member in &mut *members {
            let member = member.member_mut();
            member.states = Vec::with_capacity(recorded as usize + 1);
            member.states.push(member.state);
            member.impacts.clear();
            budget::charge(RECORD_COST * recorded);
        }
        self.advance_batch::<true, true, _>(members, recorded)?;
        Ok(())
    }

    /// Advances those members that are open by some drive periods, in one batch on this thread, and returns how many they are;
    /// they record impacts if `IMPACTS`, and states at the ends of periods if `PERIODS`.
    ///
    /// # Errors
    /// [`OrbitError::Stopped`].
    pub fn advance_batch<const IMPACTS: bool, const PERIODS: bool, M: HasMember>(
        &self,
        members: &mut [&mut M],
        periods: u64,
    ) -> Result<u64, OrbitError> {
        let members = members.iter_mut().map(|it| &mut **it);
        let open = members.filter_map(|it| it.member_mut().status.is_open().then_some(it));
        let mut open = OpenMembers::<IMPACTS, PERIODS, M>(open.collect());
        let motions = open.0.iter_mut().map(|it| {
            let member = it.member_mut();
            (member.machine, member.state, periods)
        });
        let motions: Vec<_> = motions.collect();
        let ask = || stop_if(self.count_work(0).is_err());
        let outcomes = follow_batch(&self.machines, motions, &mut open, ask);
        let outcomes = outcomes.ok_or(OrbitError::Stopped)?;
        let count = outcomes.len() as u64;
        for (member, outcome) in open.0.into_iter().zip(outcomes) {
            let member = member.member_mut();
            member.state = outcome.end;
            if let Some(error) = outcome.error {
                member.mark_lost(error);
            }
        }
        Ok(count)
    }
}

/// The members of a batch that are open, in order: an observer that lets each record what happens to it.
struct OpenMembers<'a, const IMPACTS: bool, const PERIODS: bool, M>(Vec<&'a mut M>);

impl<const IMPACTS: bool, const PERIODS: bool, M: HasMember> BatchObserver
    for OpenMembers<'_, IMPACTS, PERIODS, M>
{
    fn observed(&self) -> (bool, bool) {
        (IMPACTS, PERIODS)
    }

    fn impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64) {
        let cycles = cycle as f64;
        self.0[job].record_impact(Instant { cycles, offset }, velocity);
    }

    fn period(&mut self, job: usize, _: u64, state: Start) {
        self.0[job].record_state(state);
    }
}

/// Charge to the budget for an impact or a state that a member records, in scan windows.
pub(crate) const RECORD_COST: u64 = 32;

/// What the motion of a member of an ensemble has come to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum MemberStatus {
    /// It is still under way.
    Open,
    /// It has arrived at the attractor with this number.
    Arrived(usize),
    /// It returns, more and more closely, to the attractor with this number.
    Approaching(usize),
    /// It has come to rest for good.
    AtRest,
    /// It does not repeat.
    Wandering,
    /// It cannot be computed.
    Lost,
}

impl MemberStatus {
    /// The index of the attractor at which the motion has arrived, or which it approaches; none otherwise.
    pub(crate) fn attractor(self) -> Option<usize> {
        match self {
            Self::Arrived(attractor) | Self::Approaching(attractor) => Some(attractor),
            _ => None,
        }
    }

    /// True as long as the motion may come to something else, so that it is advanced further.
    pub(crate) fn is_open(self) -> bool {
        matches!(self, Self::Open | Self::Approaching(_) | Self::Wandering)
    }
}

/// A member of an ensemble: a motion with its latest state, its outcome and what was recorded of it.
#[derive(Debug, Clone)]
pub struct Member {
    /// The number of its machine in the ensemble.
    pub machine: usize,
    /// Its latest state at drive angle phi.
    pub state: Start,
    /// What it has come to.
    pub status: MemberStatus,
    /// The error by which it is lost.
    pub error: Option<MotionError>,
    /// Its states at drive angle phi while it was recorded, in order of time.
    pub states: Vec<Start>,
    /// Instant since recording began, and before-impact velocity in m/s, of each impact.
    pub impacts: Vec<(Instant, f64)>,
}

impl Member {
    /// A member of an ensemble: a motion of a machine from a state at drive angle phi.
    pub fn new(machine: usize, state: Start) -> Self {
        Self {
            machine,
            state,
            status: MemberStatus::Open,
            error: None,
            states: Vec::new(),
            impacts: Vec::new(),
        }
    }

    /// Marks the member as lost, with the error for which its motion cannot be computed.
    pub(crate) fn mark_lost(&mut self, error: MotionError) {
        (self.status, self.error) = (MemberStatus::Lost, Some(error));
    }
}

/// A type that holds a member of an ensemble, and may do something else with its impacts and states than record them.
pub trait HasMember: Send {
    /// The member that it holds.
    fn member_mut(&mut self) -> &mut Member;

    /// Records an impact of the member: its instant since the batch began, and its velocity in m/s towards the stop.
    fn record_impact(&mut self, instant: Instant, velocity: f64) {
        // What is kept costs, so that a budget is one of memory, too.
        if budget::charge(RECORD_COST) {
            self.member_mut().impacts.push((instant, velocity));
        }
    }

    /// Records the state of the member at the end of a drive period.
    fn record_state(&mut self, state: Start) {
        self.member_mut().states.push(state);
    }
}

impl HasMember for Member {
    fn member_mut(&mut self) -> &mut Self {
        self
    }
}
