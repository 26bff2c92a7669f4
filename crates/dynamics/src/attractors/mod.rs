//! All motions on which one scene settles, found from starts spread over the plane of states.
//!
//! Nothing is told of where they are. Starts first from far and wide (a pilot) show where motions stay;
//! then quasi-random starts fill that region. What returns is polished by Newton's method on the exact map:
//! a stable orbit found so exists, however it was met, and two are the same if their states are. What
//! does not return and has a positive exponent is chaos; motions on the same cells of the plane belong
//! to one. They are watched on for millions of drive periods: if some settle elsewhere, the chaos is
//! transient, and its mean lifetime is told.

pub(crate) mod catalogue;
mod chaos;
mod group;
mod lifetime;
mod search;
pub(crate) mod starts;

pub use chaos::Chaos;
pub(crate) use search::stays;
pub use search::{attractors, classify, settle, starting_box};
pub use starts::Region;

use crate::motion::MotionKind;
use crate::orbit::{Exponents, Orbit};
use crate::share::wilson;
use softstop::{MotionError, Start};

/// How certain a periodic motion is.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Certainty {
    /// Largest distance between states of the simulated motion one of its periods apart, in units of its
    /// size, when it was first met.
    pub returned: f64,
    /// |P(s) - s| of the polished orbit in the scene's scales.
    pub residual: f64,
    /// What rounding alone may leave of it.
    pub rounding: f64,
}

/// What some of many starts come to.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Attractor {
    /// What it is.
    pub motion: MotionKind,
    /// A state of it at drive angle phi; of what is lost, one before it could not be followed any farther.
    pub state: Start,
    /// The orbit, if it repeats: polished by Newton's method; stable.
    pub orbit: Option<Box<Orbit>>,
    /// How certain that is.
    pub certainty: Option<Certainty>,
    /// Least and largest position in m at which motions were seen to end, if it rests.
    pub positions: Option<[f64; 2]>,
    /// What it is like, if it is chaotic and was watched.
    pub chaos: Option<Chaos>,
    /// Its exponents, if they were computed: those of an orbit follow from its multipliers.
    pub exponents: Option<Exponents>,
    /// How many starts were on it in the end.
    pub starts: usize,
    /// Their share of all: a measure of its basin.
    pub share: f64,
    /// Wilson's 95 % interval of the share, as if the starts were drawn at random.
    pub interval: [f64; 2],
}

impl Attractor {
    /// A motion with a state of it, the starts on it and all.
    pub(crate) fn new(motion: MotionKind, state: Start, (starts, all): (usize, usize)) -> Self {
        Self {
            motion,
            state,
            orbit: None,
            certainty: None,
            positions: None,
            chaos: None,
            exponents: None,
            starts,
            share: starts as f64 / all.max(1) as f64,
            interval: wilson(starts, all),
        }
    }

    /// A stable orbit.
    pub(crate) fn repeating(orbit: &Orbit, starts: (usize, usize)) -> Self {
        Self {
            orbit: Some(Box::new(orbit.clone())),
            ..Self::new(MotionKind::of(orbit), orbit.state().into(), starts)
        }
    }
}

/// All motions found.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Survey {
    /// The motions, that with the largest share first.
    pub attractors: Vec<Attractor>,
    /// Where the starts lay that the shares count.
    pub region: Region,
    /// How many there were.
    pub starts: usize,
    /// Starts whose motion could not be carried on, and why the first of them could not.
    pub lost: Option<(usize, MotionError)>,
    /// Drive periods computed.
    pub periods: u64,
}

/// How to look for motions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SearchOptions {
    /// Starts in the region.
    pub starts: usize,
    /// Shifts the starts.
    pub seed: u64,
    /// Drive periods before a motion is looked at.
    pub transient: u64,
    /// Longest period looked for, in drive periods.
    pub longest: usize,
    /// Drive periods for which the motions that do not settle are watched, all together.
    pub patience: u64,
    /// Where the starts lie; where motions stay if not given.
    pub region: Option<Region>,
}

impl Default for SearchOptions {
    fn default() -> Self {
        Self {
            starts: 256,
            seed: 0,
            transient: 500,
            longest: 64,
            patience: 4_000_000,
            region: None,
        }
    }
}

/// Where a motion is after the transient.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Arrival {
    /// Its state at drive angle phi.
    pub state: Start,
    /// The stable orbit to which it returns; none if it wanders (or rests).
    pub orbit: Option<Orbit>,
    /// True if its last states repeat, be it by an orbit that is not stable.
    pub returns: bool,
}
