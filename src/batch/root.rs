//! The first zero of a function that is known to have one, in all lanes.

use pulp::Simd;

use super::lanes::{Lanes, Mask};
use super::taylor::{Series, evaluate};

/// Evaluations after which a lane is given up.
const MOST_STEPS: usize = 12;
/// Step, relative to the bracket, after which the next one would be lost in rounding.
const CONVERGED: f64 = 2e-8;

/// A function below zero at 0 and above it at `span`, where it is `right`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bracket<'a, S: Simd> {
    pub series: &'a Series<S>,
    pub span: Lanes<S>,
    pub guess: Lanes<S>,
}

impl<S: Simd> Bracket<'_, S> {
    /// Newton's method, kept inside the bracket by bisection, in the lanes `of`; and where it converged.
    #[inline(always)]
    pub fn solve(&self, of: Mask<S>) -> (Lanes<S>, Mask<S>) {
        let (mut low, mut high) = (self.span.like(0.0), self.span);
        let tolerance = self.span * self.span.like(CONVERGED);
        let mut at = self.guess;
        let mut open = of;
        for _ in 0..MOST_STEPS {
            let (value, slope) = evaluate(self.series, at);
            let above = low.like(0.0).below(value);
            high = above.choose(at, high);
            low = above.choose(low, at);
            let next = at - value / slope;
            let inside = low.at_most(next) & next.at_most(high);
            let middle = (low + high) * low.like(0.5);
            let next = inside.choose(next, middle);
            open = open.and_not(inside & (next - at).abs().at_most(tolerance));
            at = next;
            if !open.any() {
                break;
            }
        }
        (at, of.and_not(open))
    }
}

/// Where the cubic through both ends (value, slope) of a rising function, taken as time over value, passes
/// zero; the secant's zero where that is not inside.
#[inline(always)]
pub(super) fn guess<S: Simd>(
    left: (Lanes<S>, Lanes<S>),
    right: (Lanes<S>, Lanes<S>),
    span: Lanes<S>,
) -> Lanes<S> {
    let one = span.like(1.0);
    let rise = right.0 - left.0;
    let u = -left.0 / rise;
    let v = one - u;
    let pace = rise / span;
    let (m0, m1) = (pace / left.1, pace / right.1);
    let cubic = u * u * (span.like(3.0) - u - u) + u * v * (v * m0 - u * m1);
    let zero = span.like(0.0);
    let sound = zero.below(left.1) & zero.below(right.1) & zero.at_most(cubic) & cubic.at_most(one);
    sound.choose(cubic, u) * span
}
