//! Transitions of motions along one parameter: where each stable motion ends, by what, what follows,
//! and whether the way back leads over the same value.
//!
//! Nothing is told of the motions. [`softstop_dynamics::attractors`] finds them at a few values of the parameter;
//! each periodic one is followed to both ends of its stability (grazing, fold, flip); beyond each
//! end [`Explorer::explore`] lets the motion go and sees where it settles; motions found so are followed
//! in turn. Chaos is followed by its lifetime until it ends.
//!
//! ```
//! use softstop::{Parameter, Ratios};
//! use softstop_dynamics::ParameterFamily;
//! use softstop_paper::transitions::{Explorer, Rules};
//! use softstop_dynamics::monitor::unmonitored;
//!
//! let family = ParameterFamily::new(Ratios::unloaded().scene()?, [Parameter::Frequency])?;
//! let explorer = Explorer {
//!     family: &family,
//!     range: (1.0, 1.5),
//!     rules: Rules::default(),
//!     monitor: &unmonitored,
//!     kept: None,
//! };
//! let transitions = explorer.explore(&[1.2])?;
//! // The grazing of z = 0 at g0 and the fold of z = 1, both with hysteresis.
//! let symbols: Vec<String> = transitions.iter().map(|it| it.symbols()).collect();
//! assert_eq!(symbols, ["G", "SN"]);
//! assert!(transitions.iter().all(|transition| transition.hysteresis));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod chaos;
mod departure;
mod explore;
mod explorer;
mod intermittent;

pub use explorer::Explorer;
pub(crate) use intermittent::Stretches;

use softstop::Start;
use softstop_dynamics::attractors::SearchOptions;
use softstop_dynamics::continuation::{SpecialKind, TestFunction};
use softstop_dynamics::motion_kind::MotionKind;

/// A transition from one motion to another.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Transition {
    /// The parameter where the first motion ends.
    pub value: f64,
    /// What ends there.
    pub from: MotionKind,
    /// Its state there at drive angle phi, if it repeats.
    pub state: Option<Start>,
    /// The parameter where the last doubled motion after it ends, if there is one.
    pub doubled_until: Option<f64>,
    /// The parameter where the last motion on the way first follows, if others come before it.
    pub settled_at: Option<f64>,
    /// How far off that may be.
    pub settled_within: f64,
    /// What is met after it, in order, doubled motions among them; the last is where it settles.
    pub path: Vec<MotionKind>,
    /// Why, in order.
    pub causes: Vec<Cause>,
    /// True if the motion goes on, on rising values.
    pub rising: bool,
    /// True if going back does not lead to the first motion again.
    pub hysteresis: bool,
    /// How far beyond the value the last motion was seen.
    pub beyond: f64,
}

impl Transition {
    /// What follows in the end.
    pub fn to(&self) -> &MotionKind {
        self.path.last().unwrap_or(&self.from)
    }

    /// The parameter where the first motion is lost: where it ends or, if it ends by a soft doubling and what
    /// follows is another motion for good, where that takes over.
    pub fn lost_at(&self) -> f64 {
        match self.settled_at {
            Some(settled) if self.is_soft() && self.hysteresis => settled,
            _ => self.value,
        }
    }

    /// True if it is a soft doubling: the doubled motion begins beyond it, and takes over without a jump.
    pub fn is_soft(&self) -> bool {
        let until = self.doubled_until;
        until.is_some_and(|until| (until > self.value) == self.rising)
    }

    /// The parameter at which the last motion was seen.
    pub(crate) fn seen_at(&self) -> f64 {
        let sign = if self.rising { 1.0 } else { -1.0 };
        self.value + sign * self.beyond
    }

    /// The causes by the paper's symbols: `PD -> ISN -> OCH`.
    pub fn symbols(&self) -> String {
        let symbols: Vec<&str> = self.causes.iter().map(|cause| cause.symbol()).collect();
        symbols.join(" -> ")
    }
}

