//! All motions on which one scene settles, found from starts spread over the plane of states.
//!
//! Nothing is told of where they are. Starts first from far and wide (a pilot) show where motions stay; then
//! quasi-random starts fill that region. What returns is polished by Newton's method on the exact map: a stable orbit
//! found so exists, however it was met, and two are the same if their states are. What does not return and has a
//! positive exponent is chaos; motions on the same cells of the plane belong to one. They are watched on for millions
//! of drive periods: if some settle elsewhere, the chaos is transient, and its mean lifetime is told.

pub(crate) mod catalogue;
mod chaos;
mod group_logs;
pub(crate) mod region;
mod search;
mod starting_box;

pub use chaos::Chaos;
pub use region::Region;
pub use search::{classify_start, find_attractors, find_attractors_until, settle_starts};
pub use starting_box::starting_box;
pub(crate) use starting_box::states_for_starting_box;

use crate::motion_kind::MotionKind;
use crate::orbit::{LyapunovExponents, Orbit};
use crate::wilson_interval::wilson_interval;
use softstop::{MotionError, Start};

/// Residuals of a periodic motion: of its simulation, and of the orbit that Newton's method polished.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct OrbitResiduals {
    /// Largest distance of simulated states a period apart, in units of the motion's size, when it was first met.
    pub returned: f64,
    /// |P(s) - s| of the polished orbit in the scene's scales.
    pub residual: f64,
    /// What rounding alone may leave of it.
    pub rounding: f64,
}

/// An attractor of a scene, with the share of the starts that come to it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Attractor {
    /// The kind of motion.
    pub motion: MotionKind,
    /// A state of it at drive angle phi; of what is lost, one before it could not be followed any farther.
    pub state: Start,
    /// The orbit, if it repeats: polished by Newton's method; stable.
    pub orbit: Option<Box<Orbit>>,
    /// How surely the orbit is one.
    pub residuals: Option<OrbitResiduals>,
    /// Least and largest position in m at which motions were seen to end, if it rests.
    pub positions: Option<[f64; 2]>,
    /// What chaos is like, if the motion is chaotic and was watched.
    pub chaos: Option<Chaos>,
    /// Its exponents, if they were computed: those of an orbit follow from its multipliers.
    pub exponents: Option<LyapunovExponents>,
    /// Number of starts that were on it in the end.
    pub starts: usize,
    /// Share of all starts that were on it: a measure of its basin.
    pub share: f64,
    /// Wilson's 95 % interval of the share, as if the starts were drawn at random.
    pub interval: [f64; 2],
}

impl Attractor {
    /// An attractor of a kind of motion with a state on it; `starts` of `all` starts came to it.
    pub(crate) fn new(motion: MotionKind, state: Start, (starts, all): (usize, usize)) -> Self {
        Self {
            motion,
            state,
            orbit: None,
            residuals: None,
            positions: None,
            chaos: None,
            exponents: None,
            starts,
            share: starts as f64 / all.max(1) as f64,
            interval: wilson_interval(starts, all),
        }
    }

    /// The attractor that a stable orbit is; `starts`: number of starts that came to it, and of all starts.
    pub(crate) fn from_orbit(orbit: &Orbit, starts: (usize, usize)) -> Self {
        Self {
            orbit: Some(Box::new(orbit.clone())),
            ..Self::new(MotionKind::of(orbit), orbit.state().into(), starts)
        }
    }
}

/// All attractors of a scene that a search has found.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Survey {
    /// The attractors, that with the largest share first.
    pub attractors: Vec<Attractor>,
    /// The region of the starts that the shares count.
    pub region: Region,
    /// Number of starts in the region.
    pub starts: usize,
    /// Starts whose motion could not be carried on, and why the first of them could not.
    pub lost: Option<(usize, MotionError)>,
    /// Drive periods that were computed.
    pub periods: u64,
}

/// Options of a search of the attractors of a scene: starts, and how long their motions are followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SearchOptions {
    /// Number of starts in the region.
    pub starts: usize,
    /// Seed that shifts the starts.
    pub seed: u64,
    /// Drive periods before a motion is classified.
    pub transient: u64,
    /// Longest period looked for, in drive periods.
    pub longest: usize,
    /// Drive periods for which the motions that do not settle are watched, all together.
    pub patience: u64,
    /// Region of the starts; where motions stay if not given.
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

/// What the motion from a start has come to after the transient: its state, the stable orbit there, and whether it repeats.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Arrival {
    /// State of the motion at drive angle phi.
    pub state: Start,
    /// The stable orbit to which it returns; none if it wanders (or rests).
    pub orbit: Option<Orbit>,
    /// True if its last states repeat, be it by an orbit that is not stable.
    pub returns: bool,
}
