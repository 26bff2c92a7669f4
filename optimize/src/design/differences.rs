//! Differences, for what has no exact derivatives.

use softstop::Machine;

use super::Design;
use super::operating_point::SearchPoint;
use super::problem::Problem;
use super::space::Axis;

/// Central differences of values of the machine by each coordinate of the cube that is moved, one row for each: over a change to
/// either side, in edges of the cube.
pub(super) fn machine_differences(
    (problem, at): (&Problem, &SearchPoint<'_>),
    change: f64,
    values: impl Fn(Machine) -> Option<Vec<f64>>,
) -> Option<Vec<Vec<f64>>> {
    let axes = problem.axes.iter().enumerate();
    let free: Vec<(usize, &Axis)> = axes.filter(|(_, axis)| !axis.range.is_held()).collect();
    let nominal = problem.axis_values(at.unit);
    let row = |index: &usize| {
        let (index, axis) = free[*index];
        let aside = |by: f64| {
            let mut moved = nominal.clone();
            moved[index] += by * axis.rate(moved[index]);
            values(problem.machine_at(&moved))
        };
        Some(difference(&aside(-change)?, &aside(change)?, 2.0 * change))
    };
    at.moved.iter().map(row).collect()
}

/// Differences of values over a width.
pub(super) fn difference(before: &[f64], after: &[f64], width: f64) -> Vec<f64> {
    let pairs = before.iter().zip(after);
    pairs
        .map(|(before, after)| (after - before) / width)
        .collect()
}

/// Half of a difference's width, in edges of the cube.
const WIDTH: f64 = 1e-5;

/// Central differences of values by each coordinate, one row for each.
pub(super) fn differences(
    problem: &Problem,
    at: &SearchPoint<'_>,
    values: &impl Fn(&Design) -> Option<Vec<f64>>,
) -> Option<Vec<Vec<f64>>> {
    let count = at.moved.len() + usize::from(at.place.is_some());
    let row = |index: usize| {
        let aside = |by: f64| {
            let (mut unit, mut place) = (at.unit.to_vec(), at.place);
            let moved = at.moved.get(index).and_then(|index| unit.get_mut(*index));
            let coordinate = moved.or(place.as_mut())?;
            *coordinate = (*coordinate + by).clamp(0.0, 1.0);
            let coordinate = *coordinate;
            let aside = SearchPoint {
                unit: &unit,
                moved: at.moved,
                place,
            };
            let here = Design::find(problem, &aside)?;
            Some((coordinate, values(&here)?))
        };
        let ((low, before), (high, after)) = (aside(-WIDTH)?, aside(WIDTH)?);
        Some(difference(&before, &after, high - low))
    };
    (0..count).map(row).collect()
}
