//! What ends a range of z = 1 motions.

use super::stretch::Loss;
use crate::continuation::{Branch, BranchPoint, Face, SpecialKind, Test};

/// One end of a [`Zone`](super::Zone).
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct ZoneEnd {
    /// Frequency in rad/s.
    pub frequency: f64,
    /// The motion there.
    pub point: BranchPoint,
    /// What it is.
    pub kind: EndKind,
}

/// What an end of a zone is.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum EndKind {
    /// g0: below it the motion without impacts strikes. The z = 1 motion goes on beyond it.
    Free,
    /// The motion loses its stability or grazes the clearance.
    Special(SpecialKind),
    /// It is followed no farther, or ends otherwise.
    Other(Loss),
}

impl ZoneEnd {
    /// The end at a point of a branch.
    pub(super) fn at(point: &BranchPoint, kind: EndKind) -> Self {
        Self {
            frequency: point.parameter,
            point: point.clone(),
            kind,
        }
    }

    /// True if a test of the monodromy matrix vanishes there.
    pub fn is(&self, test: Test) -> bool {
        self.kind == EndKind::Special(SpecialKind::Critical(test))
    }
}

impl EndKind {
    /// Why the motion ends there; none if it does not.
    pub fn loss(&self) -> Option<Loss> {
        match self {
            Self::Free => None,
            Self::Special(kind) => Some(Loss::at(kind)),
            Self::Other(loss) => Some(loss.clone()),
        }
    }
}

/// The first of some points of a branch, in this order, at which a stable z = 1 motion ends.
pub(crate) fn first_end<'a>(
    branch: &'a Branch,
    mut points: impl Iterator<Item = &'a BranchPoint>,
) -> Option<(&'a BranchPoint, EndKind)> {
    let ends_motion = |kind: &SpecialKind| match kind {
        SpecialKind::Critical(_) => true,
        SpecialKind::Grazing(graze) => graze.face == Face::Clearance,
    };
    points.find_map(|point| {
        let kind = match branch.special_at(point) {
            Some(special) if ends_motion(&special.kind) => EndKind::Special(special.kind),
            None if point.impacts.is_empty() => EndKind::Other(Loss::Grazing),
            None if point.impacts.len() > 1 => EndKind::Other(Loss::AnotherImpact),
            _ => return None,
        };
        Some((point, kind))
    })
}
