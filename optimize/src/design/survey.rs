//! The survey of the outer search: a lattice over the box.

use argmin::core::{CostFunction, Error};

use super::cost::{Cost, Point, Stoppable};

/// Most points along an axis.
const LONGEST_EDGE: usize = 64;

/// Points of a lattice over the cube, its boundary included, the best ones first.
pub(super) fn survey(cost: &Cost<'_>, evaluations: u64) -> Result<Vec<Point>, Error> {
    let dimension = cost.space.dimension();
    let root = (evaluations as f64).powf(1.0 / dimension as f64) + 1e-9;
    let edge = (root as usize).clamp(2, LONGEST_EDGE);
    // Of a lattice with more points than that, corners and all, evenly many are taken.
    let whole = edge.checked_pow(dimension as u32).unwrap_or(usize::MAX);
    let count = whole.min((evaluations as usize).max(2));
    let units: Vec<Vec<f64>> = (0..count)
        .map(|index| (index as u128 * whole as u128 / count as u128) as usize)
        .map(|index| lattice_point(index, edge, dimension))
        .collect();
    let costs = Stoppable(cost).bulk_cost(&units)?;
    let points = units.into_iter().zip(costs);
    let mut points: Vec<Point> = points.map(|(unit, cost)| Point { unit, cost }).collect();
    points.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    Ok(points)
}

/// The point of this number in a lattice with `edge` points along each axis.
fn lattice_point(index: usize, edge: usize, dimension: usize) -> Vec<f64> {
    let unit = |axis: usize| edge.checked_pow(axis as u32).unwrap_or(usize::MAX);
    let digit = |axis: usize| index / unit(axis) % edge;
    (0..dimension)
        .map(|axis| digit(axis) as f64 / (edge - 1) as f64)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::lattice_point;

    #[test]
    fn the_survey_reaches_the_corners() {
        assert_eq!(lattice_point(0, 3, 2), [0.0, 0.0]);
        assert_eq!(lattice_point(5, 3, 2), [1.0, 0.5]);
        assert_eq!(lattice_point(8, 3, 2), [1.0, 1.0]);
    }
}
