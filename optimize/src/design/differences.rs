//! Differences, for what has no exact derivatives.

use super::operating_point::{At, OperatingPoint};
use super::problem::Problem;

/// Half of a difference's width, in edges of the cube.
const WIDTH: f64 = 1e-5;

/// Central differences of values by each coordinate, one row for each.
pub(super) fn differences(
    problem: &Problem,
    at: &At<'_>,
    values: &impl Fn(&OperatingPoint) -> Option<Vec<f64>>,
) -> Option<Vec<Vec<f64>>> {
    let count = at.moved.len() + usize::from(at.place.is_some());
    let row = |index: usize| {
        let aside = |by: f64| {
            let (mut unit, mut place) = (at.unit.to_vec(), at.place);
            let moved = at.moved.get(index).and_then(|index| unit.get_mut(*index));
            let coordinate = moved.or(place.as_mut())?;
            *coordinate = (*coordinate + by).clamp(0.0, 1.0);
            let coordinate = *coordinate;
            let aside = At {
                unit: &unit,
                moved: at.moved,
                place,
            };
            let here = OperatingPoint::find(problem, &aside)?;
            Some((coordinate, values(&here)?))
        };
        let ((low, before), (high, after)) = (aside(-WIDTH)?, aside(WIDTH)?);
        let pairs = before.iter().zip(&after);
        Some(
            pairs
                .map(|(before, after)| (after - before) / (high - low))
                .collect(),
        )
    };
    (0..count).map(row).collect()
}
