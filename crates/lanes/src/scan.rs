//! Window by window, as long as nothing can happen.

use pulp::Simd;

use super::engine::Engine;
use super::lanes::{Lanes, Mask};
use super::law::Law;

/// Windows that are scanned at most before the lanes that wait are looked at: about a drive period.
pub(super) const MOST_WINDOWS: usize = 12;
/// In the first window after a crossing the motion falls from zero; 16/3 times the error of the cubic there is
/// what its second Bernstein coefficient has to lie below zero.
const LEAVING: f64 = 16.0 / 3.0;

/// A motion as the sum of a free one (y, u) and the steady one (p, q): positions and velocities.
#[derive(Debug, Clone, Copy)]
pub(super) struct Parts<S: Simd, const N: usize> {
    pub y: Lanes<S, N>,
    pub u: Lanes<S, N>,
    pub p: Lanes<S, N>,
    pub q: Lanes<S, N>,
}

/// How far the lanes have come.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reached<S: Simd, const N: usize> {
    /// Where they stand.
    pub parts: Parts<S, N>,
    /// Windows scanned.
    pub count: Lanes<S, N>,
    /// Lanes that may go on.
    pub go: Mask<S, N>,
}

/// The enclosure of a motion over a stretch of time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hull<S: Simd, const N: usize> {
    /// Positions that it stays between.
    pub low: Lanes<S, N>,
    pub high: Lanes<S, N>,
}

impl<S: Simd, const N: usize> Hull<S, N> {
    /// Of a motion with these positions and velocities at both ends, |x''''| span^4 / 384 <= slack.
    #[inline(always)]
    pub fn of(
        left: (Lanes<S, N>, Lanes<S, N>),
        right: (Lanes<S, N>, Lanes<S, N>),
        third: Lanes<S, N>,
        slack: Lanes<S, N>,
    ) -> Self {
        let (b1, b2) = (third.mul_add(left.1, left.0), right.0 - third * right.1);
        Self {
            low: left.0.min(right.0).min(b1.min(b2)) - slack,
            high: left.0.max(right.0).max(b1.max(b2)) + slack,
        }
    }
}

impl<S: Simd, const N: usize> Parts<S, N> {
    /// The parts one window later.
    #[inline(always)]
    fn next(&self, law: &Law<S, N>) -> Self {
        let Self { y, u, p, q } = *self;
        Self {
            y: law.xx.mul_add(y, law.xv * u),
            u: law.vx.mul_add(y, law.vv * u),
            p: law.turn.mul_add(p, law.turn_by_velocity * q),
            q: law.turn.mul_add(q, law.turn_by_position * p),
        }
    }

    #[inline(always)]
    fn choose(mask: Mask<S, N>, yes: &Self, no: &Self) -> Self {
        Self {
            y: mask.choose(yes.y, no.y),
            u: mask.choose(yes.u, no.u),
            p: mask.choose(yes.p, no.p),
            q: mask.choose(yes.q, no.q),
        }
    }
}

impl<S: Simd, const N: usize> Law<S, N> {
    /// |x''''| window^4 / 384 over the next window, of a motion whose free part is (y, u). In phases that only
    /// a position ends, over all windows of a scan.
    #[inline(always)]
    pub fn slack(&self, parts: &Parts<S, N>) -> Lanes<S, N> {
        let Parts { y, u, .. } = *parts;
        let fourth = self.fourth_x.mul_add(y, self.fourth_v * u).abs();
        let fifth = self.fifth_x.mul_add(y, self.fifth_v * u).abs();
        self.steady + fourth + fifth
    }

    /// The same of |v''''|.
    #[inline(always)]
    pub fn rate_slack(&self, parts: &Parts<S, N>) -> Lanes<S, N> {
        let Parts { y, u, .. } = *parts;
        let fifth = self.rate_fifth_x.mul_add(y, self.rate_fifth_v * u).abs();
        let sixth = self.rate_sixth_x.mul_add(y, self.rate_sixth_v * u).abs();
        self.rate_steady + fifth + sixth
    }

    /// x'' of the two parts together.
    #[inline(always)]
    pub fn acceleration(&self, frequency: Lanes<S, N>, parts: &Parts<S, N>) -> Lanes<S, N> {
        let steady = -(frequency * frequency * parts.p);
        self.stiffness
            .mul_add(parts.y, self.damping.mul_add(parts.u, steady))
    }
}

