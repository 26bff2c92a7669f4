//! Why a periodic orbit could not be found or followed.

use std::ops::ControlFlow;

use thiserror::Error;

use crate::monitor::Monitor;
use softstop::{MotionError, Parameter, Scene, SceneError};

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
    /// An orbit that touches both stops at once is looked for in a machine whose stops differ.
    #[error("it touches two stops that are alike at once, and here they are not alike")]
    NotAlike,
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

    /// There is no stable z = 1 motion of this scene.
    pub(crate) fn not_found(scene: &Scene) -> Self {
        Self::NotFound {
            frequency: scene.excitation.frequency,
            clearance: scene.clearance,
        }
    }

    /// [`OrbitError::Stopped`] if a monitor wants to stop.
    pub(crate) fn ask_monitor(monitor: Monitor<'_>) -> Result<(), Self> {
        match monitor(0, 0) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(Self::Stopped),
        }
    }

    /// The error of a motion that has no derivatives by these parameters; the first of them, if any, is named.
    pub(crate) fn no_derivative(parameters: &[Parameter]) -> Self {
        let name = parameters.first().map_or("state", |first| first.name());
        MotionError::NoDerivative { name }.into()
    }
}

impl From<SceneError> for OrbitError {
    fn from(error: SceneError) -> Self {
        Self::Motion(error.into())
    }
}