/// How it is decided what follows on what.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rules {
    /// How motions are searched for at the values given.
    pub survey: SearchOptions,
    /// Motions started beside an end or on chaos: sixteen go first, the others where those disagree.
    pub motions: usize,
    /// Drive periods for which they go on beside an end before they are looked at.
    pub patience: u64,
    /// Chaos has ended where half of the motions on it settle within so many drive periods.
    pub lifetime: u64,
    /// First and largest distance beyond an end at which is looked what follows, as shares of the
    /// parameter.
    pub beyond: (f64, f64),
    /// Width to which an end of chaos is bracketed, as a share of the parameter.
    pub width: f64,
    /// Points of a branch in each direction.
    pub points: usize,
}

impl Default for Rules {
    fn default() -> Self {
        Self {
            survey: SearchOptions {
                patience: 400_000,
                ..SearchOptions::default()
            },
            motions: 64,
            patience: 5000,
            lifetime: 500,
            beyond: (1e-8, 1e-3),
            width: 1e-8,
            points: 4000,
        }
    }
}

/// Why a motion ends: the words of Peterka 2003, Table 2.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cause {
    /// G: the motion, or a loop of it without impact, touches the stop.
    Grazing,
    /// SN: loss of stability with a jump to another periodic motion, at a fold or beyond a hard flip.
    Fold,
    /// PD: the period doubles.
    Flip,
    /// ISN: the jump ends in chaos instead, by an additional impact.
    InterruptedFold,
    /// IPD: a cascade of doublings ends in chaos.
    InterruptedFlips,
    /// OCH: chaos ends, in a periodic motion.
    OutOfChaos,
    /// The motion could not be followed.
    Unknown,
}

impl Cause {
    /// As in the paper.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Grazing => "G",
            Self::Fold => "SN",
            Self::Flip => "PD",
            Self::InterruptedFold => "ISN",
            Self::InterruptedFlips => "IPD",
            Self::OutOfChaos => "OCH",
            Self::Unknown => "?",
        }
    }
}

/// The causes of a transition, in order, by what ends its motion and, if that is a flip, the motion doubled from it.
pub(super) fn causes(
    of: &Transition,
    own: SpecialKind,
    doubled: Option<SpecialKind>,
) -> Vec<Cause> {
    let test = match own {
        SpecialKind::Grazing(_) => return vec![Cause::Grazing],
        SpecialKind::Pitchfork => return vec![Cause::Unknown],
        SpecialKind::Critical(test) => test,
    };
    match test {
        TestFunction::Fold => jump(of),
        TestFunction::Flip if met_chaos(of) && !of.hysteresis => vec![Cause::InterruptedFlips],
        // A soft doubling loses nothing: the doubled motion goes on in place of the simple one, and its end counts.
        TestFunction::Flip if of.is_soft() => match doubled {
            Some(SpecialKind::Grazing(_)) => vec![Cause::Grazing],
            Some(SpecialKind::Critical(TestFunction::Fold)) => jump(of),
            Some(SpecialKind::Critical(TestFunction::Flip)) if met_chaos(of) => {
                out_of_chaos(of, Cause::InterruptedFlips)
            }
            _ => vec![Cause::Flip],
        },
        // Beyond a hard flip there is nothing near to go on with.
        TestFunction::Flip => [vec![Cause::Flip], jump(of)].concat(),
        TestFunction::NeimarkSacker => vec![Cause::Unknown],
    }
}

/// A jump to another motion, or into chaos.
fn jump(of: &Transition) -> Vec<Cause> {
    match met_chaos(of) {
        true => out_of_chaos(of, Cause::InterruptedFold),
        false => vec![Cause::Fold],
    }
}

/// What led into chaos, and the way out of it if there is one.
fn out_of_chaos(of: &Transition, into: Cause) -> Vec<Cause> {
    match of.path.last() {
        Some(MotionKind::Chaos) => vec![into],
        _ => vec![into, Cause::OutOfChaos],
    }
}

fn met_chaos(of: &Transition) -> bool {
    of.path.contains(&MotionKind::Chaos)
}
