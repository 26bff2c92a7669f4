//! Why a stable z = 1 motion ends along a branch.

use crate::continuation::{BorderCollision, End, Face, SpecialKind, TestFunction};
use crate::orbit::OrbitError;

/// Why a range of stable z = 1 motions, or the hysteresis zone, ends.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Loss {
    /// g0: below it the motion without impacts strikes. The motion itself goes on beyond it.
    FreeGrazing,
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

impl Loss {
    /// The loss of z = 1 at a special point.
    pub(super) fn at_special(kind: &SpecialKind) -> Self {
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

    /// The loss of z = 1 where a branch ends otherwise; at a grazing its special point says which.
    pub(super) fn of_branch_end(end: &End) -> Self {
        match end {
            End::Points => Self::Budget,
            End::Border(border) => Self::Border(*border),
            End::Unstable => Self::Unstable,
            End::Lost(error) => Self::Lost(error.clone()),
            _ => Self::Range,
        }
    }
}

impl From<TestFunction> for Loss {
    fn from(test: TestFunction) -> Self {
        match test {
            TestFunction::Fold => Self::Fold,
            TestFunction::Flip => Self::Flip,
            TestFunction::NeimarkSacker => Self::NeimarkSacker,
        }
    }
}
