//! The first instant at which a polynomial falls below zero, with proof.
//!
//! An interval is passed only if the bounds of the derivatives over the whole stretch show that the
//! polynomial is positive on it. Doubles decide wherever their rounding cannot matter, all digits else.

use super::number::{Digits, Real, derivative, float, is_negative, is_zero, size, value};

/// The first s in (0, `reach`] at which a polynomial that is positive just after 0 turns negative. Zero if it
/// begins below zero by rounding; an error if it begins at zero and falls.
pub fn first_root(guard: &[Real], reach: &Real) -> Result<Option<Real>, Wrong> {
    let zeros = guard.iter().take_while(|term| is_zero(term)).count();
    let terms = &guard[zeros..];
    let Some(first) = terms.first() else {
        return Ok(None);
    };
    if is_negative(first) {
        return (zeros == 0).then_some(Some(Real::ZERO)).ok_or(Wrong);
    }
    let scaled = scaled(terms, reach);
    let floats: Vec<f64> = scaled.iter().map(float).collect();
    let found = match scan(&floats) {
        Scan::Clear => None,
        Scan::Bracket(low, high) => Some(polish(&scaled, low, high)),
        Scan::Doubt(from) => search(&scaled, from),
    };
    Ok(found.map(|share| share * reach))
}

/// The polynomial falls right from its zero at the start: the event should have been dealt with before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Wrong;

/// The polynomial with the reach as the unit of its argument.
fn scaled(terms: &[Real], reach: &Real) -> Vec<Real> {
    let mut power = Real::ONE;
    let scale = |term: &Real| {
        let scaled = term * &power;
        power *= reach;
        scaled
    };
    terms.iter().map(scale).collect()
}

/// What doubles can tell.
enum Scan {
    /// No root.
    Clear,
    /// The first root lies in this interval, where the polynomial falls.
    Bracket(f64, f64),
    /// No root before this argument; beyond it rounding matters.
    Doubt(f64),
}

/// Bounds over [0, 1] of the first two derivatives.
fn bounds(floats: &[f64]) -> (f64, f64) {
    let mut bounds = (0.0, 0.0);
    for (n, term) in floats.iter().enumerate() {
        let n = n as f64;
        bounds.0 += n * term.abs();
        bounds.1 += n * (n - 1.0) * term.abs();
    }
    // Upwards, against the rounding of the sums.
    (bounds.0 * (1.0 + 1e-9), bounds.1 * (1.0 + 1e-9))
}

/// Value and derivative.
fn both(floats: &[f64], at: f64) -> (f64, f64) {
    let mut pair = (0.0, 0.0);
    for term in floats.iter().rev() {
        pair = (pair.0 * at + term, pair.1 * at + pair.0);
    }
    pair
}

fn scan(floats: &[f64]) -> Scan {
    let (first, second) = bounds(floats);
    // Rounding of value and derivative by Horner's rule is below 2 n 2^-53 times the sums of the sizes.
    let rounding = 4.0 * floats.len() as f64 * f64::EPSILON;
    let margin = rounding * floats.iter().map(|term| term.abs()).sum::<f64>();
    let steep = rounding * first;
    let mut todo = vec![(0.0, 1.0)];
    while let Some((low, high)) = todo.pop() {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let (level, slope) = both(floats, middle);
        if level - first * half > margin {
            continue;
        }
        if slope.abs() - second * half > steep {
            let end = both(floats, high).0;
            if end > margin {
                continue;
            }
            return match end < -margin && slope < 0.0 {
                true => Scan::Bracket(low, high),
                false => Scan::Doubt(low),
            };
        }
        if half < 1e-12 {
            return Scan::Doubt(low);
        }
        todo.push((middle, high));
        todo.push((low, middle));
    }
    Scan::Clear
}

/// The same in all digits, from an argument on.
fn search(terms: &[Real], from: f64) -> Option<Real> {
    let slopes = derivative(terms);
    let digits = Digits(terms[0].precision());
    let one = digits.real(1.0);
    let (mut first, mut second) = (Real::ZERO, Real::ZERO);
    for (n, slope) in slopes.iter().enumerate() {
        first += size(slope);
        second += size(slope) * Real::from(n);
    }
    let finest = one.clone() >> (digits.0 / 2) as isize;
    let mut todo = vec![(digits.real(from), one)];
    while let Some((low, high)) = todo.pop() {
        let middle = (&low + &high) >> 1isize;
        let half = (&high - &low) >> 1isize;
        let level = value(terms, &middle);
        if level > &first * &half {
            continue;
        }
        if size(&value(&slopes, &middle)) > &second * &half || half < finest {
            if is_negative(&value(terms, &high)) {
                return Some(newton(terms, &slopes, [low, high, middle]));
            }
            continue;
        }
        if !is_negative(&level) {
            todo.push((middle.clone(), high));
        }
        todo.push((low, middle));
    }
    None
}

/// The root of a bracket that doubles have found.
fn polish(terms: &[Real], low: f64, high: f64) -> Real {
    let digits = Digits(terms[0].precision());
    let floats: Vec<f64> = terms.iter().map(float).collect();
    let (mut left, mut right) = (low, high);
    while right - left > 1e-6 * right {
        let middle = 0.5 * (left + right);
        match both(&floats, middle).0 > 0.0 {
            true => left = middle,
            false => right = middle,
        }
    }
    let ends = [low, high, 0.5 * (left + right)].map(|end| digits.real(end));
    newton(terms, &derivative(terms), ends)
}

/// Newton's method inside a bracket, from a place in it.
fn newton(terms: &[Real], slopes: &[Real], [mut low, mut high, mut at]: [Real; 3]) -> Real {
    let fine = (terms[0].precision() - 8) as isize;
    let mut last: Option<Real> = None;
    for _ in 0..4 * fine {
        let level = value(terms, &at);
        match is_negative(&level) {
            true => high = at.clone(),
            false => low = at.clone(),
        }
        let slope = value(slopes, &at);
        let mut next = match is_zero(&slope) {
            true => low.clone(),
            false => &at - level / slope,
        };
        if next < low || next > high {
            next = (&low + &high) >> 1isize;
        }
        let moved = size(&(&next - &at));
        at = next;
        // Steps that no longer shrink are rounding.
        let stalls = last.is_some_and(|last| moved >= last && last < (size(&at) >> (fine / 2)));
        if stalls || moved <= (size(&at) >> fine) {
            break;
        }
        last = Some(moved);
    }
    at
}
