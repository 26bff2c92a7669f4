//! Half a branch: its points in one direction, and why it ends.

use super::{BranchEnd, BranchPoint, SpecialPoint};

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
