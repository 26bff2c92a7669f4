//! What lies before the punch: a strip, a pierced one, none.

use serde::Serialize;
use softstop::{CrossingKind, PhaseKind};

use crate::simulate::CrossingRow;

/// The strip ahead of the stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum StripState {
    Whole,
    Pierced,
    Missing,
}

/// What becomes of the strips in a run. A new one comes when the mass is back at the clearance; whether it came is seen
/// from the stroke that follows.
#[derive(Debug)]
pub(super) struct StripHistory {
    clearance: f64,
    /// From when on in s which one lies there.
    changes: Vec<(f64, StripState)>,
    /// The stroke that has just begun.
    is_new: bool,
}

impl StripHistory {
    /// A run from time 0, with a strip.
    pub(super) const fn new(clearance: f64) -> Self {
        Self {
            clearance,
            changes: Vec::new(),
            is_new: true,
        }
    }

    /// Takes in a crossing.
    pub(super) fn take(&mut self, it: &CrossingRow) {
        self.see(it.before);
        let crossing = &it.crossing;
        let is_back = matches!(crossing.kind, CrossingKind::Surface { forward: false, .. });
        if crossing.pierces() {
            self.changes.push((it.time, StripState::Pierced));
        } else if is_back && crossing.position <= self.clearance {
            self.changes.push((it.time, StripState::Whole));
            self.is_new = true;
        }
    }

    /// All changes; the last arc of the run is of this kind.
    pub(super) fn finish(mut self, last: PhaseKind) -> Vec<(f64, StripState)> {
        self.see(last);
        self.changes
    }

    /// Sees a phase: the first one beyond the clearance tells whether there is a strip.
    fn see(&mut self, kind: PhaseKind) {
        if !self.is_new || kind == PhaseKind::Free {
            return;
        }
        self.is_new = false;
        let has_strip = matches!(kind, PhaseKind::Pierce | PhaseKind::Cut);
        if !has_strip {
            match self.changes.last_mut() {
                Some(change) => change.1 = StripState::Missing,
                None => self.changes.push((0.0, StripState::Missing)),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use softstop::{Crossing, Instant};

    use super::*;

    fn crossed(time: f64, before: PhaseKind, kind: CrossingKind, position: f64) -> CrossingRow {
        let crossing = Crossing {
            instant: Instant {
                cycles: 0.0,
                offset: 0.0,
            },
            kind,
            position,
            velocity: 1.0,
            velocity_after: 1.0,
            acceleration_before: 0.0,
            acceleration_after: 0.0,
        };
        CrossingRow {
            time,
            before,
            crossing,
        }
    }

    const fn passed(forward: bool, impact: bool, pierces: bool) -> CrossingKind {
        CrossingKind::Surface {
            forward,
            impact,
            pierces,
        }
    }

    #[test]
    fn a_strip_is_pierced_and_followed_by_the_next_or_by_none() {
        let mut strips = StripHistory::new(10.0);
        for it in [
            crossed(1.0, PhaseKind::Free, passed(true, true, false), 10.0),
            crossed(1.1, PhaseKind::Pierce, passed(true, false, true), 10.4),
            crossed(1.3, PhaseKind::Cut, passed(false, false, false), 10.4),
            crossed(1.4, PhaseKind::Pierce, passed(false, false, false), 10.0),
            crossed(2.0, PhaseKind::Free, passed(true, true, false), 10.0),
            crossed(2.3, PhaseKind::Gap, passed(false, false, false), 10.0),
        ] {
            strips.take(&it);
        }
        let expected = [
            (1.1, StripState::Pierced),
            (1.4, StripState::Missing),
            (2.3, StripState::Whole),
        ];
        assert_eq!(strips.finish(PhaseKind::Free), expected);
    }

    #[test]
    fn a_run_that_begins_without_a_strip_says_so() {
        let strips = StripHistory::new(0.0);
        assert_eq!(strips.finish(PhaseKind::Gap), [(0.0, StripState::Missing)]);
    }
}
