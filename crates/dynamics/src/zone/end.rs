//! What ends a range of z = 1 motions.

use crate::continuation::{BorderCollision, Branch, BranchPoint, End, Face, SpecialKind, Test};
use crate::orbit::OrbitError;

/// Why a stable range ends.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Loss {
    /// The motion meets an unstable one and vanishes.
    Fold,
    /// It doubles its period.
    Flip,
    /// Its multipliers leave the unit circle as a complex pair.
    NeimarkSacker,
    /// It ceases to be symmetric.
    Pitchfork,
    /// Its impact dies: it grazes the clearance.
    Grazing,
    /// Another impact comes up: a turning point reaches the clearance.
    AnotherImpact,
    /// It grazes a surface beyond the clearance, where the force jumps: a border collision.
    Inner(Face),
    /// Another border collision.
    Border(BorderCollision),
    /// It is followed no farther than here.
    Range,
    /// The branch has more points than are followed.
    Budget,
    /// It is too unstable to be followed.
    Unstable,
    /// No step is short enough to follow it.
    Lost(OrbitError),
}

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
    /// The motion loses its stability or grazes a surface.
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
pub(super) fn first_end<'a>(
    branch: &'a Branch,
    mut points: impl Iterator<Item = &'a BranchPoint>,
) -> Option<(&'a BranchPoint, EndKind)> {
    let ends_motion = |kind: &SpecialKind| match kind {
        SpecialKind::Critical(_) | SpecialKind::Pitchfork => true,
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

impl Loss {
    /// At a special point.
    pub(super) fn at(kind: &SpecialKind) -> Self {
        match kind {
            SpecialKind::Critical(test) => Self::from(*test),
            SpecialKind::Pitchfork => Self::Pitchfork,
            SpecialKind::Grazing(graze) => match graze.face {
                Face::Clearance if graze.impacts == 0 => Self::Grazing,
                Face::Clearance => Self::AnotherImpact,
                face => Self::Inner(face),
            },
        }
    }

    /// Where a branch ends otherwise; at a grazing its special point says which.
    pub(super) fn of(end: &End) -> Self {
        match end {
            End::Points => Self::Budget,
            End::Border(border) => Self::Border(*border),
            End::Unstable => Self::Unstable,
            End::Lost(error) => Self::Lost(error.clone()),
            _ => Self::Range,
        }
    }
}

impl From<Test> for Loss {
    fn from(test: Test) -> Self {
        match test {
            Test::Fold => Self::Fold,
            Test::Flip => Self::Flip,
            Test::NeimarkSacker => Self::NeimarkSacker,
        }
    }
}