impl<S: Simd, const GUARDED: bool, const N: usize> Engine<'_, S, GUARDED, N> {
    /// The motion of all lanes in units of their guard: g = side (x - offset) - edge.
    #[inline(always)]
    pub fn parts(&self, law: &Law<S, N>) -> Parts<S, N> {
        let (cos, sin) = self.state.angle();
        let p = law.cosine.mul_add(cos, law.sine * sin);
        let q = law.cosine_rate.mul_add(cos, law.sine_rate * sin);
        let side = law.side;
        Parts {
            y: side * (self.state.x - law.offset - p),
            u: side * (self.state.v - q),
            p: side * p,
            q: side * q,
        }
    }

    /// Moves the lanes on for a while, or until each stands before a window in which something may happen, or
    /// that is its last. `cap`: windows before that one.
    #[inline(always)]
    pub fn scan(&self, law: &Law<S, N>, cap: Lanes<S, N>) -> Reached<S, N> {
        let reached = Reached {
            parts: self.parts(law),
            count: cap.like(0.0),
            go: self.state.busy() & self.state.share.equals(cap.like(1.0)),
        };
        if GUARDED {
            self.scan_between(law, cap, reached)
        } else {
            scan_below(law, cap, reached)
        }
    }

    /// Between two positions and below a further guard.
    #[inline(always)]
    fn scan_between(
        &self,
        law: &Law<S, N>,
        cap: Lanes<S, N>,
        mut reached: Reached<S, N>,
    ) -> Reached<S, N> {
        let one = cap.like(1.0);
        let frequency = self.state.drive.frequency;
        for _ in 0..MOST_WINDOWS {
            let here = reached.parts;
            let next = here.next(law);
            let left = (here.y + here.p + law.offset, here.u + here.q);
            let right = (next.y + next.p + law.offset, next.u + next.q);
            let hull = Hull::of(left, right, law.third, law.slack(&here));
            let mut clear = hull.high.below(law.high) & law.low.below(hull.low);
            let before = (left.1, law.acceleration(frequency, &here));
            let after = (right.1, law.acceleration(frequency, &next));
            let rates = Hull::of(before, after, law.third, law.rate_slack(&here));
            clear = clear & law.guard_top(&hull, &rates).below(law.level);
            reached.go = reached.go & clear & reached.count.below(cap);
            if !reached.go.any() {
                break;
            }
            reached.parts = Parts::choose(reached.go, &next, &here);
            reached.count = reached.go.choose(reached.count + one, reached.count);
        }
        reached
    }
}

/// On one side of one position.
#[inline(always)]
fn scan_below<S: Simd, const N: usize>(
    law: &Law<S, N>,
    cap: Lanes<S, N>,
    mut reached: Reached<S, N>,
) -> Reached<S, N> {
    let one = cap.like(1.0);
    let mut parts = reached.parts;
    let slack = law.slack(&parts);
    let (x, v) = (parts.y + parts.p, parts.u + parts.q);
    let apart = (law.edge - law.grain).below(x).not();
    let leaves = v.below(-law.slow);
    reached.go = reached.go & (apart | leaves);
    let limit = law.edge - slack;
    let mut top = law.third.mul_add(v, x);
    // On the edge the first two Bernstein coefficients need no proof.
    top = apart.choose(top.max(x), one.like(f64::NEG_INFINITY));
    let mut below = apart.choose(limit, one.like(-LEAVING).mul_add(slack, law.edge));
    for _ in 0..MOST_WINDOWS {
        let next = parts.next(law);
        let (x, v) = (next.y + next.p, next.u + next.q);
        let reach = law.third * v;
        let clear = top.max(x.max(x - reach)).below(below);
        reached.go = reached.go & clear & reached.count.below(cap);
        if !reached.go.any() {
            break;
        }
        reached.parts = Parts::choose(reached.go, &next, &reached.parts);
        reached.count = reached.go.choose(reached.count + one, reached.count);
        (parts, top, below) = (next, x + reach, limit);
    }
    reached
}

impl<S: Simd, const N: usize> Law<S, N> {
    /// Largest value of the further guard's weighted sum within the hulls of position and velocity.
    #[inline(always)]
    pub fn guard_top(&self, positions: &Hull<S, N>, velocities: &Hull<S, N>) -> Lanes<S, N> {
        let (a, b) = (self.by_position, self.by_velocity);
        let x = (a * positions.low).max(a * positions.high);
        x + (b * velocities.low).max(b * velocities.high)
    }
}
