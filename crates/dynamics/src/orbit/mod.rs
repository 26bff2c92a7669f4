//! Periodic motions: shooting on the exact map, multipliers, stability.

mod by_impacts;
mod close_orbit;
mod contact_passage;
mod deflation;
mod exponents;
mod free_frequency;
mod guess_impacts;
mod hardest_single;
mod impact_lattice;
mod monodromy;
mod multi_segment_shooting;
mod newton;
mod pattern;
mod periodic;
pub(crate) mod recurrence;
pub(crate) mod regime;
mod search;
mod smallest_period;
mod stroboscopic_map;
mod trials;

pub(crate) use exponents::BATCH_PERIODS;
pub use exponents::Exponents;
pub(crate) use hardest_single::hardest_single;
pub(crate) use impact_lattice::{singles_about, singles_near};
pub use monodromy::Monodromy;
pub(crate) use newton::ROUNDING_SHARE;
pub use newton::find_fixed_point;
pub use pattern::{ImpactCount, ImpactPattern};
pub use periodic::Orbit;
pub use regime::Regime;
pub(crate) use search::find_batch;
pub use search::{find, find_with_monitor};
pub(crate) use smallest_period::smallest_period;
pub use stroboscopic_map::{Passage, StroboscopicMap};

use std::ops::ControlFlow;

use nalgebra::{Complex, Matrix2};
use thiserror::Error;

use crate::monitor::Monitor;
use softstop::{MotionError, SceneError};

/// Why a periodic orbit could not be found or followed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum OrbitError {
    /// The search found none.
    #[error(
        "no stable z = 1 motion found at frequency {frequency} rad/s with clearance {clearance} m"
    )]
    NotFound {
        /// The drive's frequency in rad/s.
        frequency: f64,
        /// The clearance in m.
        clearance: f64,
    },
    /// Newton's method did not settle.
    #[error("Newton's method did not settle: residual {residual}")]
    Diverged {
        /// The last residual, in m and m/s.
        residual: f64,
    },
    /// Orbits lie side by side, as where dry friction holds the mass for good, at one place or another.
    #[error("the periodic motion is one of many, side by side: no single one can be followed")]
    NotIsolated,
    /// The periodic motion has another number of impacts.
    #[error("the periodic motion has {impacts} impacts in its period, not one")]
    OtherRegime {
        /// Impacts in the period.
        impacts: usize,
    },
    /// The monitor asked for it.
    #[error("stopped")]
    Stopped,
    /// The motion cannot be computed.
    #[error(transparent)]
    Motion(#[from] MotionError),
}

impl OrbitError {
    /// Newton's method led nowhere, or away.
    pub(crate) const LOST: Self = Self::Diverged { residual: f64::NAN };

    /// [`OrbitError::Stopped`] if a monitor wants to stop.
    pub(crate) fn ask_monitor(monitor: Monitor<'_>) -> Result<(), Self> {
        match monitor(0, 0) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(Self::Stopped),
        }
    }
}

impl From<SceneError> for OrbitError {
    fn from(error: SceneError) -> Self {
        Self::Motion(error.into())
    }
}

/// Eigenvalues of a 2x2 matrix, the one of larger modulus first.
pub fn multipliers(matrix: &Matrix2<f64>) -> [Complex<f64>; 2] {
    quadratic_roots(matrix.trace(), matrix.determinant())
}

/// The roots of mu^2 - trace mu + determinant, the one of larger modulus first.
fn quadratic_roots(trace: f64, determinant: f64) -> [Complex<f64>; 2] {
    let half = 0.5 * trace;
    let discriminant = half * half - determinant;
    if discriminant < 0.0 {
        let imaginary = (-discriminant).sqrt();
        return [
            Complex::new(half, imaginary),
            Complex::new(half, -imaginary),
        ];
    }
    let large = half + discriminant.sqrt().copysign(half);
    let small = if large == 0.0 {
        0.0
    } else {
        determinant / large
    };
    [Complex::new(large, 0.0), Complex::new(small, 0.0)]
}
