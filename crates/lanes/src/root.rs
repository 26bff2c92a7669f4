//! Where a cubic that rises from below to above zero passes it.

use pulp::Simd;

use super::cubic::Cubic;
use super::lanes::{Lanes, Mask};

/// The zero of the parabola through the left end and the right value, then one step of Newton's method on the
/// cubic; in the lanes that leave zero at the left end, the other zero. In units of the stretch, for the lanes `of`.
#[inline(always)]
pub(super) fn guess<S: Simd, const N: usize>(
    cubic: &Cubic<S, N>,
    leaves: Mask<S, N>,
    of: Mask<S, N>,
) -> Lanes<S, N> {
    let Cubic {
        value,
        slope,
        bend,
        twist,
        ..
    } = *cubic;
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
