//! Periodic motions: shooting on the exact map, multipliers, stability.

mod close_orbit;
mod contact_passage;
mod deflation;
mod error;
mod exponents;
mod find;
mod fixed_points;
mod free_frequency;
mod harder_single_impact_orbit;
mod impact_lattice;
mod monodromy;
mod multi_segment_shooting;
mod pattern;
mod periodic;
pub(crate) mod recurrence;
pub(crate) mod regime;
mod smallest_period;
mod stroboscopic_map;
mod trials;

pub use error::OrbitError;
pub(crate) use exponents::LYAPUNOV_BATCH_PERIODS;
pub use exponents::LyapunovExponents;
pub use find::{find, find_with_monitor};
pub(crate) use find::{find_batch, find_with_known_orbits};
pub(crate) use harder_single_impact_orbit::harder_single_impact_orbit;
pub(crate) use impact_lattice::{
    single_impact_orbits_about_frequency, single_impact_orbits_near_impact,
};
pub use monodromy::Monodromy;
pub use pattern::{ImpactCount, ImpactPattern};
pub use periodic::Orbit;
pub use regime::Regime;
pub(crate) use smallest_period::smallest_period;
pub use stroboscopic_map::{MapApplication, StroboscopicMap, find_fixed_point};

use nalgebra::{Complex, Matrix2};

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
