//! Why a motion ends: the words of Peterka 2003, Table 2.

use super::Motion;
use super::window::EndKind;

/// Why a motion ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cause {
    /// G: the motion, or a loop of it without impact, touches the stop.
    Grazing,
    /// SN: fold, and a jump to another motion.
    Fold,
    /// PD: the period doubles.
    Flip,
    /// ISN: a fold, or the jump that would follow one, ends in chaos by an additional impact.
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

/// The causes of a transition: from the end of the first motion, that of the last doubled one after it
/// (if there is one), the motions met, and whether the way back is the same.
pub(super) fn causes(
    end: EndKind,
    doubled: Option<EndKind>,
    path: &[Motion],
    hysteresis: bool,
) -> Vec<Cause> {
    let met_chaos = path.contains(&Motion::Chaos);
    let ends_in_chaos = path.last() == Some(&Motion::Chaos);
    let mut causes = match (end, met_chaos) {
        (EndKind::Grazing { .. }, _) => return vec![Cause::Grazing],
        (EndKind::Fold, true) => vec![Cause::InterruptedFold],
        (EndKind::Fold, false) => vec![Cause::Fold],
        (EndKind::Flip, true) if !hysteresis => return vec![Cause::InterruptedFlips],
        (EndKind::Flip, chaos) => vec![Cause::Flip, after_doubling(doubled, chaos)],
        (EndKind::Merging | EndKind::Range | EndKind::Lost, _) => vec![Cause::Unknown],
    };
    if met_chaos && !ends_in_chaos {
        causes.push(Cause::OutOfChaos);
    }
    causes
}

/// How the last doubled motion ends.
fn after_doubling(end: Option<EndKind>, chaos: bool) -> Cause {
    match (end, chaos) {
        (Some(EndKind::Flip), true) => Cause::InterruptedFlips,
        (Some(EndKind::Fold | EndKind::Grazing { .. }), true) => Cause::InterruptedFold,
        (Some(EndKind::Fold), false) => Cause::Fold,
        (Some(EndKind::Grazing { .. }), false) => Cause::Grazing,
        _ => Cause::Unknown,
    }
}
