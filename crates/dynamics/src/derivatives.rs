//! Exact derivatives by a machine's parameters of figures ([`differentiate_orbit`]), [`differentiate_stability`] and [`Border`].
//!
//! The motion x(0) = P(x(0), p) is followed by the implicit function theorem, (1 - M) dx/dp = dP/dp; M and dP/dp come from
//! the variational equation along the motion, with the saltation of each crossing. The drive angle at time 0 is held.
//!
//! ```
//! use softstop::{Parameter, Ratios};
//! use softstop_dynamics::{derivatives, orbit};
//!
//! let orbit = orbit::find(&Ratios::unloaded().scene()?)?;
//! let slopes = derivatives::differentiate_orbit(&orbit, &[Parameter::Clearance, Parameter::Frequency])?;
//! let velocity = &slopes.impacts[0].velocity;
//! assert!((velocity.value - 6.494_627_429_363).abs() < 1e-9);
//! assert!(velocity.by[1] > 0.0, "a faster drive strikes harder");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod border_normal;
mod figure_recorder;
mod motion_variation;
mod stability_derivatives;

pub use border_normal::{Border, BorderKind};
pub use figure_recorder::{DifferentiatedFigure, DifferentiatedImpact};
pub use stability_derivatives::{StabilityDerivatives, differentiate_stability};

use softstop::Parameter;

use crate::orbit::{Orbit, OrbitError};
use motion_variation::MotionVariation;

/// The figures of a periodic motion with their derivatives.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct OrbitDerivatives {
    /// The parameters that the derivatives are by.
    pub parameters: Vec<Parameter>,
    /// Position in m at time 0.
    pub position: DifferentiatedFigure,
    /// Velocity in m/s at time 0.
    pub velocity: DifferentiatedFigure,
    /// Its impacts within the period, in order of time from 0 on.
    pub impacts: Vec<DifferentiatedImpact>,
    /// Largest position in m: X_m.
    pub max_position: DifferentiatedFigure,
    /// Lowest position in m.
    pub min_position: DifferentiatedFigure,
    /// Largest force in N of stop and strip, impacts on a rigid stop left out; none where nothing is touched.
    pub peak_force: Option<DifferentiatedFigure>,
    /// Energy in J that the drive supplies in the motion's period, and that is dissipated in it.
    pub supplied: DifferentiatedFigure,
}

/// The derivatives of a periodic orbit's figures, stable or not, by parameters of its machine.
///
/// # Errors
/// [`OrbitError::Motion`] with [`MotionError::NoDerivative`](softstop::MotionError) or [`SceneError::Lacks`](softstop::SceneError)
/// where there is no derivative, or no parameter; [`OrbitError::NotIsolated`] at a fold.
pub fn differentiate_orbit(
    orbit: &Orbit,
    parameters: &[Parameter],
) -> Result<OrbitDerivatives, OrbitError> {
    let variation =
        MotionVariation::of_motion(&orbit.scene, orbit.state(), orbit.periods, parameters)?;
    let starts = variation.state_rates()?;
    let figure = |found: &DifferentiatedFigure| DifferentiatedFigure {
        value: found.value,
        by: variation.total_rates(found, &starts),
    };
    let missing = || OrbitError::no_derivative(&variation.parameters);
    let watched = &variation.watched;
    let (position, velocity) = variation.start_state(&starts);
    Ok(OrbitDerivatives {
        parameters: parameters.to_vec(),
        position,
        velocity,
        impacts: watched
            .impacts
            .iter()
            .map(|[time, velocity]| DifferentiatedImpact {
                time: figure(time),
                velocity: figure(velocity),
            })
            .collect(),
        max_position: watched.highest.as_ref().map(figure).ok_or_else(missing)?,
        min_position: watched.lowest.as_ref().map(figure).ok_or_else(missing)?,
        peak_force: watched.force.as_ref().map(figure),
        supplied: figure(&variation.supplied),
    })
}
