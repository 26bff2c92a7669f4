//! Numbers of the continuous inputs.

pub(crate) const FORCE: usize = 0;
pub(crate) const BASE: usize = 1;
pub(crate) const SPEED: usize = 2;
pub(crate) const AMPLITUDE: usize = 3;
