//! A root between two ends: to a width that is asked for, or to rounding.

use crate::budget;

/// Narrows the interval between `low` and `high`, places with values of opposite signs, to `width` about a root, and
/// returns its ends: interpolation, truncation, projection (Oliveira and Takahashi 2020, ACM Trans. Math. Softw. 47, 5).
/// It never takes more evaluations than bisection and one, and on a smooth function converges with the order of the
/// secant method.
///
/// # Errors
/// The function's own.
pub fn narrow_root<E>(
    low: (f64, f64),
    high: (f64, f64),
    width: f64,
    mut function: impl FnMut(f64) -> Result<f64, E>,
) -> Result<(f64, f64), E> {
    let ((mut a, mut f_a), (mut b, mut f_b)) = (low, high);
    let half = 0.5 * width;
    // Those of bisection and one: n0 = 1.
    let most = ((b - a) / width).log2().ceil().max(0.0) + 1.0;
    let truncation = 0.2 / (b - a);
    let mut evaluations = 0;
    while b - a > width {
        let middle = 0.5 * (a + b);
        let secant = (f_b * a - f_a * b) / (f_b - f_a);
        let side = (middle - secant).signum();
        let shift = truncation * (b - a) * (b - a);
        let truncated = if shift <= (middle - secant).abs() {
            secant + side * shift
        } else {
            middle
        };
        let radius = half * (most - evaluations as f64).exp2() - 0.5 * (b - a);
        let at = if (truncated - middle).abs() <= radius {
            truncated
        } else {
            middle - side * radius.max(0.0)
        };
        // A root at one end is closed in from the other side, too.
        let at = if at <= a || at >= b {
            at.max(a + half).min(b - half)
        } else {
            at
        };
        if at <= a || at >= b {
            break;
        }
        let value = function(at)?;
        evaluations += 1;
        if value == 0.0 {
            (a, b) = (at, at);
        } else if (value > 0.0) == (f_b > 0.0) {
            (b, f_b) = (at, value);
        } else {
            (a, f_a) = (at, value);
        }
    }
    Ok((a, b))
}

/// The root of a function (value, derivative) that rises from <= 0 at `low` to > 0 at `high` (place, value): Newton's
/// method, kept inside the bracket by bisection. It ends when the next step, foreseen from the last two as for
/// quadratic convergence, would be lost in rounding.
pub(crate) fn bracketed_newton(
    (mut low, f_low): (f64, f64),
    (mut high, f_high): (f64, f64),
    guess: Option<f64>,
    f: impl Fn(f64) -> (f64, f64),
) -> f64 {
    let secant = low - f_low * (high - low) / (f_high - f_low);
    let guess = guess.unwrap_or(secant);
    let mut at = if guess > low && guess < high {
        guess
    } else {
        0.5 * (low + high)
    };
    let mut last_step: Option<f64> = None;
    loop {
        let (value, rate) = f(at);
        if value > 0.0 {
            high = at;
        } else {
            low = at;
        }
        let step = value / rate;
        let next = at - step;
        let shrinks = step.abs() < 0.5 * last_step.unwrap_or(2.0 * (high - low)).abs();
        let converges = shrinks && next >= low && next <= high;
        if converges && let Some(last) = last_step {
            let foreseen = step.abs() * (step / last) * (step / last);
            if foreseen <= 0.25 * f64::EPSILON * next.abs() {
                return next;
            }
        }
        let target = if converges {
            next
        } else {
            // A thousand in a row where the bounces are as small as the least numbers.
            budget::charge(budget::HALVING);
            0.5 * (low + high)
        };
        if target <= low || target >= high {
            return target.clamp(low, high);
        }
        last_step = converges.then_some(step);
        at = target;
    }
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::narrow_root;

    fn evaluations(width: f64) -> usize {
        let function = |x: f64| x.exp() - 2.0;
        let mut evaluations = 0;
        let Ok((low, high)) = narrow_root((0.0, -1.0), (1.0, function(1.0)), width, |x| {
            evaluations += 1;
            Ok::<_, Infallible>(function(x))
        });
        let root = 2f64.ln();
        assert!(low <= root + 1e-16 && root - 1e-16 <= high);
        assert!(high - low <= width);
        evaluations
    }

    /// Four times the digits cost a few evaluations more: bisection would take 10, 20 and 40.
    #[test]
    fn order_is_that_of_the_secant_method() {
        let counts = [1e-3, 1e-6, 1e-12].map(evaluations);
        assert!(counts[1] - counts[0] <= 3, "{counts:?}");
        assert!(counts[2] - counts[1] <= 3, "{counts:?}");
    }

    /// A jump is found as by bisection.
    #[test]
    fn a_jump_costs_no_more_than_bisection_and_one() {
        let mut evaluations = 0;
        let Ok((low, high)) = narrow_root((0.0, -1.0), (1.0, 1e9), 2f64.powi(-30), |x| {
            evaluations += 1;
            Ok::<_, Infallible>(if x < 0.3 { -1.0 } else { 1e9 })
        });
        assert!(evaluations <= 31, "{evaluations}");
        assert!((low.midpoint(high) - 0.3).abs() < 1e-9);
    }
}
