//! Points spread over a box: Owen-scrambled Sobol points and those of an additive sequence, evenly, and random ones.
//!
//! They come from the crate `sobol_burley` (direction numbers of Joe and Kuo; Owen's scrambling by Laine and Karras's
//! hash, Burley 2020), which has 2^16 of them, to 24 bits, under each seed. So a million are 16 sequences that are
//! scrambled independently: randomised quasi-Monte-Carlo, whose scatter from sequence to sequence is its error.

/// Number of points of one scrambled Sobol sequence; later points are of the next sequence, scrambled independently.
pub const SEQUENCE_LENGTH: usize = 1 << 16;
/// Largest number of coordinates of a Sobol point.
pub const MAX_DIMENSIONS: u32 = 4 * sobol_burley::NUM_DIMENSION_SETS_4D;
/// An odd number by which seeds of Sobol sequences are multiplied, so that no two seeds share a sequence soon.
const SEED_STEP: u32 = 0x9e37_79b9;

/// One coordinate, between 0 and 1, of the scrambled Sobol point `index`; `dimension`: which, below [`MAX_DIMENSIONS`].
pub fn sobol_coordinate(seed: u32, index: u64, dimension: u32) -> f64 {
    let sequence = (index / SEQUENCE_LENGTH as u64) as u32 ^ seed.wrapping_mul(SEED_STEP);
    let within = (index % SEQUENCE_LENGTH as u64) as u32;
    // Half the distance between numbers of 24 bits in [0, 1): coordinates lie in the middle of their cells.
    let centring = 0.25 * f64::from(f32::EPSILON);
    f64::from(sobol_burley::sample(within, dimension, sequence)) + centring
}

/// The scrambled Sobol point `index` with at most [`MAX_DIMENSIONS`] coordinates between -1 and 1.
pub fn sobol_point(index: usize, dimensions: usize) -> Vec<f64> {
    let coordinate = |dimension| 2.0 * sobol_coordinate(0, index as u64, dimension) - 1.0;
    (0..dimensions as u32).map(coordinate).collect()
}

/// One coordinate, between 0 and 1, of the pseudo-random point `index`: SplitMix64 (Steele et al. 2014); `dimension`: which.
pub fn random_coordinate(seed: u32, index: u64, dimension: u32) -> f64 {
    let stream = u64::from(seed) << 32 | u64::from(dimension);
    uniform_from_seed(index ^ scramble_bits(stream))
}

/// A pseudo-random number between 0 and 1 from a seed, the same for the same seed.
pub(crate) fn uniform_from_seed(seed: u64) -> f64 {
    (scramble_bits(seed) >> 11) as f64 / (1u64 << 53) as f64
}

/// A number whose bits all depend on all bits of the seed: the mixing function of SplitMix64, for pseudo-random coordinates.
fn scramble_bits(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The point with this index from 0 on of a quasi-random sequence that fills the unit square evenly, shifted by a point of the
/// square: multiples of 1/g and 1/g^2 with g^3 = g + 1 (Roberts 2018).
pub fn evenly_spread_point(shifts: [f64; 2], index: usize) -> [f64; 2] {
    let steps = [0.754_877_666_246_692_7, 0.569_840_290_998_053_3];
    std::array::from_fn(|axis| (shifts[axis] + steps[axis] * (index + 1) as f64).fract())
}
