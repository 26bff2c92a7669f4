//! The end of a zone or a stable range, and why it is there.

use crate::continuation::{
    BorderCollision, Branch, BranchEnd, BranchPoint, SpecialKind, SwitchingSurface, TestFunction,
};
use crate::orbit::OrbitError;

/// One end of a zone or of a stable range of z = 1: its frequency, the motion there, and why it ends.
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
    /// The end of a zone at a point of a branch, with the loss that ends it and the special point that it is, if any.
    pub(super) fn at_point(point: &BranchPoint, loss: Loss, special: Option<SpecialKind>) -> Self {
        Self {
            frequency: point.parameter,
            point: point.clone(),
            loss,
            special,
        }
    }

    /// The end of a zone at a special point of a branch, which tells the loss.
    pub(super) fn at_special(point: &BranchPoint, kind: SpecialKind) -> Self {
        Self::at_point(point, Loss::at_special(&kind), Some(kind))
    }

    /// True if a test function of the monodromy matrix vanishes at the end: a fold, flip or Neimark-Sacker bifurcation.
    pub fn is_critical(&self, test: TestFunction) -> bool {
        self.special == Some(SpecialKind::Critical(test))
    }
}

/// The first of some points of a branch at which a stable z = 1 motion ends: at a bifurcation, or where an impact dies or comes
/// up; none if it ends at none of them.
pub(super) fn first_end<'a>(
    branch: &'a Branch,
    mut points: impl Iterator<Item = &'a BranchPoint>,
) -> Option<ZoneEnd> {
    let ends_motion = |kind: &SpecialKind| match kind {
        SpecialKind::Critical(_) | SpecialKind::Pitchfork => true,
        SpecialKind::Grazing(graze) => graze.surface == SwitchingSurface::Clearance,
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

/// Why a stable z = 1 motion is lost at the end of a zone or of a stable range.
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
    Inner(SwitchingSurface),
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
    /// The loss of a z = 1 motion at a special point of a branch.
    pub(super) fn at_special(kind: &SpecialKind) -> Self {
        match kind {
            SpecialKind::Critical(test) => Self::from(*test),
            SpecialKind::Pitchfork => Self::Pitchfork,
            SpecialKind::Grazing(graze) => match graze.surface {
                SwitchingSurface::Clearance if graze.impacts == 0 => Self::Grazing,
                SwitchingSurface::Clearance => Self::AnotherImpact,
                surface => Self::Inner(surface),
            },
        }
    }

    /// The loss of a z = 1 motion where its branch is followed no farther; at a grazing the special point there tells it.
    pub(super) fn of_branch_end(end: &BranchEnd) -> Self {
        match end {
            BranchEnd::Points => Self::Budget,
            BranchEnd::Border(border) => Self::Border(*border),
            BranchEnd::Unstable => Self::Unstable,
            BranchEnd::Lost(error) => Self::Lost(error.clone()),
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
