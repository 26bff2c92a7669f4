//! Why a motion ends: the words of Peterka 2003, Table 2.

use softstop_dynamics::continuation::{SpecialKind, Test};
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

/// What goes before a transition.
#[derive(Debug, Clone, Copy)]
pub(super) struct TransitionContext<'a> {
    /// By what the motion ends.
    pub end: SpecialKind,
    /// By what the motion doubled from it ends, if it ends by a flip.
    pub doubled: Option<SpecialKind>,
    /// True if the doubled motion begins beyond the flip, and takes over without a jump.
    pub is_soft: bool,
    /// The motions met beyond the end.
    pub path: &'a [MotionKind],
    /// True if the way back is another.
    pub hysteresis: bool,
}

impl TransitionContext<'_> {
    /// The causes, in order.
    pub(super) fn causes(&self) -> Vec<Cause> {
        let test = match self.end {
            SpecialKind::Grazing(_) => return vec![Cause::Grazing],
            SpecialKind::Pitchfork => return vec![Cause::Unknown],
            SpecialKind::Critical(test) => test,
        };
        match test {
            Test::Fold => self.jump(),
            Test::Flip if self.met_chaos() && !self.hysteresis => vec![Cause::InterruptedFlips],
            Test::Flip if self.is_soft => self.end_of_doubled(),
            // Beyond a hard flip there is nothing near to go on with.
            Test::Flip => [vec![Cause::Flip], self.jump()].concat(),
            Test::NeimarkSacker => vec![Cause::Unknown],
        }
    }

    /// A soft doubling loses nothing: the doubled motion goes on in place of the simple one, and its end counts.
    fn end_of_doubled(&self) -> Vec<Cause> {
        match self.doubled {
            Some(SpecialKind::Grazing(_)) => vec![Cause::Grazing],
            Some(SpecialKind::Critical(Test::Fold)) => self.jump(),
            Some(SpecialKind::Critical(Test::Flip)) if self.met_chaos() => {
                self.out_of_chaos(Cause::InterruptedFlips)
            }
            _ => vec![Cause::Flip],
        }
    }

    /// A jump to another motion, or into chaos.
    fn jump(&self) -> Vec<Cause> {
        match self.met_chaos() {
            true => self.out_of_chaos(Cause::InterruptedFold),
            false => vec![Cause::Fold],
        }
    }

    /// What led into chaos, and the way out of it if there is one.
    fn out_of_chaos(&self, into: Cause) -> Vec<Cause> {
        match self.path.last() {
            Some(MotionKind::Chaos) => vec![into],
            _ => vec![into, Cause::OutOfChaos],
        }
    }

    fn met_chaos(&self) -> bool {
        self.path.contains(&MotionKind::Chaos)
    }
}
