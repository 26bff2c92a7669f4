//! Branches that nobody watches.

use std::ops::ControlFlow;

use nalgebra::Vector2;
use softstop_dynamics::continuation::Family;
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::{Branch, BranchLimits, Continuation};

/// Lets a branch or a curve go on from any point.
pub fn go_on<T>(_: &T) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// The branch of orbits of some drive periods from a parameter and a state on, over a range, of so many points in each direction.
pub fn follow(
    family: &dyn Family,
    periods: u64,
    (parameter, state): (f64, impl Into<Vector2<f64>>),
    range: (f64, f64),
    points: usize,
) -> Result<Branch, OrbitError> {
    let limits = BranchLimits { range, points };
    Continuation::new(family, periods).branch(parameter, state.into(), &limits, go_on)
}
