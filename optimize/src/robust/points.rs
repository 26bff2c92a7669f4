//! Points spread evenly over a box: Owen-scrambled Sobol points.
//!
//! They come from the crate `sobol_burley` (direction numbers of Joe and Kuo; Owen's scrambling by Laine and Karras's
//! hash, Burley 2020), which has 2^16 of them, to 24 bits, under each seed. So a million are 16 sequences that are
//! scrambled independently: randomised quasi-Monte-Carlo, whose scatter from sequence to sequence is its error.

/// Points of a sequence; those that follow are of the next one.
pub const BLOCK: usize = 1 << 16;
/// Half the distance between numbers of 24 bits in [0, 1).
const HALF: f64 = 0.5 / (1 << 24) as f64;

/// Point `index` in as many dimensions, at most 256, each coordinate between -1 and 1.
pub fn place(index: usize, dimensions: usize) -> Vec<f64> {
    let (seed, index) = ((index / BLOCK) as u32, (index % BLOCK) as u32);
    let coordinate = |dimension| {
        let share = f64::from(sobol_burley::sample(index, dimension, seed)) + HALF;
        2.0 * share - 1.0
    };
    (0..dimensions as u32).map(coordinate).collect()
}

/// Corners of the box: all of them if they are not more than so many, otherwise those nearest to that many of the points.
pub(super) fn corners(dimensions: usize, most: usize) -> Vec<Vec<f64>> {
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
                place(index, dimensions)
                    .iter()
                    .map(|at| at.signum())
                    .collect()
            })
            .collect(),
    }
}
