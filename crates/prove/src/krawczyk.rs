//! Zeros of systems of equations: Newton's method in floating point, and Krawczyk's test, which proves that a box
//! holds exactly one (Krawczyk 1969; Moore 1977):
//!
//! K(X) = m - Y f(m) + (1 - Y f'(X)) (X - m), m in X, Y any regular matrix.
//!
//! If K(X) lies in the interior of X, then f has exactly one zero in X, f'(x) is regular for all x in X, and the zero is
//! in K(X).

use nalgebra::{DMatrix, DVector};

use crate::interval::Interval;
use crate::number::{Gradient, Number};

/// Equations with as many unknowns.
pub trait Equations {
    /// What is left of them at some unknowns, of intervals or with derivatives.
    fn residuals<T: Number>(&self, unknowns: &[T]) -> Vec<T>;
}

/// A box proven to hold one zero, and a tight one around that.
#[derive(Debug, Clone)]
pub struct Zero {
    /// In it there is no other zero.
    pub unique: Vec<Interval>,
    /// In it is the zero.
    pub enclosure: Vec<Interval>,
}

/// Newton steps at most: the start may be good to a few digits only.
const MAX_STEPS: usize = 30;
/// Step, in units of 1 + |unknown|, from which on steps that no longer halve are rounding.
const SETTLED: f64 = 1e-8;
/// Tightenings at most of an enclosure.
const MAX_TIGHTENINGS: usize = 20;
/// Size of an unknown, in units of the largest one, below which boxes are no narrower.
const SMALLEST: f64 = 1e-3;
/// Largest and smallest relative radius tried for a box without another zero.
const RADII: (i32, i32) = (-2, -12);

fn points(at: &[f64]) -> Vec<Interval> {
    at.iter().map(|it| Interval::point(*it)).collect()
}

fn jacobian(equations: &impl Equations, unknowns: &[Interval]) -> Vec<Gradient> {
    let count = unknowns.len();
    let numbered = unknowns.iter().enumerate();
    let unknowns: Vec<_> = numbered
        .map(|(index, it)| Gradient::unknown(*it, index, count))
        .collect();
    equations.residuals(&unknowns)
}

fn middles(rows: &[Gradient]) -> DMatrix<f64> {
    DMatrix::from_fn(rows.len(), rows.len(), |row, column| {
        rows[row].slope(column).middle()
    })
}

/// The test about a point.
struct Test<'a, E> {
    equations: &'a E,
    center: Vec<Interval>,
    inverse: DMatrix<Interval>,
    /// Y f(m).
    step: Vec<Interval>,
}

impl<'a, E: Equations> Test<'a, E> {
    fn new(equations: &'a E, center: &[f64]) -> Option<Self> {
        let center = points(center);
        let inverse = middles(&jacobian(equations, &center)).try_inverse()?;
        let inverse = inverse.map(Interval::point);
        let values = equations.residuals(&center);
        let step = inverse
            .row_iter()
            .map(|row| sum(row.iter().copied().zip(values.iter().copied())));
        Some(Self {
            step: step.collect(),
            equations,
            center,
            inverse,
        })
    }

    /// K(X). The derivatives are those on the hull of X and m, so that m need not be in X.
    fn image(&self, within: &[Interval]) -> Vec<Interval> {
        let pairs = within.iter().zip(&self.center);
        let hull: Vec<Interval> = pairs.map(|(x, m)| x.hull(*m)).collect();
        let rows = jacobian(self.equations, &hull);
        let away: Vec<Interval> = within
            .iter()
            .zip(&self.center)
            .map(|(x, m)| *x - *m)
            .collect();
        let entry = |row: usize, column: usize| {
            let pairs = rows.iter().enumerate();
            let product = sum(pairs.map(|(at, it)| (self.inverse[(row, at)], it.slope(column))));
            let own = if row == column {
                Interval::ONE
            } else {
                Interval::ZERO
            };
            own - product
        };
        let count = within.len();
        let image = (0..count).map(|row| {
            let rest = sum((0..count).map(|column| (entry(row, column), away[column])));
            self.center[row] - self.step[row] + rest
        });
        image.collect()
    }
}

