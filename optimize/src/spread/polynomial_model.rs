//! Smooth functions of the coordinates, fitted to some of their values.

use std::slice;

use nalgebra::{DMatrix, DVector};

/// Most terms of a model.
const MOST_TERMS: usize = 300;
/// Highest degree.
const HIGHEST: usize = 8;
/// Values that are known, for each term.
const VALUES: usize = 3;

/// A polynomial in the coordinates, of a total degree, as a sum of products of Legendre's polynomials, with two values.
#[derive(Debug, Clone)]
pub struct PolynomialModel {
    degree: usize,
    /// Of each term, as [`each_term`] tells them.
    factors: Vec<[f64; 2]>,
}

impl PolynomialModel {
    /// How many values to know at best, for so many coordinates.
    pub fn wanted(dimensions: usize) -> usize {
        VALUES * count(dimensions, degree(dimensions, usize::MAX))
    }

    /// The one that is nearest to these values, each at its coordinates, by least squares; of a lower degree where they are
    /// few. None for no values.
    pub fn fit(places: &[Vec<f64>], values: &[[f64; 2]]) -> Option<Self> {
        let dimensions = places.first()?.len();
        let degree = degree(dimensions, places.len() / VALUES);
        let mut model = Self {
            degree,
            factors: Vec::new(),
        };
        let terms = count(dimensions, degree);
        let mut rows = Vec::with_capacity(places.len() * terms);
        for place in places {
            each_term(&model.powers(place), degree, 1.0, &mut |product| {
                rows.push(product);
            });
        }
        let matrix = DMatrix::from_row_slice(places.len(), terms, &rows);
        let normal = (matrix.transpose() * &matrix).cholesky()?;
        let column = |which: usize| {
            let values = values.iter().map(|value| value[which]);
            normal.solve(&(matrix.transpose() * DVector::from_iterator(places.len(), values)))
        };
        let columns: Vec<DVector<f64>> = (0..2).map(column).collect();
        let factors = |term| std::array::from_fn(|which| columns[which][term]);
        model.factors = (0..terms).map(factors).collect();
        Some(model)
    }

    /// Its values at some coordinates.
    pub fn at(&self, place: &[f64]) -> [f64; 2] {
        sum(&self.powers(place), self.degree, &mut self.factors.iter())
    }

    fn powers(&self, place: &[f64]) -> Vec<[f64; HIGHEST + 1]> {
        let powers = place.iter().map(|at| legendre(*at, self.degree));
        powers.collect()
    }
}

/// Tells the products of polynomials, one of each coordinate, whose degrees are `left` together or less.
fn each_term(powers: &[[f64; HIGHEST + 1]], left: usize, product: f64, tell: &mut impl FnMut(f64)) {
    match powers.split_first() {
        None => tell(product),
        Some((own, others)) => {
            for (degree, value) in own[..=left].iter().enumerate() {
                each_term(others, left - degree, product * value, tell);
            }
        }
    }
}

/// The sum of all products that [`each_term`] tells, each times its factors, which are taken in that order.
fn sum(
    powers: &[[f64; HIGHEST + 1]],
    left: usize,
    factors: &mut slice::Iter<'_, [f64; 2]>,
) -> [f64; 2] {
    let mut sums = [0.0; 2];
    let add = |sums: &mut [f64; 2], power: f64, [first, second]: [f64; 2]| {
        sums[0] += power * first;
        sums[1] += power * second;
    };
    let of_last = |last: &[f64], factors: &mut slice::Iter<'_, [f64; 2]>| {
        let mut sums = [0.0; 2];
        for (power, it) in last.iter().zip(factors) {
            add(&mut sums, *power, *it);
        }
        sums
    };
    match powers {
        [] => factors
            .next()
            .iter()
            .for_each(|it| add(&mut sums, 1.0, **it)),
        [last] => return of_last(&last[..=left], factors),
        [own, last] => {
            for (degree, power) in own[..=left].iter().enumerate() {
                add(&mut sums, *power, of_last(&last[..=left - degree], factors));
            }
        }
        [own, others @ ..] => {
            for (degree, power) in own[..=left].iter().enumerate() {
                add(&mut sums, *power, sum(others, left - degree, factors));
            }
        }
    }
    sums
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
