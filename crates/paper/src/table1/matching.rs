//! Which transition is which row of the paper.

use crate::transitions::Transition;
use softstop_dynamics::MotionKind;

use super::paper::PaperRow;

/// A transition as a row: where it is nearest to what the paper prints.
#[derive(Debug)]
pub struct Match<'a> {
    /// The transition.
    pub transition: &'a Transition,
    /// Our figure: where the motion is lost.
    pub eta: f64,
    /// True if the paper names it the other way about, which is the same where there is no hysteresis.
    pub is_reversed: bool,
}

impl Match<'_> {
    /// The direction of eta in which it is met; both without hysteresis.
    pub fn direction(&self) -> &'static str {
        let is_rising = self.transition.rising != self.is_reversed;
        match (self.transition.hysteresis, is_rising) {
            (false, _) => "both",
            (true, true) => "up",
            (true, false) => "down",
        }
    }
}

/// Largest difference between our figure and the paper's, as a share of it: row 19 is a swept loss.
const NEAR: f64 = 2e-3;

/// The transition of a row that is nearest, if there is one.
pub fn find<'a>(row: &PaperRow, transitions: &'a [Transition]) -> Option<Match<'a>> {
    let matches = transitions.iter().filter_map(|transition| {
        let (from, to) = (&transition.from, transition.to());
        let forward = is(&row.from, from) && is(&row.to, to);
        let reverse = !transition.hysteresis && is(&row.from, to) && is(&row.to, from);
        (forward || reverse).then(|| Match {
            transition,
            eta: transition.lost_at(),
            is_reversed: !forward,
        })
    });
    matches
        .filter(|found| (found.eta - row.eta).abs() <= NEAR * row.eta)
        .min_by(|a, b| {
            let gap = |found: &Match<'_>| (found.eta - row.eta).abs();
            gap(a).total_cmp(&gap(b))
        })
}

/// True if a motion is what the paper names so.
fn is(name: &str, motion: &MotionKind) -> bool {
    match motion {
        MotionKind::Chaos => name == "chaos",
        MotionKind::Periodic { regime, order } => {
            let regime = regime.to_string();
            name == regime || name == format!("{regime} {order}")
        }
        _ => false,
    }
}
