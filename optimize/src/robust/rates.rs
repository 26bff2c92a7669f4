//! Derivatives of what one motion tells by itself.

use std::f64::consts::TAU;

use softstop::Parameter;
use softstop_dynamics::derivatives::OrbitDerivatives;
use softstop_dynamics::figure::Figure;
use softstop_dynamics::{CycleMetrics, Orbit};

use crate::design::cost::{Cost, plus};

/// Distance, relative, within which two figures are the same one.
const SAME: f64 = 1e-9;

/// The derivatives of a figure of a motion, or of its cost, by the parameters of its slopes; none if it is not among those
/// that have exact ones.
pub fn rates(
    (figure, cost): (Figure, Option<&Cost>),
    slopes: &OrbitDerivatives,
    (orbit, stroke): (&Orbit, &CycleMetrics),
) -> Option<Vec<f64>> {
    let scene = &orbit.scene;
    let mass = scene.mass;
    let per_second = scene.excitation.frequency / TAU;
    let plus = |by: Vec<f64>, parameter, more| plus(slopes, by, parameter, more);
    let velocity = || match &slopes.impacts[..] {
        [impact] => Some(&impact.velocity),
        _ => None,
    };
    let energy = || {
        let velocity = velocity()?;
        let by = velocity.by.iter().map(|by| mass * velocity.value * by);
        let own = 0.5 * velocity.value * velocity.value;
        Some(plus(by.collect(), Parameter::Mass, own))
    };
    let power = |energy: Vec<f64>, value: f64| {
        let by = energy.iter().map(|by| by * per_second).collect();
        plus(by, Parameter::Frequency, value / TAU)
    };
    match figure {
        Figure::Velocity => Some(velocity()?.by.clone()),
        Figure::ImpactEnergy => energy(),
        Figure::ImpactPower => Some(power(energy()?, stroke.impact_energy)),
        Figure::DriveForce => Some(plus(
            vec![0.0; slopes.parameters.len()],
            Parameter::Amplitude,
            1.0,
        )),
        Figure::DrivePower => Some(power(slopes.supplied.by.clone(), slopes.supplied.value)),
        Figure::MaxPosition => Some(slopes.max_position.by.clone()),
        Figure::Stroke => {
            let pairs = slopes.max_position.by.iter().zip(&slopes.min_position.by);
            Some(pairs.map(|(high, low)| high - low).collect())
        }
        Figure::StopForce => {
            let peak = slopes.peak_force.as_ref()?;
            let is_same = (peak.value - stroke.stop_force).abs() <= SAME * peak.value.abs();
            is_same.then(|| peak.by.clone())
        }
        Figure::CutThrough => {
            let by = plus(slopes.max_position.by.clone(), Parameter::Clearance, -1.0);
            Some(plus(by, Parameter::Thickness, -1.0))
        }
        Figure::StopDeflection if slopes.max_position.value > scene.stop_position() => {
            let face = [
                Parameter::Clearance,
                Parameter::Thickness,
                Parameter::Travel,
            ];
            let by = slopes.max_position.by.clone();
            Some(face.into_iter().fold(by, |by, part| plus(by, part, -1.0)))
        }
        Figure::Cost => {
            let rates = |figure| rates((figure, None), slopes, (orbit, stroke));
            cost?.rates(slopes, (orbit, stroke), rates)
        }
        _ => None,
    }
}
