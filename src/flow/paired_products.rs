//! Products of series whose coefficients come one after the other, two products side by side in one register.

use wide::f64x2;

use super::taylor::DEGREE;

/// Coefficients that are multiplied in a row.
const ROW: usize = 4;
/// Length of a column of factors, a row of zeros included.
const LENGTH: usize = DEGREE + ROW;

/// A pair of numbers for each of N pairs of products.
type Pairs<const N: usize> = [[f64; 2]; N];

/// N pairs of products of power series, their coefficients computed in order.
pub(super) struct Products<const N: usize> {
    /// The factors on the left from the second coefficient to the last, after a row of zeros.
    left: [[f64x2; N]; LENGTH],
    /// The factors on the right from the last coefficient to the second.
    right: [[f64x2; N]; LENGTH],
    /// The first coefficients of both.
    first: [[f64x2; N]; 2],
}

impl<const N: usize> Products<N> {
    /// Products of series whose coefficients are not given yet.
    pub const ZERO: Self = Self {
        left: [[f64x2::ZERO; N]; LENGTH],
        right: [[f64x2::ZERO; N]; LENGTH],
        first: [[f64x2::ZERO; N]; 2],
    };

    /// The k-th coefficients of the products, by the k-th of the factors. To be asked for in order.
    #[inline(always)]
    pub fn next_terms(&mut self, k: usize, left: Pairs<N>, right: Pairs<N>) -> Pairs<N> {
        let (left, right) = (left.map(side_by_side), right.map(side_by_side));
        if k == 0 {
            self.first = [left, right];
            return std::array::from_fn(|n| (left[n] * right[n]).to_array());
        }
        let inner = self.inner_sums(k);
        let [first_left, first_right] = &self.first;
        let outer = |n: usize| left[n] * first_right[n] + first_left[n] * right[n];
        let sums = std::array::from_fn(|n| (inner[n] + outer(n)).to_array());
        self.left[ROW + k - 1] = left;
        self.right[LENGTH - k] = right;
        sums
    }

    /// The k-th coefficients of the products without the terms of the first coefficients.
    #[inline(always)]
    fn inner_sums(&self, k: usize) -> [f64x2; N] {
        let length = (k - 1).next_multiple_of(ROW);
        let (left, _) = self.left[ROW + k - 1 - length..ROW + k - 1].as_chunks::<ROW>();
        let (right, _) = self.right[LENGTH - length..].as_chunks::<ROW>();
        let mut sums = [[f64x2::ZERO; N]; 2];
        for (left, right) in left.iter().zip(right) {
            for row in 0..ROW {
                for n in 0..N {
                    sums[row % 2][n] += left[row][n] * right[row][n];
                }
            }
        }
        std::array::from_fn(|n| sums[0][n] + sums[1][n])
    }

    /// Replaces the k-th coefficients on the right, for the orders that come.
    #[inline(always)]
    pub fn replace_right(&mut self, k: usize, right: Pairs<N>) {
        let place = match k {
            0 => &mut self.first[1],
            _ => &mut self.right[LENGTH - k],
        };
        *place = right.map(side_by_side);
    }
}

/// Two numbers in one register, never as an array in memory.
#[inline(always)]
fn side_by_side([a, b]: [f64; 2]) -> f64x2 {
    f64x2::transpose([f64x2::splat(a), f64x2::splat(b)])[0]
}
