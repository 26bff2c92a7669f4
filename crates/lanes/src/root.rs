//! The first zero of a function that is known to have one, in all lanes.

use pulp::Simd;

use super::lanes::{Lanes, Mask};
use super::taylor::{Series, evaluate_twice};

/// Evaluations after which a lane is given up.
const MOST_STEPS: usize = 12;
/// Step, relative to the bracket, after which the next one would be lost in rounding.
const CONVERGED: f64 = 1e-8;

/// A function below zero at 0 and above it at `span`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bracket<'a, S: Simd, const N: usize> {
    pub series: &'a Series<S, N>,
    pub span: Lanes<S, N>,
    pub guess: Lanes<S, N>,
}

/// A zero: where, how steep the function is there, and whether it was found.
#[derive(Debug, Clone, Copy)]
pub(super) struct Zero<S: Simd, const N: usize> {
    pub at: Lanes<S, N>,
    pub slope: Lanes<S, N>,
    pub sure: Mask<S, N>,
}

impl<S: Simd, const N: usize> Bracket<'_, S, N> {
    /// Halley's method, kept inside the bracket by bisection, in the lanes `of`.
    #[inline(always)]
    pub fn solve(&self, of: Mask<S, N>) -> Zero<S, N> {
        let zero = self.span.like(0.0);
        let (mut low, mut high) = (zero, self.span);
        let tolerance = self.span * self.span.like(CONVERGED);
        let (mut at, mut last) = (self.guess, zero);
        let mut open = of;
        for _ in 0..MOST_STEPS {
            let (value, slope, bend) = evaluate_twice(self.series, at);
            let above = zero.below(value);
            high = (above & open).choose(at, high);
            low = open.and_not(above).choose(at, low);
            let step = value * slope / (slope * slope - value * bend);
            let next = at - step;
            let inside = low.at_most(next) & next.at_most(high);
            let halved = (low + high) * low.like(0.5);
            last = open.choose(slope - (bend + bend) * step, last);
            at = open.choose(inside.choose(next, halved), at);
            open = open.and_not(inside & step.abs().at_most(tolerance));
            if !open.any() {
                break;
            }
        }
        Zero {
            at,
            slope: last,
            sure: of.and_not(open),
        }
    }
}

/// Where a function that rises from below to above zero passes it, from (value, slope) at both ends: the zero
/// of the parabola through the left end and the right value, then one step of Newton's method on the cubic.
#[inline(always)]
pub(super) fn guess<S: Simd, const N: usize>(
    left: (Lanes<S, N>, Lanes<S, N>),
    right: (Lanes<S, N>, Lanes<S, N>),
    span: Lanes<S, N>,
) -> Lanes<S, N> {
    let zero = span.like(0.0);
    let inverse = span.like(1.0) / span;
    let square = ((right.0 - left.0) * inverse - left.1) * inverse;
    let twice = square + square;
    let discriminant = left
        .1
        .mul_add(left.1, -((twice + twice) * left.0.min(zero)));
    let root = discriminant.max(zero).square_root();
    let at = -(left.0 + left.0) / (left.1 + root);
    let cubic = ((right.1 - left.1) * inverse - twice) * inverse;
    let behind = at - span;
    let value = cubic * at * at * behind;
    let slope = root + cubic * at * (at + behind + behind);
    let better = at - value / slope;
    let sound = zero.at_most(better) & better.at_most(span);
    let plain = zero.at_most(at) & at.at_most(span);
    sound.choose(better, plain.choose(at, span * span.like(0.5)))
}
