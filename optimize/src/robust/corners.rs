//! Corners of the box of tolerances.

use softstop_dynamics::spread_points::sobol_point;

/// Corners of the box: all of them if they are not more than so many, otherwise those nearest to that many of the points.
pub(crate) fn corners(dimensions: usize, most: usize) -> Vec<Vec<f64>> {
    let all = 1_usize.checked_shl(dimensions as u32);
    let all = all.filter(|all| *all <= most);
    let sign = |is_up| if is_up { 1.0 } else { -1.0 };
    let corner = |index: usize| match all {
        Some(_) => (0..dimensions)
            .map(|bit| sign(index >> bit & 1 == 1))
            .collect(),
        None => sobol_point(index, dimensions)
            .into_iter()
            .map(f64::signum)
            .collect(),
    };
    (0..all.unwrap_or(most)).map(corner).collect()
}
