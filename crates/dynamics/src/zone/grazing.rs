//! The motion without impacts and where it grazes the stop.

use super::ZoneError;
use softstop::Scene;

/// Amplitude F0 / |k1 - m w^2 + i b1 w| in m of the impact-less motion at a frequency in rad/s.
pub fn free_amplitude(scene: &Scene, frequency: f64) -> f64 {
    let spring = scene.stiffness - scene.mass * frequency * frequency;
    scene.excitation.amplitude / spring.hypot(scene.damping * frequency)
}

/// The largest of these amplitudes, at resonance; infinite without damping.
fn largest_free_amplitude(scene: &Scene) -> f64 {
    let (m, k, force) = (scene.mass, scene.stiffness, scene.excitation.amplitude);
    let square = scene.damping * scene.damping;
    if m * k > 0.5 * square {
        m * force / (square * (m * k - 0.25 * square)).sqrt()
    } else {
        force / k
    }
}

/// Frequencies in rad/s at which the impact-less motion grazes the stop: (below resonance, above).
///
/// Its amplitude F0 / |k1 - m w^2 + i b1 w| equals the clearance r where
/// m w^2 = k1 - b1^2 / (2 m) +- sqrt((F0 / r)^2 - b1^2 (k1 / m - b1^2 / (2 m)^2)).
///
/// # Errors
/// [`ZoneError::NoGrazing`] if the amplitude never equals the clearance, [`ZoneError::Orbit`] for a
/// scene that is none.
pub fn grazing_frequencies(scene: &Scene) -> Result<(Option<f64>, f64), ZoneError> {
    scene.validate()?;
    let (m, k, r) = (scene.mass, scene.stiffness, scene.clearance);
    let (force, square) = (scene.excitation.amplitude, scene.damping * scene.damping);
    let centre = m * k - 0.5 * square;
    let least = square * (m * k - 0.25 * square);
    let discriminant = m * m * (force * force / (r * r)) - least;
    let above = (centre + discriminant.sqrt()) / (m * m);
    if !(r > 0.0 && force > 0.0 && discriminant >= 0.0 && above > 0.0) {
        return Err(ZoneError::NoGrazing {
            clearance: r,
            largest: largest_free_amplitude(scene),
        });
    }
    // The product of the roots: no cancellation for the smaller one.
    let below = (k - force / r) * (k + force / r) / (m * m) / above;
    Ok(((below > 0.0).then(|| below.sqrt()), above.sqrt()))
}
