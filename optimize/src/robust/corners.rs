//! Corners of the box of tolerances.

use softstop_dynamics::points::sobol_point;

/// Corners of the box: all of them if they are not more than so many, otherwise those nearest to that many of the points.
pub(crate) fn corners(dimensions: usize, most: usize) -> Vec<Vec<f64>> {
    let all = 1_usize.checked_shl(dimensions as u32);
    let sign = |is_up| if is_up { 1.0 } else { -1.0 };
    match all.filter(|all| *all <= most) {
        Some(all) => (0..all)
            .map(|corner| {
                (0..dimensions)
                    .map(|bit| sign(corner >> bit & 1 == 1))
                    .collect()
            })
            .collect(),
        None => (0..most)
            .map(|index| {
                sobol_point(index, dimensions)
                    .iter()
                    .map(|at| at.signum())
                    .collect()
            })
            .collect(),
    }
}
