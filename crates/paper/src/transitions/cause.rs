//! Why a motion ends: the words of Peterka 2003, Table 2.

use super::Transition;
use softstop_dynamics::continuation::{SpecialKind, TestFunction};
use softstop_dynamics::motion::MotionKind;

/// Why a motion ends.
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
