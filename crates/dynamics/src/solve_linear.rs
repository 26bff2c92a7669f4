//! Small linear systems.

use nalgebra::{Const, DMatrix, DVector, DimMin};

/// Solves A x = b by LU decomposition, systems of two or three equations without the heap; none if the matrix is singular.
pub(crate) fn solve_linear(matrix: &DMatrix<f64>, right: &DVector<f64>) -> Option<DVector<f64>> {
    match right.len() {
        2 => solve_fixed::<2>(matrix, right),
        3 => solve_fixed::<3>(matrix, right),
        _ => matrix.clone().lu().solve(right),
    }
}

/// Solves a system of N linear equations by LU decomposition with matrices of fixed size.
fn solve_fixed<const N: usize>(matrix: &DMatrix<f64>, right: &DVector<f64>) -> Option<DVector<f64>>
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    let matrix = matrix.fixed_view::<N, N>(0, 0).into_owned();
    let found = matrix.lu().solve(&right.fixed_rows::<N>(0))?;
    Some(DVector::from_column_slice(found.as_slice()))
}
