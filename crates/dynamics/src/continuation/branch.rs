//! A branch of periodic orbits: its points, special points and ends.

use super::{BranchEnd, BranchPoint, SpecialKind, SpecialPoint, TestFunction};

/// A branch of orbits, in order of arclength.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Branch {
    /// Drive periods of the orbits.
    pub periods: u64,
    /// Points, special ones among them.
    pub points: Vec<BranchPoint>,
    /// Special points, in the same order.
    pub specials: Vec<SpecialPoint>,
    /// Why it ends at its first point and at its last.
    pub ends: (BranchEnd, BranchEnd),
}

impl Branch {
    /// The special point of the branch at this point, if it is one.
    pub fn special_at(&self, point: &BranchPoint) -> Option<&SpecialPoint> {
        self.specials.iter().find(|special| special.is_at(point))
    }

    /// The points of the branch at which a test vanishes, in their order.
    pub fn critical_points(&self, test: TestFunction) -> impl Iterator<Item = &BranchPoint> {
        let own = move |special: &&SpecialPoint| special.kind == SpecialKind::Critical(test);
        let own = self.specials.iter().filter(own);
        own.map(|special| &special.point)
    }
}
