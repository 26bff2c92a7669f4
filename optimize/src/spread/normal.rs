//! Exact derivatives by the coordinates of a spread: normals of borders, and the chain rule for all else.

use super::Tolerances;
use softstop::{Parameter, Scene};
use softstop_dynamics::continuation::{BranchPoint, TestFunction};
use softstop_dynamics::derivatives::Border;
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::zone::ZoneError;

/// Change of a coordinate over which the machine's parameters are differenced: exact where they are linear in it, or
/// products of two that are.
const CHANGE: f64 = 0.125;

/// The normal of g0 at some coordinates: d(w - g0)/d(coordinate) in rad/s.
///
/// # Errors
/// [`ZoneError`] as of [`Border::at_g0`].
pub fn free_normal(spread: &Tolerances, at: &[f64]) -> Result<Vec<f64>, ZoneError> {
    let (scene, parameters) = (spread.scene(at), varied(spread, at));
    let border = Border::at_g0(&scene, true, &parameters)?;
    Ok(normal(spread, at, &border))
}

/// The normal of a fold or a flip: d(w - w_b)/d(coordinate) in rad/s, w_b the frequency, in rad/s, of this point of it, on
/// the branch over the frequency of the machine at some coordinates.
///
/// # Errors
/// [`OrbitError`] as of [`Border::at_special`].
pub fn critical_normal(
    spread: &Tolerances,
    at: &[f64],
    (test, point): (TestFunction, &BranchPoint),
) -> Result<Vec<f64>, OrbitError> {
    let (scene, parameters) = (spread.scene(at), varied(spread, at));
    let border = Border::at_special(&scene, 1, (test, point), &parameters)?;
    Ok(normal(spread, at, &border))
}

fn normal(spread: &Tolerances, at: &[f64], border: &Border) -> Vec<f64> {
    in_coordinates(spread, at, &border.parameters, &border.normal)
}

/// The machines on both sides of one along a coordinate.
fn beside(spread: &Tolerances, at: &[f64], index: usize) -> [Scene; 2] {
    [-CHANGE, CHANGE].map(|change| {
        let mut at = at.to_vec();
        at[index] += change;
        spread.scene(&at)
    })
}

/// How a parameter changes with a coordinate.
fn rate([below, above]: &[Scene; 2], parameter: Parameter) -> f64 {
    let values = parameter.get(below).zip(parameter.get(above));
    values.map_or(0.0, |(below, above)| (above - below) / (2.0 * CHANGE))
}

/// The parameters that change with the coordinates, in the order of [`Parameter::ALL`].
pub fn varied(spread: &Tolerances, at: &[f64]) -> Vec<Parameter> {
    let pairs: Vec<_> = (0..at.len())
        .map(|index| beside(spread, at, index))
        .collect();
    let changes = |parameter: &Parameter| pairs.iter().any(|pair| rate(pair, *parameter) != 0.0);
    Parameter::ALL.into_iter().filter(changes).collect()
}

/// Derivatives by parameters as derivatives by the coordinates, at some coordinates.
pub fn in_coordinates(
    spread: &Tolerances,
    at: &[f64],
    parameters: &[Parameter],
    by: &[f64],
) -> Vec<f64> {
    let part = |index: usize| {
        let pair = beside(spread, at, index);
        let each = parameters.iter().zip(by);
        each.map(|(parameter, by)| by * rate(&pair, *parameter))
            .sum()
    };
    (0..at.len()).map(part).collect()
}
