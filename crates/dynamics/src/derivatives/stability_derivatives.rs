//! Derivatives of the stability of a periodic motion: of trace and determinant, by differences of exact matrices.

use nalgebra::Vector2;

use softstop::{Parameter, Scene};

use super::figure_recorder::DifferentiatedFigure;
use super::motion_variation::MotionVariation;
use crate::orbit::{Orbit, OrbitError, StroboscopicMap};
use crate::tolerance::SAME;

/// Shares of a parameter over which the monodromy matrix is differenced, each where the ones before fail.
const DIFFERENCE_SHARES: [f64; 4] = [1e-4, 1e-5, 1e-6, 1e-7];
/// Share by which differences over one width and over twice that width may lie apart.
const DIFFERENCE_AGREEMENT: f64 = 0.01;

/// Trace and determinant of the monodromy matrix, with their derivatives.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct StabilityDerivatives {
    /// The trace.
    pub trace: DifferentiatedFigure,
    /// The determinant.
    pub determinant: DifferentiatedFigure,
}

impl StabilityDerivatives {
    /// The modulus of the larger multiplier with its derivatives, which are infinite at a double one.
    pub fn largest_multiplier(&self) -> DifferentiatedFigure {
        let (trace, determinant) = (self.trace.value, self.determinant.value);
        let half = 0.5 * trace;
        let square = half * half - determinant;
        let pairs = self.trace.by.iter().zip(&self.determinant.by);
        if square < 0.0 {
            let value = determinant.sqrt();
            let by = pairs.map(|(_, by)| 0.5 * by / value).collect();
            return DifferentiatedFigure { value, by };
        }
        let root = square.sqrt().copysign(half);
        let value = half + root;
        let rate = |(trace, determinant): (&f64, &f64)| {
            value.signum() * (value * trace - determinant) / (2.0 * root)
        };
        DifferentiatedFigure {
            value: value.abs(),
            by: pairs.map(rate).collect(),
        }
    }
}

/// The stability of a periodic motion: by differences of the fourth order of the exact monodromy matrix along the orbit's
/// own exact derivative, at the cost of four maps for each parameter.
///
/// # Errors
/// As [`differentiate_orbit`](super::differentiate_orbit); [`NoDerivative`](softstop::MotionError::NoDerivative) also where motions beside cross something
/// else, however near.
pub fn differentiate_stability(
    orbit: &Orbit,
    parameters: &[Parameter],
) -> Result<StabilityDerivatives, OrbitError> {
    let variation =
        MotionVariation::of_motion(&orbit.scene, orbit.state(), orbit.periods, parameters)?;
    let rates = variation.stability_rates(&orbit.scene, orbit.periods)?;
    let figure = |value: f64, which: usize| DifferentiatedFigure {
        value,
        by: rates.iter().map(|rates| rates[which]).collect(),
    };
    Ok(StabilityDerivatives {
        trace: figure(orbit.monodromy.trace(), 0),
        determinant: figure(orbit.monodromy.determinant(), 1),
    })
}

impl MotionVariation {
    /// Derivatives of trace and determinant of the monodromy matrix along the orbit, by each parameter.
    pub(super) fn stability_rates(
        &self,
        scene: &Scene,
        periods: u64,
    ) -> Result<Vec<[f64; 2]>, OrbitError> {
        let (positions, velocities) = self.start_state(&self.state_rates()?);
        let impacts = self.watched.impacts.len();
        let ways = positions.by.iter().zip(&velocities.by);
        let each = self.parameters.iter().zip(ways);
        let rates = each.map(|(parameter, (position, velocity))| {
            let along = Vector2::new(*position, *velocity);
            let value = parameter.get(scene)?;
            let size = if value == 0.0 { 1.0 } else { value.abs() };
            DIFFERENCE_SHARES.iter().find_map(|share| {
                let width = share * size;
                let beside = |width: f64| {
                    let mut scene = scene.clone();
                    parameter.set(&mut scene, value + width);
                    let map = StroboscopicMap::new(&scene.check().ok()?, periods);
                    let passage = map.apply(self.start + width * along).ok()?;
                    let same = passage.impacts.len() == impacts;
                    let matrix = passage.monodromy;
                    same.then(|| Vector2::new(matrix.trace(), matrix.determinant()))
                };
                let central = |width: f64| Some((beside(width)? - beside(-width)?) / (2.0 * width));
                let (wide, narrow) = (central(2.0 * width)?, central(width)?);
                let found = (4.0 * narrow - wide) / 3.0;
                let settled =
                    (wide - narrow).norm() <= DIFFERENCE_AGREEMENT * found.norm() + SAME / size;
                settled.then_some([found.x, found.y])
            })
        });
        let rates: Option<Vec<_>> = rates.collect();
        rates.ok_or_else(|| OrbitError::no_derivative(&self.parameters))
    }
}
