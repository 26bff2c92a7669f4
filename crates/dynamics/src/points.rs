//! Points spread over a box: Owen-scrambled Sobol points, evenly, and random ones.
//!
//! They come from the crate `sobol_burley` (direction numbers of Joe and Kuo; Owen's scrambling by Laine and Karras's
//! hash, Burley 2020), which has 2^16 of them, to 24 bits, under each seed. So a million are 16 sequences that are
//! scrambled independently: randomised quasi-Monte-Carlo, whose scatter from sequence to sequence is its error.
//!
//! [`parallel_blocks`] hands the numbers of points out to all threads, in blocks whose outcomes come in order.

use std::ops::Range;

use rayon::prelude::*;

/// Points of one Sobol sequence; those that follow are of the next one.
pub const SEQUENCE_LENGTH: usize = 1 << 16;
/// Largest dimension of a point.
pub const MAX_DIMENSIONS: u32 = 4 * sobol_burley::NUM_DIMENSION_SETS_4D;
/// An odd multiplier of seeds whose multiples are far apart: no two seeds share a Sobol sequence soon.
const SEED_STEP: u32 = 0x9e37_79b9;

/// The numbers of points in blocks of `size`, on all threads, in order.
pub fn parallel_blocks(
    points: Range<u64>,
    size: u64,
) -> impl IndexedParallelIterator<Item = Range<u64>> + Clone {
    let Range { start, end } = points;
    let count = (end - start).div_ceil(size) as usize;
    (0..count).into_par_iter().map(move |block| {
        let first = start + block as u64 * size;
        first..(first + size).min(end)
    })
}

/// One coordinate, below [`MAX_DIMENSIONS`], of the scrambled Sobol point `index`, between 0 and 1.
pub fn sobol_coordinate(seed: u32, index: u64, dimension: u32) -> f64 {
    let sequence = (index / SEQUENCE_LENGTH as u64) as u32 ^ seed.wrapping_mul(SEED_STEP);
    let within = (index % SEQUENCE_LENGTH as u64) as u32;
    // Half the distance between numbers of 24 bits in [0, 1): coordinates lie in the middle of their cells.
    let centring = 0.25 * f64::from(f32::EPSILON);
    f64::from(sobol_burley::sample(within, dimension, sequence)) + centring
}

/// The scrambled Sobol point `index` in at most [`MAX_DIMENSIONS`], each coordinate between -1 and 1.
pub fn sobol_point(index: usize, dimensions: usize) -> Vec<f64> {
    let coordinate = |dimension| 2.0 * sobol_coordinate(0, index as u64, dimension) - 1.0;
    (0..dimensions as u32).map(coordinate).collect()
}

/// One coordinate of the pseudo-random point `index`, between 0 and 1: SplitMix64 (Steele et al. 2014).
pub fn random_coordinate(seed: u32, index: u64, dimension: u32) -> f64 {
    let stream = u64::from(seed) << 32 | u64::from(dimension);
    (scramble_bits(index ^ scramble_bits(stream)) >> 11) as f64 / (1u64 << 53) as f64
}

/// A number whose bits all depend on all bits of the seed: the mixing function of SplitMix64.
pub(crate) fn scramble_bits(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
