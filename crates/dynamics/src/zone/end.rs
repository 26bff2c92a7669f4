//! The end of a zone or a stable range, and why it is there.

use super::loss::Loss;
use crate::continuation::{Branch, BranchPoint, Face, SpecialKind, TestFunction};

/// One end of a zone or of a range of frequencies with a stable z = 1 motion.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct ZoneEnd {
    /// Frequency in rad/s.
    pub frequency: f64,
    /// The motion there.
    pub point: BranchPoint,
    /// Why the range ends there.
    pub loss: Loss,
    /// The bifurcation or grazing that the point is, if it is one.
    pub special: Option<SpecialKind>,
}

impl ZoneEnd {
    /// The end of a zone at a point of a branch.
    pub(super) fn at_point(point: &BranchPoint, loss: Loss, special: Option<SpecialKind>) -> Self {
        Self {
            frequency: point.parameter,
            point: point.clone(),
            loss,
            special,
        }
    }

    /// The end of a zone at a special point of a branch.
    pub(super) fn at_special(point: &BranchPoint, kind: SpecialKind) -> Self {
        Self::at_point(point, Loss::at_special(&kind), Some(kind))
    }

    /// True if a test of the monodromy matrix vanishes at the end.
    pub fn is_critical(&self, test: TestFunction) -> bool {
        self.special == Some(SpecialKind::Critical(test))
    }
}

/// The first of some points of a branch, in this order, at which a stable z = 1 motion ends.
pub(super) fn first_end<'a>(
    branch: &'a Branch,
    mut points: impl Iterator<Item = &'a BranchPoint>,
) -> Option<ZoneEnd> {
    let ends_motion = |kind: &SpecialKind| match kind {
        SpecialKind::Critical(_) | SpecialKind::Pitchfork => true,
        SpecialKind::Grazing(graze) => graze.face == Face::Clearance,
    };
    points.find_map(|point| match branch.special_at(point) {
        Some(special) if ends_motion(&special.kind) => {
            Some(ZoneEnd::at_special(point, special.kind))
        }
        None if point.impacts.is_empty() => Some(ZoneEnd::at_point(point, Loss::Grazing, None)),
        None if point.impacts.len() > 1 => {
            Some(ZoneEnd::at_point(point, Loss::AnotherImpact, None))
        }
        _ => None,
    })
}
