//! The cubic Hermite interpolant, by values and slopes at the ends of a stretch of time: its maximum, and its rise through zero.

use pulp::Simd;

use super::lanes::{Lanes, Mask, Pair};

/// A cubic in time over a window, with t in units of the window: value + t (slope + t (bend + (t - 1) twist)).
#[derive(Debug, Clone, Copy)]
pub(super) struct Cubic<S: Simd, const N: usize> {
    pub value: Lanes<S, N>,
    pub slope: Lanes<S, N>,
    pub bend: Lanes<S, N>,
    pub twist: Lanes<S, N>,
    end: Lanes<S, N>,
    last_slope: Lanes<S, N>,
}

impl<S: Simd, const N: usize> Cubic<S, N> {
    #[inline(always)]
    pub fn interpolate(left: Pair<S, N>, right: Pair<S, N>, span: Lanes<S, N>) -> Self {
        let (slope, last_slope) = (span * left.1, span * right.1);
        let rise = right.0 - left.0;
        Self {
            value: left.0,
            slope,
            bend: rise - slope,
            twist: slope + last_slope - (rise + rise),
            end: right.0,
            last_slope,
        }
    }

    #[inline(always)]
    fn value_at(&self, t: Lanes<S, N>) -> Lanes<S, N> {
        let one = t.like(1.0);
        let bend = (t - one).mul_add(self.twist, self.bend);
        t.mul_add(t.mul_add(bend, self.slope), self.value)
    }

    /// The largest value of the cubic over its window.
    #[inline(always)]
    pub fn maximum(&self) -> Lanes<S, N> {
        let Self {
            slope,
            bend,
            twist,
            last_slope,
            ..
        } = *self;
        // The slope is slope (1 - t)^2 + 2 middle t (1 - t) + last_slope t^2; it turns from up to down at a fraction
        // whose digits do not cancel.
        let middle = (bend - twist) + slope;
        let half = slope - middle;
        let root = middle.mul_add(middle, -(slope * last_slope)).square_root();
        let (zero, one) = (slope.like(0.0), slope.like(1.0));
        let up = zero.at_most(half);
        let over = up.choose(slope, half - root);
        let under = up.choose(half + root, half + (last_slope - middle));
        let t = over / under;
        let inside = zero.below(t) & t.below(one);
        inside
            .choose(self.value_at(t), self.value)
            .max(self.value.max(self.end))
    }

    /// True in the lanes `of` where every function near the cubic rises through zero exactly once, near its zero `root`: a
    /// function that deviates by at most `error_bound`, and in its slope by 3.08 times that (Birkhoff and Priver 1967: 384 *
    /// 0.00802). In the lanes `leaves` the function is zero and falling at the left end.
    #[inline(always)]
    pub fn rises_once(
        &self,
        error_bound: Lanes<S, N>,
        root: Lanes<S, N>,
        leaves: Mask<S, N>,
        of: Mask<S, N>,
    ) -> Mask<S, N> {
        let (zero, one) = (root.like(0.0), root.like(1.0));
        let middle = (self.bend - self.twist) + self.slope;
        let curve = self.last_slope - middle;
        let first = middle - self.slope;
        let (leaving, rising) = (of & leaves, of.and_not(leaves));
        let mut rises = of.and_not(of);
        if leaving.any() {
            let convex = (error_bound * one.like(16.0)).below(first.min(curve));
            rises = leaving & convex & zero.below(self.end);
        }
        if rising.any() {
            // Up, down and up again?
            let winds = zero.below(self.slope.min(self.last_slope)) & middle.below(zero);
            let near = self
                .value_at(root)
                .abs()
                .below(error_bound * one.like(0.02));
            let slope = self.slope_at(root);
            let curvature = first.abs().max(curve.abs());
            // The function may vanish where the cubic is within its error bound: at most 2 error bound / slope from the
            // root, where its own slope is at least slope - 4 curvature error bound / slope - 3.08 error bound.
            let least = slope.mul_add(one.like(3.3), curvature * one.like(4.6));
            let steep = (error_bound * least).below(slope * slope) & zero.below(slope);
            let behind = (error_bound * one.like(2.2)).below(slope * (one - root));
            let apart = self.value.below(-error_bound) & near & steep & behind;
            rises = rises | (rising & apart).and_not(winds);
        }
        rises
    }

    /// Derivative of the cubic at t.
    #[inline(always)]
    pub fn slope_at(&self, t: Lanes<S, N>) -> Lanes<S, N> {
        let two = t.like(2.0);
        let behind = t - t.like(1.0);
        let curve = (t * self.twist).mul_add(behind.mul_add(two, t), (two * t) * self.bend);
        curve + self.slope
    }

    /// Where the cubic rises through zero in the lanes `of`, approximately and in units of the window: the zero of the parabola
    /// through the left end and the right value, then a step of Newton's method. In the lanes `leaves`, where the cubic is zero
    /// at the left end, its other zero.
    #[inline(always)]
    pub fn guess_rise(&self, leaves: Mask<S, N>, of: Mask<S, N>) -> Lanes<S, N> {
        let Self {
            value,
            slope,
            bend,
            twist,
            ..
        } = *self;
        let (zero, one) = (value.like(0.0), value.like(1.0));
        // c + b t + a t^2
        let c = leaves.choose(slope, value.min(zero));
        let b = leaves.choose(bend - twist, slope);
        let a = leaves.choose(twist, bend);
        let (twice, half) = (a + a, c + c);
        let discriminant = b.mul_add(b, -(twice * half));
        let root = discriminant.max(zero).square_root();
        let at = -half / (b + root);
        let plain = zero.at_most(at) & at.at_most(one);
        let plain = plain.choose(at, one.like(0.5));
        let rising = of.and_not(leaves);
        if !rising.any() {
            return plain;
        }
        let behind = at - one;
        let off = twist * at * at * behind;
        let slope = (twist * at).mul_add(at + behind + behind, root);
        let better = at - off / slope;
        let inside = zero.at_most(better) & better.at_most(one);
        (inside & rising).choose(better, plain)
    }
}
