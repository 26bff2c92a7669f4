//! Smooth functions of the coordinates, fitted to some of their values.

use nalgebra::{DMatrix, DVector};

/// Most terms of a model.
const MOST_TERMS: usize = 200;
/// Highest degree.
const HIGHEST: usize = 8;
/// Values that are known, for each term.
const VALUES: usize = 3;

/// A polynomial in the coordinates, of a total degree, as a sum of products of Legendre's polynomials, with `N` values.
#[derive(Debug, Clone)]
pub struct Model<const N: usize> {
    /// The degrees of each term.
    terms: Vec<Vec<usize>>,
    degree: usize,
    factors: Vec<[f64; N]>,
}

impl<const N: usize> Model<N> {
    /// How many values to know at best, for so many coordinates.
    pub fn wanted(dimensions: usize) -> usize {
        VALUES * terms(dimensions, degree(dimensions, usize::MAX)).len()
    }

    /// The one that is nearest to these values, each at its coordinates, by least squares; of a lower degree where they are
    /// few. None for no values.
    pub fn fit(places: &[Vec<f64>], values: &[[f64; N]]) -> Option<Self> {
        let dimensions = places.first()?.len();
        let degree = degree(dimensions, places.len() / VALUES);
        let mut model = Self {
            terms: terms(dimensions, degree),
            degree,
            factors: Vec::new(),
        };
        let rows: Vec<f64> = places.iter().flat_map(|at| model.products(at)).collect();
        let matrix = DMatrix::from_row_slice(places.len(), model.terms.len(), &rows);
        let normal = (matrix.transpose() * &matrix).cholesky()?;
        let column = |which: usize| {
            let values = values.iter().map(|value| value[which]);
            normal.solve(&(matrix.transpose() * DVector::from_iterator(places.len(), values)))
        };
        let columns: Vec<DVector<f64>> = (0..N).map(column).collect();
        let factors = |term| std::array::from_fn(|which| columns[which][term]);
        model.factors = (0..model.terms.len()).map(factors).collect();
        Some(model)
    }

    /// Its values at some coordinates.
    pub fn at(&self, place: &[f64]) -> [f64; N] {
        let mut sum = [0.0; N];
        for (product, factors) in self.products(place).into_iter().zip(&self.factors) {
            for (sum, factor) in sum.iter_mut().zip(factors) {
                *sum += product * factor;
            }
        }
        sum
    }

    /// The terms without their factors.
    fn products(&self, place: &[f64]) -> Vec<f64> {
        let powers: Vec<[f64; HIGHEST + 1]> =
            place.iter().map(|at| legendre(*at, self.degree)).collect();
        let product = |degrees: &Vec<usize>| {
            let each = degrees.iter().zip(&powers);
            each.map(|(degree, powers)| powers[*degree]).product()
        };
        self.terms.iter().map(product).collect()
    }
}

/// Legendre's polynomials up to a degree.
fn legendre(at: f64, degree: usize) -> [f64; HIGHEST + 1] {
    let mut values = [1.0; HIGHEST + 1];
    values[1] = at;
    for n in 2..=degree {
        let order = n as f64;
        values[n] =
            ((2.0 * order - 1.0) * at * values[n - 1] - (order - 1.0) * values[n - 2]) / order;
    }
    values
}

/// The highest degree with few enough terms.
fn degree(dimensions: usize, most: usize) -> usize {
    let most = most.min(MOST_TERMS);
    let mut degree = 0;
    while degree < HIGHEST && count(dimensions, degree + 1) <= most {
        degree += 1;
    }
    degree
}

/// How many terms a total degree has.
fn count(dimensions: usize, degree: usize) -> usize {
    (1..=degree).fold(1, |count, n| count * (dimensions + n) / n)
}

/// The degrees of all terms up to a total degree.
fn terms(dimensions: usize, degree: usize) -> Vec<Vec<usize>> {
    let mut terms = vec![vec![]];
    for _ in 0..dimensions {
        let longer = terms.iter().flat_map(|term: &Vec<usize>| {
            let left = degree - term.iter().sum::<usize>();
            (0..=left).map(|power| [term.as_slice(), &[power]].concat())
        });
        terms = longer.collect();
    }
    terms
}
