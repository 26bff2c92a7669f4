//! Periodic motions: shooting on the exact map, multipliers, stability.

mod map;
mod search;
mod sensitivity;
mod tangent;

pub use map::{Passage, StroboscopicMap};
pub use search::find;
pub use sensitivity::{Perturbation, Sensitivity};
pub use tangent::{Tangent, saltation};

use nalgebra::{Complex, Matrix2, Vector2};
use thiserror::Error;

use crate::error::{MotionError, SceneError};
use crate::scene::Scene;

/// A periodic motion of the regime z = 1: one impact in one drive period.
#[derive(Debug, Clone, PartialEq)]
pub struct Orbit {
    /// The scene it belongs to.
    pub scene: Scene,
    /// Position in m at time 0, that is at drive angle phi.
    pub position: f64,
    /// Velocity in m/s at time 0.
    pub velocity: f64,
    /// Velocity in m/s at which the clearance is passed.
    pub before_impact_velocity: f64,
    /// Largest position in m.
    pub max_position: f64,
    /// Jacobian of the map over the period, saltation included.
    pub monodromy: Matrix2<f64>,
    /// Integral of damping over mass along the period: det = exp(-integral), times R^2 for a rebound
    /// from a rigid stop, unless the mass turns or sticks under dry friction.
    pub damping_integral: f64,
}

/// Why there is no orbit.
#[derive(Debug, Clone, PartialEq, Error)]
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
    /// The periodic motion has another number of impacts.
    #[error("the periodic motion has {impacts} impacts in its period, not one")]
    OtherRegime {
        /// Impacts in the period.
        impacts: usize,
    },
    /// The motion cannot be computed.
    #[error(transparent)]
    Motion(#[from] MotionError),
}

impl From<SceneError> for OrbitError {
    fn from(error: SceneError) -> Self {
        Self::Motion(error.into())
    }
}

impl Orbit {
    /// The z = 1 orbit, stable or not, that Newton's method reaches from a state near it.
    ///
    /// # Errors
    /// [`OrbitError`] if Newton's method does not settle or settles on another regime.
    pub fn near(scene: &Scene, state: Vector2<f64>) -> Result<Self, OrbitError> {
        let map = StroboscopicMap::new(scene, 1)?;
        let (state, passage) = fixed_point(&map, state)?;
        Self::on(scene, &map, state, &passage)
    }

    /// The orbit through a fixed point that is already known.
    pub(crate) fn on(
        scene: &Scene,
        map: &StroboscopicMap,
        state: Vector2<f64>,
        passage: &Passage,
    ) -> Result<Self, OrbitError> {
        let [before_impact_velocity] = passage.impacts[..] else {
            return Err(OrbitError::OtherRegime {
                impacts: passage.impacts.len(),
            });
        };
        Ok(Self {
            scene: scene.clone(),
            position: state.x,
            velocity: state.y,
            before_impact_velocity,
            max_position: map.max_position(state)?,
            monodromy: passage.monodromy,
            damping_integral: passage.damping_integral,
        })
    }

    /// Trace of the monodromy matrix.
    pub fn trace(&self) -> f64 {
        self.monodromy.trace()
    }

    /// Determinant of the monodromy matrix.
    pub fn determinant(&self) -> f64 {
        self.monodromy.determinant()
    }

    /// Floquet multipliers, the roots of mu^2 - trace mu + determinant.
    pub fn multipliers(&self) -> [Complex<f64>; 2] {
        multipliers(&self.monodromy)
    }

    /// True if both multipliers lie inside the unit circle.
    pub fn is_stable(&self) -> bool {
        is_stable(&self.monodromy)
    }
}

/// Eigenvalues of a 2x2 matrix, the one of larger modulus first.
pub fn multipliers(matrix: &Matrix2<f64>) -> [Complex<f64>; 2] {
    let (half, determinant) = (0.5 * matrix.trace(), matrix.determinant());
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

/// Jury's conditions: 1 - tr + det > 0 (no fold), 1 + tr + det > 0 (no flip), det < 1.
pub fn is_stable(matrix: &Matrix2<f64>) -> bool {
    let (trace, determinant) = (matrix.trace(), matrix.determinant());
    1.0 - trace + determinant > 0.0 && 1.0 + trace + determinant > 0.0 && determinant < 1.0
}

/// Newton steps before giving up.
const NEWTON_STEPS: usize = 30;

/// Newton's method for P(s) = s with the exact Jacobian. It ends when a step no longer makes the
/// residual smaller and the residual is at round-off.
///
/// # Errors
/// [`OrbitError::Diverged`] if it does not settle, [`OrbitError::Motion`] if a motion on the way
/// cannot be computed.
pub fn fixed_point(
    map: &StroboscopicMap,
    start: Vector2<f64>,
) -> Result<(Vector2<f64>, Passage), OrbitError> {
    let mut state = start;
    let mut passage = map.apply(state)?;
    let mut residual = passage.end - state;
    for _ in 0..NEWTON_STEPS {
        let matrix = Matrix2::identity() - passage.monodromy;
        let Some(step) = matrix.lu().solve(&residual) else {
            break;
        };
        let (next, next_passage) = within_walls(map, state, step)?;
        let next_residual = next_passage.end - next;
        let shrinks = next_residual.norm() < residual.norm();
        if !shrinks && residual.norm() <= round_off(&state, &passage) {
            return Ok((state, passage));
        }
        (state, passage, residual) = (next, next_passage, next_residual);
    }
    if residual.norm() <= round_off(&state, &passage) {
        return Ok((state, passage));
    }
    Err(OrbitError::Diverged {
        residual: residual.norm(),
    })
}

/// Halvings of a step that leads beyond a rigid stop.
const HALVINGS: i32 = 40;

/// The state after a step and its image; the step is shortened where it leads beyond a rigid stop.
fn within_walls(
    map: &StroboscopicMap,
    state: Vector2<f64>,
    step: Vector2<f64>,
) -> Result<(Vector2<f64>, Passage), MotionError> {
    let mut last = None;
    for halvings in 0..HALVINGS {
        let next = state + step * 0.5f64.powi(halvings);
        match map.apply(next) {
            Err(error @ MotionError::BeyondStop { .. }) => last = Some(error),
            passage => return Ok((next, passage?)),
        }
    }
    Err(last.unwrap_or(MotionError::NotFinite {
        name: "Newton step",
        value: step.norm(),
    }))
}

/// The residual that rounding alone may leave: that of the state, as the map stretches it.
pub(crate) fn round_off(state: &Vector2<f64>, passage: &Passage) -> f64 {
    1e-13 * (1.0 + state.norm()) * (1.0 + passage.monodromy.norm())
}
