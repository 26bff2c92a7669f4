//! A member of an ensemble: a motion, what it has come to and what was recorded of it.

use serde::{Deserialize, Serialize};

use softstop::internals::budget;
use softstop::{Instant, MotionError, Start};

/// Charge for an impact or a state that a member keeps, in scan windows.
pub(crate) const RECORD_COST: u64 = 32;

/// What a member of an ensemble, a motion, has come to.
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
    /// The number of the attractor at which the motion has arrived, or will.
    pub(crate) fn attractor(self) -> Option<usize> {
        match self {
            Self::Arrived(attractor) | Self::Approaching(attractor) => Some(attractor),
            _ => None,
        }
    }

    /// True as long as the motion may still come to something else, so that it is advanced further.
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

    /// Ends a member as lost, with the error that says why.
    pub(crate) fn mark_lost(&mut self, error: MotionError) {
        (self.status, self.error) = (MemberStatus::Lost, Some(error));
    }
}

/// A type that holds a member of an ensemble and takes its impacts and states, which the member records by default.
pub trait HasMember: Send {
    /// The member that it holds.
    fn member_mut(&mut self) -> &mut Member;

    /// Takes an impact of the member: its instant since the batch began, and its velocity in m/s towards the stop.
    fn record_impact(&mut self, instant: Instant, velocity: f64) {
        // What is kept costs, so that a budget is one of memory, too.
        if budget::charge(RECORD_COST) {
            self.member_mut().impacts.push((instant, velocity));
        }
    }

    /// Takes the state of the member at the end of a drive period.
    fn record_state(&mut self, state: Start) {
        self.member_mut().states.push(state);
    }
}

impl HasMember for Member {
    fn member_mut(&mut self) -> &mut Self {
        self
    }
}
