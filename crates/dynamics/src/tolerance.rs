//! Tolerances of orbits: how near two quantities are that count as one.

/// Relative difference of two quantities that rounding alone may leave; Newton's method leaves about 1e-13 of a state.
pub(crate) const ROUNDING: f64 = 1e-9;
/// Relative difference up to which two orbits, or two figures of one orbit, are the same as far as Newton's method and
/// differences tell: near a fold an orbit is known to the square root of rounding alone.
pub(crate) const SAME: f64 = 1e-6;
/// Relative distance of two orbits, or of two figures, up to which Newton's method leads from one to the other.
pub(crate) const NEAR: f64 = 1e-3;
/// Half-width of central differences, in scaled unknowns; points of a branch nearer to each other are not told apart.
pub(crate) const DIFFERENCE_WIDTH: f64 = 1e-6;
/// Absolute value that rounding may leave of a scaled test function of a monodromy matrix where it vanishes, and relative error
/// of the place at which it does.
pub(crate) const TEST_ROUNDING: f64 = 1e-12;
/// Share of the rounding error of a residual down to which Newton's method goes on: no step makes a smaller residual smaller.
pub(crate) const ROUNDING_SHARE: f64 = 0.01;
/// Distance from a surface, or velocity at it, in units of those of the motion, up to which the motion nearly grazes the surface.
pub(crate) const NEAR_GRAZING: f64 = 1e-2;
/// Distance from a stable orbit, in units of the motion's size, within which a state is taken to lie in its basin.
pub(crate) const STABLE_REACH: f64 = 0.02;
/// Distance of two motions, in units of the larger, up to which they may be one motion, or one may continue the other.
pub(crate) const NEIGHBOUR: f64 = 0.1;
/// Difference of two simulated motions, not solved for by Newton's method, in units of the larger, up to which they are one.
pub(crate) const SIMILAR: f64 = 1e-2;
