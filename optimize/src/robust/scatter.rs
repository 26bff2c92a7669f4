//! Which tolerance eats the margin.

use crate::spread::{PolynomialModel, Surrogate, critical_normal, free_normal};
use softstop_dynamics::continuation::TestFunction;
use softstop_dynamics::monitor::{Monitor, unmonitored};
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::spread_points::{SEQUENCE_LENGTH, sobol_point};
use softstop_dynamics::zone::{ZoneError, find_zones};
use softstop_dynamics::{Orbit, Zone};

use super::Tolerances;
use super::indices::{SampleSize, SobolIndex, indices};
use super::worst::nominal_slopes;

/// How the motion and its margins change with each coordinate, by as much as its tolerance.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Sensitivities {
    /// Of the before-impact velocity, in m/s.
    pub velocity: Vec<f64>,
    /// Of the margin s_SN - w to the fold, in rad/s, if the zone ends there.
    pub to_fold: Option<Vec<f64>>,
    /// Of the margin w - g0, in rad/s, if there is a g0.
    pub to_free: Option<Vec<f64>>,
}

/// The sensitivities of a motion and of the zone of its machine.
///
/// # Errors
/// [`ZoneError`] where a fold has no derivatives, or there is no motion to difference beside this one.
pub fn sensitivities(
    spread: &Tolerances,
    nominal: &Orbit,
    zone: &Zone,
) -> Result<Sensitivities, ZoneError> {
    let centre = vec![0.0; spread.dimensions()];
    let fold = (TestFunction::Fold, &zone.high.point);
    let ends_in_fold = zone.high.is_critical(TestFunction::Fold);
    let fold = ends_in_fold.then(|| critical_normal(spread, &centre, fold));
    let fold = fold.transpose()?;
    Ok(Sensitivities {
        velocity: nominal_slopes(spread, nominal, &unmonitored)?,
        to_fold: fold.map(|normal| normal.iter().map(|part| -part).collect()),
        to_free: free_normal(spread, &centre).ok(),
    })
}

/// Sobol' indices of the coordinates.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Scatter {
    /// For the before-impact velocity.
    pub velocity: Vec<SobolIndex>,
    /// For the place in the zone of each machine.
    pub place: Vec<SobolIndex>,
}

/// Whose scatter that of the velocity and of the place in the zone is; none if a machine between the bounds loses the
/// motion or has no zone of this kind. Its ends are polynomials in the coordinates, fitted to exact ones.
///
/// # Errors
/// [`OrbitError`] if the nominal motion is not one to start from; [`OrbitError::Stopped`].
pub fn scatter(
    spread: &Tolerances,
    (nominal, zone): (&Orbit, &Zone),
    effort: SampleSize,
    watcher: Monitor<'_>,
) -> Result<Option<Scatter>, OrbitError> {
    let dimensions = spread.dimensions();
    // Of a sequence that the points do not use.
    let first = effort.sequences.max(2) * SEQUENCE_LENGTH;
    let known = first..first + PolynomialModel::wanted(dimensions);
    let known: Vec<Vec<f64>> = known.map(|index| sobol_point(index, dimensions)).collect();
    let guide = Surrogate::new(spread, nominal, &known)?;
    let scenes: Vec<_> = known.iter().map(|at| spread.scene(at)).collect();
    let zones = find_zones(zone.kind, &scenes, watcher).into_iter();
    let ends = |other: Zone| {
        let own = other.on_range(zone.range);
        [own.low.frequency, own.high.frequency]
    };
    let ends: Result<Vec<_>, _> = zones.map(|zone| zone.map(ends)).collect();
    if watcher(0, 0).is_break() {
        return Err(OrbitError::Stopped);
    }
    let Some(ends) = ends
        .ok()
        .and_then(|ends| PolynomialModel::fit(&known, &ends))
    else {
        return Ok(None);
    };
    let outputs = |at: &[f64]| {
        let [low, high] = ends.at(at);
        let share = (spread.scene(at).excitation.frequency - low) / (high - low);
        Some([guide.motion(at)?.velocity, share])
    };
    let found = indices(dimensions, effort, outputs, watcher);
    Ok(found.map(|[velocity, place]| Scatter { velocity, place }))
}
