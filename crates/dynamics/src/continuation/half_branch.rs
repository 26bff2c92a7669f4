//! Half a branch: its points in one direction, how far it is followed, and why it ends.

use std::fmt::Debug;

use super::{BorderCollision, BranchPoint, SpecialPoint};
use crate::orbit::OrbitError;

/// Limits of a branch: how far it is followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BranchLimits {
    /// Lowest and highest value of the parameter.
    pub range: (f64, f64),
    /// Points in each direction.
    pub points: usize,
}

/// Why a branch ends.
#[derive(Debug, Clone)]
pub enum BranchEnd {
    /// The parameter reaches the end of its range; the last point is there.
    Range,
    /// There are as many points as asked for.
    Points,
    /// The branch is closed: it comes back to its start.
    Closed,
    /// The orbit grazes the stop; the last point does.
    Grazing,
    /// The orbit becomes one of half as many periods, at its flip; the last point is that.
    Merged,
    /// The orbit becomes symmetric, at a pitchfork; the last point is that.
    Symmetric,
    /// The monitor asked for it.
    Stopped,
    /// Just beyond the last point the orbit would meet something where the force jumps.
    Border(BorderCollision),
    /// The orbit is so unstable that changes of 1e-6 along the parameter leave its neighbourhood.
    Unstable,
    /// It cannot be followed even with the smallest step.
    Lost(OrbitError),
}

/// Half a branch: its points in one direction, without its start.
pub(super) struct HalfBranch {
    pub(super) points: Vec<BranchPoint>,
    pub(super) specials: Vec<SpecialPoint>,
    pub(super) end: BranchEnd,
    /// Points at the last turn of the section: it is not turned twice at one place.
    pub(super) turned_at: Option<usize>,
}

impl HalfBranch {
    /// Ends half a branch in a grazing; false if there is none.
    pub(super) fn end_in_grazing(&mut self, special: Option<SpecialPoint>) -> bool {
        let Some(special) = special else {
            return false;
        };
        self.points.push(special.point.clone());
        self.specials.push(special);
        self.end = BranchEnd::Grazing;
        true
    }

    /// Half a branch without points, and why it ends.
    pub(super) fn empty(end: BranchEnd) -> Self {
        Self {
            points: Vec::new(),
            specials: Vec::new(),
            end,
            turned_at: None,
        }
    }
}
