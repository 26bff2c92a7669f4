//! Special points of branches, and the touch of a grazing orbit.

use super::{BranchPoint, SwitchingSurface, TestFunction};

/// The kind of a special point of a branch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SpecialKind {
    /// A bifurcation that the monodromy matrix tells: fold (the paper's SN), flip (PD), Neimark-Sacker.
    Critical(TestFunction),
    /// The orbit grazes the stop (the paper's G).
    Grazing(GrazingTouch),
    /// An orbit between two stops that are alike ceases to be symmetric: two that are not come out of it.
    Pitchfork,
}

impl From<TestFunction> for SpecialKind {
    fn from(test: TestFunction) -> Self {
        Self::Critical(test)
    }
}

/// The touch of an orbit that grazes a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct GrazingTouch {
    /// Drive angle in rad of the touch, counted on over the drive periods from the phase at time 0.
    pub angle: f64,
    /// Impacts of the orbit, the touch left out.
    pub impacts: usize,
    /// True if the touch is a dying crossing, seen from the branch: at the clearance, p/n becomes
    /// (p - 1)/n. Otherwise a turning point reaches the surface, and p/n becomes (p + 1)/n.
    pub dies: bool,
    /// The surface that is touched; but for the clearance, the number of impacts stays.
    pub surface: SwitchingSurface,
    /// True if the orbit is its own mirror image half its period later, and touches both of two equal stops.
    pub is_symmetric: bool,
    /// Crossings of the orbit, the touch left out, or both.
    pub(crate) crossings: usize,
}

impl SpecialKind {
    /// The kind of special point as a symbol, as in the paper's table where it has one: SN, PD, NS, G, PF.
    pub fn symbol(&self) -> &'static str {
        match self {
            Self::Critical(TestFunction::Fold) => "SN",
            Self::Critical(TestFunction::Flip) => "PD",
            Self::Critical(TestFunction::NeimarkSacker) => "NS",
            Self::Grazing(_) => "G",
            Self::Pitchfork => "PF",
        }
    }

    /// The kind of special point in words.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Critical(TestFunction::Fold) => "fold",
            Self::Critical(TestFunction::Flip) => "flip",
            Self::Critical(TestFunction::NeimarkSacker) => "Neimark-Sacker",
            Self::Grazing(_) => "grazing",
            Self::Pitchfork => "pitchfork",
        }
    }
}

/// A special point of a branch.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct SpecialPoint {
    /// The kind of special point.
    pub kind: SpecialKind,
    /// The point of the branch.
    pub point: BranchPoint,
}

impl SpecialPoint {
    /// True if the special point is this point of the branch.
    pub(crate) fn is_at(&self, point: &BranchPoint) -> bool {
        self.point.parameter == point.parameter && self.point.state() == point.state()
    }
}
