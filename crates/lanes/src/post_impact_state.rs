//! The state of a motion just after an impact, which a return repeats.

use super::cycle_state::GuardCrossing;

/// The state of a motion just after an impact, with time, phase and counts: a return, where it repeats the impact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct PostImpactState {
    pub position: f64,
    pub velocity: f64,
    /// Seconds into the drive period; drive periods left, this one included.
    pub offset: f64,
    pub left: f64,
    /// cos and sin of the drive angle then, if known.
    pub angle: Option<(f64, f64)>,
    pub impacts: f64,
    pub crossings: f64,
    /// Index of the phase, the law that holds.
    pub phase: f64,
}

impl PostImpactState {
    /// The impact that leads to this state, as a crossing of a guard.
    pub fn as_crossing(&self) -> GuardCrossing {
        GuardCrossing {
            position: self.position,
            velocity: self.velocity,
            velocity_after: self.velocity,
            phase: self.phase as usize,
            left: self.left,
            offset: self.offset,
        }
    }
}
