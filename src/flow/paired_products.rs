//! Products of series whose coefficients come one after the other, two products side by side in one register.

use wide::f64x2;

use super::taylor_polynomials::DEGREE;

/// Number of coefficients that are multiplied in one row of a paired product.
const ROW_LENGTH: usize = 4;
/// Length of a column of factors, a row of zeros included.
const COLUMN_LENGTH: usize = DEGREE + ROW_LENGTH;

/// For each of N pairs of products: one coefficient of the first and the same of the second.
type PairedCoefficients<const N: usize> = [[f64; 2]; N];

/// N pairs of products of power series, their coefficients computed in order.
pub(super) struct Products<const N: usize> {
    /// The factors on the left from the second coefficient to the last, after a row of zeros.
    left: [[f64x2; N]; COLUMN_LENGTH],
    /// The factors on the right from the last coefficient to the second.
    right: [[f64x2; N]; COLUMN_LENGTH],
    /// The first coefficients of both.
    first: [[f64x2; N]; 2],
}

impl<const N: usize> Products<N> {
    /// Products of series whose coefficients are not given yet.
    pub const ZERO: Self = Self {
        left: [[f64x2::ZERO; N]; COLUMN_LENGTH],
        right: [[f64x2::ZERO; N]; COLUMN_LENGTH],
        first: [[f64x2::ZERO; N]; 2],
    };

    /// The k-th coefficients of the paired products, by the k-th of their factors. To be called for k = 0, 1, ... in order.
    #[inline(always)]
    pub fn next_terms(
        &mut self,
        k: usize,
        left: PairedCoefficients<N>,
        right: PairedCoefficients<N>,
    ) -> PairedCoefficients<N> {
        let (left, right) = (left.map(side_by_side), right.map(side_by_side));
        if k == 0 {
            self.first = [left, right];
            return std::array::from_fn(|n| (left[n] * right[n]).to_array());
        }
        let inner = self.inner_sums(k);
        let [first_left, first_right] = &self.first;
        let outer = |n: usize| left[n] * first_right[n] + first_left[n] * right[n];
        let sums = std::array::from_fn(|n| (inner[n] + outer(n)).to_array());
        self.left[ROW_LENGTH + k - 1] = left;
        self.right[COLUMN_LENGTH - k] = right;
        sums
    }

    /// The k-th coefficients of the paired products without the terms of the first coefficients of their factors.
    #[inline(always)]
    fn inner_sums(&self, k: usize) -> [f64x2; N] {
        let length = (k - 1).next_multiple_of(ROW_LENGTH);
        let (left, _) =
            self.left[ROW_LENGTH + k - 1 - length..ROW_LENGTH + k - 1].as_chunks::<ROW_LENGTH>();
        let (right, _) = self.right[COLUMN_LENGTH - length..].as_chunks::<ROW_LENGTH>();
        let mut sums = [[f64x2::ZERO; N]; 2];
        for (left, right) in left.iter().zip(right) {
            for row in 0..ROW_LENGTH {
                for n in 0..N {
                    sums[row % 2][n] += left[row][n] * right[row][n];
                }
            }
        }
        std::array::from_fn(|n| sums[0][n] + sums[1][n])
    }

    /// Replaces the k-th coefficients of the right factors of the paired products, for the orders above k.
    #[inline(always)]
    pub fn replace_right(&mut self, k: usize, right: PairedCoefficients<N>) {
        let place = match k {
            0 => &mut self.first[1],
            _ => &mut self.right[COLUMN_LENGTH - k],
        };
        *place = right.map(side_by_side);
    }
}

/// Two numbers, one of each product of a pair, in one register, never as an array in memory.
#[inline(always)]
fn side_by_side([a, b]: [f64; 2]) -> f64x2 {
    f64x2::transpose([f64x2::splat(a), f64x2::splat(b)])[0]
}
