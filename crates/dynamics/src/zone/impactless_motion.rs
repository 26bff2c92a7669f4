//! The motion without impacts: its amplitude, and the frequencies at which it grazes the stop (g0).

use std::convert::Infallible;

use super::{ZoneError, refuse_below};
use crate::tolerance::ROUNDING;
use softstop::Scene;
use softstop::internals::{highest_point, narrow_root};

/// Amplitude F0 / |k1 - m w^2 + i b1 w| in m of the impact-less motion at a frequency in rad/s.
pub fn free_amplitude(scene: &Scene, frequency: f64) -> f64 {
    own_free_amplitude(&scene.at_frequency(frequency))
}

/// Amplitude in m of the impact-less motion at the frequency of a scene's own drive.
fn own_free_amplitude(scene: &Scene) -> f64 {
    let frequency = scene.excitation.frequency;
    let spring = scene.stiffness - scene.mass * frequency * frequency;
    scene.excitation.amplitude / spring.hypot(scene.damping * frequency)
}

/// The largest amplitude in m of the impact-less motion, at resonance; infinite without damping.
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
/// Its amplitude F0 / |k1 - m w^2 + i b1 w| equals the clearance r where m w^2 = k1 - b1^2 / (2 m) +- sqrt((F0 / r)^2 - b1^2 (k1
/// / m - b1^2 / (2 m)^2)).
///
/// Where parameters follow the frequency by an expression, these are the lowest such frequency above which the stop is met, and
/// the highest below which it is. They are looked for at 4,096 frequencies from a hundredth of the slower to a hundred times the
/// faster one of drive and suspension, and at the peaks between these.
///
/// # Errors
/// [`ZoneError::StopBelow`], [`ZoneError::NoGrazing`] if the amplitude never equals the clearance, [`ZoneError::Orbit`] for a
/// scene that is none.
pub fn grazing_frequencies(scene: &Scene) -> Result<(Option<f64>, f64), ZoneError> {
    scene.validate()?;
    refuse_below(scene)?;
    if !scene.followers.is_empty() {
        return search_grazing(scene);
    }
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

/// Number of frequencies, evenly spread over their logarithm, at which grazings are searched.
const SEARCH_STEPS: usize = 4096;

/// Searches the [`grazing_frequencies`] of a scene whose parameters follow the drive's frequency by expressions.
fn search_grazing(scene: &Scene) -> Result<(Option<f64>, f64), ZoneError> {
    let own = (scene.stiffness / scene.mass).sqrt();
    let drive = scene.excitation.frequency;
    let slowest = if own > 0.0 { drive.min(own) } else { drive } / 100.0;
    let step = (drive.max(own) * 100.0 / slowest).ln() / SEARCH_STEPS as f64;
    let at = |index: usize| slowest * (step * index as f64).exp();
    // Between -1 and 1, and of the sign of the amplitude's excess over the clearance.
    let excess = |w: f64| {
        let scene = scene.at_frequency(w);
        let (amplitude, clearance) = (own_free_amplitude(&scene), scene.clearance);
        (amplitude - clearance) / (amplitude + clearance.abs())
    };
    let all: Vec<f64> = (0..=SEARCH_STEPS).map(|index| excess(at(index))).collect();
    let peaks = (1..SEARCH_STEPS).filter_map(|index| {
        let sign = -all[index].signum();
        let heights = [index - 1, index, index + 1].map(|index| sign * all[index]);
        let [before, height, after] = heights;
        // Not where it is constant, as 1 without clearance.
        if !(height >= before.max(after) && height > before.min(after)) {
            return None;
        }
        let (low, high) = (at(index - 1), at(index + 1));
        let (w, value) = highest_point(low, high, ROUNDING * high, |w| sign * excess(w));
        Some((w, sign * value))
    });
    let samples = all
        .iter()
        .enumerate()
        .map(|(index, excess)| (at(index), *excess));
    let mut seen: Vec<(f64, f64)> = samples.chain(peaks).collect();
    seen.sort_by(|one, other| one.0.total_cmp(&other.0));
    let meets = |place: &(f64, f64)| place.1 >= 0.0;
    let mut pairs = seen.windows(2);
    let root = |pair: &[(f64, f64)]| {
        let width = f64::EPSILON * pair[1].0;
        let Ok((low, high)) =
            narrow_root(pair[0], pair[1], width, |w| Ok::<_, Infallible>(excess(w)));
        low.midpoint(high)
    };
    let below = pairs
        .clone()
        .find(|pair| !meets(&pair[0]) && meets(&pair[1]));
    match pairs.rfind(|pair| meets(&pair[0]) && !meets(&pair[1])) {
        Some(above) => Ok((below.map(root), root(above))),
        None => Err(ZoneError::NoGrazing {
            clearance: scene.clearance,
            largest: seen
                .iter()
                .fold(0.0, |most, (w, _)| most.max(free_amplitude(scene, *w))),
        }),
    }
}
