//! What bounds prove of the rises of a guard through zero between two points.

/// A place on an interval with value and first derivative of a guard there.
#[derive(Debug, Clone, Copy)]
pub(super) struct GuardPoint {
    pub at: f64,
    pub value: f64,
    pub rate: f64,
}

/// What bounds prove of the rises of a guard through zero on an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RiseVerdict {
    NoRise,
    /// g is <= 0 at the left and > 0 at the right, and rises through zero once between them.
    Rise,
    /// g falls to a bottom and rises from there on: once through zero if it is <= 0 there.
    RiseFromBottom,
    /// g rises to a top and falls from there on: once through zero if it is > 0 there.
    RiseToTop,
    Unknown,
}

/// What is proven of the rises of a guard between two points, where |g''''| <= `bound` and `rounding` cannot be told from zero.
pub(super) fn judge_interval(
    left: GuardPoint,
    right: GuardPoint,
    bound: f64,
    rounding: f64,
) -> RiseVerdict {
    let span = right.at - left.at;
    let third = span / 3.0;
    let square = span * span;
    let bernstein = [
        left.value,
        left.value + third * left.rate,
        right.value - third * right.rate,
        right.value,
    ];
    let (low, high) = min_and_max(&bernstein);
    let slack = bound * square * square / 384.0;
    if high + slack < 0.0 || low - slack > 0.0 {
        return RiseVerdict::NoRise;
    }
    let flat = high.max(-low) + slack <= rounding;
    if flat && left.value <= 0.0 && right.value <= 0.0 {
        return RiseVerdict::NoRise;
    }
    if !slack.is_finite() {
        // The motion is about to leave the range of numbers; halving cannot help.
        return rise_by_ends(left, right);
    }
    // Bernstein coefficients of the interpolant's derivative, and its largest error
    // sqrt(3)/216 bound span^3 (Birkhoff and Priver 1967).
    let slopes = [left.rate, (bernstein[2] - bernstein[1]) / third, right.rate];
    let slack = 0.00802 * bound * square * span;
    let (low, high) = min_and_max(&slopes);
    if low - slack > 0.0 {
        return rise_by_ends(left, right);
    }
    if high + slack < 0.0 {
        return RiseVerdict::NoRise;
    }
    judge_by_curvature(left, right, slopes, bound * square / 12.0)
}

/// What the sign of the curvature proves of the rises of a guard between two points, by the slopes of its cubic
/// interpolant, whose curvature is off by at most `slack`.
fn judge_by_curvature(
    left: GuardPoint,
    right: GuardPoint,
    slopes: [f64; 3],
    slack: f64,
) -> RiseVerdict {
    let half = 0.5 * (right.at - left.at);
    let curvatures = [
        (slopes[1] - slopes[0]) / half,
        (slopes[2] - slopes[1]) / half,
    ];
    let (low, high) = min_and_max(&curvatures);
    let turns = left.rate * right.rate < 0.0;
    if low - slack > 0.0 {
        // Convex: beyond the bottom there is at most one zero, and g rises through it.
        let rises = right.rate > 0.0 && right.value > 0.0;
        if rises && left.value <= 0.0 {
            RiseVerdict::Rise
        } else if rises && turns {
            RiseVerdict::RiseFromBottom
        } else {
            RiseVerdict::NoRise
        }
    } else if high + slack < 0.0 {
        // Concave: g rises before the top only.
        if right.value > 0.0 || !turns {
            rise_by_ends(left, right)
        } else {
            RiseVerdict::RiseToTop
        }
    } else {
        RiseVerdict::Unknown
    }
}

/// The verdict on a rise where at most one is possible: a rise if the values at the ends have opposite signs, else none.
fn rise_by_ends(left: GuardPoint, right: GuardPoint) -> RiseVerdict {
    if bracket_of_rise(left, right).is_some() {
        RiseVerdict::Rise
    } else {
        RiseVerdict::NoRise
    }
}

/// Both points, if g rises from <= 0 to > 0 between them.
pub(super) fn bracket_of_rise(
    left: GuardPoint,
    right: GuardPoint,
) -> Option<(GuardPoint, GuardPoint)> {
    (left.value <= 0.0 && right.value > 0.0).then_some((left, right))
}

fn min_and_max(values: &[f64]) -> (f64, f64) {
    values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(*v), high.max(*v))
        })
}
