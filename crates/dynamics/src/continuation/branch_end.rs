//! Why a branch ends, and the border collisions that may end it.

use crate::orbit::OrbitError;

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

/// What changes in an orbit where its branch ends in a border collision other than a grazing: a rest, a turn under friction, or
/// the number of surfaces that it crosses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BorderCollision {
    /// The mass comes to rest, by dry friction or at a surface, or ceases to.
    Rest,
    /// It turns once more, or once less, under dry friction.
    Turn,
    /// It crosses another number of surfaces.
    Surface,
}