fn sum(pairs: impl Iterator<Item = (Interval, Interval)>) -> Interval {
    pairs.fold(Interval::ZERO, |sum, (a, b)| sum + a * b)
}

fn is_inside(inner: &[Interval], outer: &[Interval]) -> bool {
    inner
        .iter()
        .zip(outer)
        .all(|(inner, outer)| inner.is_inside(*outer))
}

/// Newton's method from a guess, in floating point, until its steps are rounding: a point near a zero, not a proof.
pub fn approximate(equations: &impl Equations, guess: &[f64]) -> Option<Vec<f64>> {
    let mut at = DVector::from_column_slice(guess);
    let mut last = f64::INFINITY;
    for _ in 0..MAX_STEPS {
        let rows = jacobian(equations, &points(at.as_slice()));
        let values = DVector::from_iterator(rows.len(), rows.iter().map(|it| it.value.middle()));
        let step = middles(&rows).lu().solve(&values)?;
        at -= &step;
        let sizes = step
            .iter()
            .zip(&at)
            .map(|(step, at)| step.abs() / (1.0 + at.abs()));
        let size = sizes.fold(
            0.0,
            |most: f64, it| if it > most || it.is_nan() { it } else { most },
        );
        if !size.is_finite() {
            return None;
        }
        if size == 0.0 || size < SETTLED && size > 0.5 * last {
            return Some(at.as_slice().to_vec());
        }
        last = size;
    }
    None
}

/// Proves that there is exactly one zero near a point.
pub fn prove(equations: &impl Equations, near: &[f64]) -> Option<Zero> {
    let test = Test::new(equations, near)?;
    let enclosure = enclose(&test, near)?;
    let largest = near.iter().fold(0.0_f64, |most, it| most.max(it.abs()));
    let size = |it: f64| it.abs().max(SMALLEST * largest);
    // A checker needs room for its own rounding.
    let roomy = |it: &Interval| Interval::around(0.0, f64::EPSILON * size(it.middle())) + *it;
    let enclosure: Vec<Interval> = enclosure.iter().map(roomy).collect();
    let around = |power: i32| -> Vec<Interval> {
        let around = |it: &f64| Interval::around(*it, 10_f64.powi(power) * size(*it));
        near.iter().map(around).collect()
    };
    let holds = |it: &Vec<Interval>| is_inside(&test.image(it), it) && is_inside(&enclosure, it);
    let unique = (RADII.1..=RADII.0).rev().map(around).find(holds)?;
    Some(Zero { unique, enclosure })
}

/// A box around a point that holds a zero, inflated from the rounding of the equations until the test holds, then
/// tightened.
fn enclose<E: Equations>(test: &Test<'_, E>, near: &[f64]) -> Option<Vec<Interval>> {
    let around = |image: &[Interval]| -> Vec<Interval> {
        let pairs = near.iter().zip(image);
        let wider = |(m, it): (&f64, &Interval)| {
            let radius = (*it - Interval::point(*m)).magnitude();
            Interval::around(
                *m,
                2.0 * radius + f64::EPSILON * m.abs() + f64::MIN_POSITIVE,
            )
        };
        pairs.map(wider).collect()
    };
    let mut within = around(&test.image(&points(near)));
    for _ in 0..MAX_TIGHTENINGS {
        let image = test.image(&within);
        if is_inside(&image, &within) {
            return Some(tighten(test, image));
        }
        within = around(&image);
    }
    None
}

/// A box that holds a zero, made smaller as long as its image is.
fn tighten<E: Equations>(test: &Test<'_, E>, mut within: Vec<Interval>) -> Vec<Interval> {
    for _ in 0..MAX_TIGHTENINGS {
        let image = test.image(&within);
        let pairs = within.iter().zip(&image);
        let smaller: Option<Vec<_>> = pairs.map(|(a, b)| a.intersection(*b)).collect();
        match smaller {
            Some(smaller) if smaller != within => within = smaller,
            _ => break,
        }
    }
    within
}
