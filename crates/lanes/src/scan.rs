//! Window by window, as long as nothing can happen.

use pulp::Simd;

use super::cubic::Cubic;
use super::engine::Engine;
use super::lanes::{Lanes, Mask};
use super::law::Law;
use super::parts::Parts;

/// Windows that are scanned at most before the lanes that wait are looked at: about a drive period.
pub(super) const MOST_WINDOWS: usize = 12;
/// In the first window after a crossing the motion falls from zero; 16/3 times the error of the cubic there is
/// what its second Bernstein coefficient has to lie below zero.
pub(super) const LEAVING: f64 = 16.0 / 3.0;

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

impl<S: Simd, const N: usize> Engine<'_, S, N> {
    /// The motion of all lanes in units of their guard: g = side (x - offset) - edge.
    #[inline(always)]
    pub fn parts(&self, law: &Law<S, N>) -> Parts<S, N> {
        let (cos, sin) = self.state.angle;
        let p = law.cosine.mul_add(cos, law.sine * sin);
        let q = law.cosine_rate.mul_add(cos, law.sine_rate * sin);
        let side = law.side;
        Parts {
            y: side.mul_add(self.state.x - law.offset, -p),
            u: side.mul_add(self.state.v, -q),
            p,
            q,
        }
    }

    /// Lets the lanes look at their next window at once.
    #[inline(always)]
    pub fn stand(&self, law: &Law<S, N>, active: Mask<S, N>) -> Reached<S, N> {
        Reached {
            parts: self.parts(law),
            count: self.state.share.like(0.0),
            go: active.and_not(active),
        }
    }

    /// Moves the lanes on for a while, on one side of one position, or until each stands before a window in which
    /// something may happen, or that is its last. `cap`: windows up to its last moment.
    #[inline(always)]
    pub fn scan(&self, law: &Law<S, N>, active: Mask<S, N>, cap: Lanes<S, N>) -> Reached<S, N> {
        let reached = Reached {
            parts: self.parts(law),
            count: cap.like(0.0),
            go: active & self.state.share.equals(cap.like(1.0)),
        };
        scan_below(law, cap, reached)
    }
}

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
    let mut apart = (law.edge - law.grain).below(x).not();
    let leaves = v.below(-law.slow);
    reached.go = reached.go & (apart | leaves);
    let limit = law.edge - slack;
    let mut top = law.third.mul_add(v, x);
    // On the edge the first two Bernstein coefficients need no proof.
    top = apart.choose(top.max(x), one.like(f64::NEG_INFINITY));
    let mut below = apart.choose(limit, one.like(-LEAVING).mul_add(slack, law.edge));
    let capped = (reached.go & cap.below(one.like(MOST_WINDOWS as f64))).any();
    for window in 0..MOST_WINDOWS {
        let next = parts.next(law);
        let (x, v) = (next.y + next.p, next.u + next.q);
        let reach = law.third * v;
        let mut clear = top.max(x.max(x - reach)).below(below);
        let blocked = reached.go.and_not(clear);
        if blocked.any() {
            let suspect = blocked & apart & x.below(limit);
            if suspect.any() {
                let left = (parts.y + parts.p, parts.u + parts.q);
                let top = Cubic::new(left, (x, v), law.window).top();
                clear = clear | (suspect & top.below(limit));
            }
        }
        apart = one.at_most(one);
        reached.go = reached.go & clear;
        if capped {
            reached.go = reached.go & one.like((window + 1) as f64).at_most(cap);
        }
        if !reached.go.any() {
            break;
        }
        reached.parts = Parts::choose(reached.go, &next, &reached.parts);
        reached.count = reached.go.choose(reached.count + one, reached.count);
        (parts, top, below) = (next, x + reach, limit);
    }
    reached
}
