//! Taylor steps in time under a power law, away from its face.
//!
//! With w = d^n, d w' = n d' w; and w d' is the derivative of d w / (n + 1). So the coefficients of both follow from
//! the same two sums of products.

use super::expansion::{converges_densely, outgrown};
use super::hertz::Hertz;
use super::segment::Segment;
use super::series::{Series, ZERO};
use super::taylor::{DEGREE, RECIPROCALS, push_series};
use super::{Departure, Flow};

/// Ways to the face that a step may be as long as, at the present speed.
const WAYS: f64 = 1.25;

impl Segment {
    /// The step from a departure beyond the face, by the deflection in m and its n-th power.
    pub(super) fn pressed(
        flow: &Flow,
        hertz: &Hertz,
        from: &Departure,
        (deflection, raised): (f64, f64),
    ) -> Self {
        let mut segment = Self::blank(flow, hertz);
        segment.push = push_series(flow, from);
        segment.is_pressed = true;
        let start = (deflection, from.velocity, raised);
        let velocity = segment.press(flow, start);
        // What is below rounding of the velocity is so of the deflection.
        let ways = WAYS * deflection / from.velocity.abs();
        let mut reach = converges_densely(&velocity).min(ways);
        if !from.push.is_linear() {
            reach = reach.min(outgrown(&segment.depth)).min(outgrown(&velocity));
        }
        segment.ends_at(reach.min(flow.reach));
        segment
    }

    /// The series of the deflection; that of the velocity is returned.
    fn press(&mut self, flow: &Flow, (deflection, velocity, raised): (f64, f64, f64)) -> Series {
        let (hertz, push, d) = (&self.hertz, &self.push, &mut self.depth);
        let (twice_decay, pull) = (2.0 * flow.modes.decay, flow.modes.stiffness);
        let kappa = hertz.rate();
        let above = hertz.exponent + 1.0;
        let grip = kappa * hertz.dissipation / above;
        let inverse = 1.0 / deflection;
        let mut v = ZERO;
        // Coefficient k of the velocity beside k + 1 of the deflection, from k = 1 on, and twice those of the n-th
        // power, from the last to the first: sums of products then run along two rows, full ones thanks to zeros
        // before them. What is newest comes from registers, not by way of memory.
        let mut moved = [[0.0; 2]; DEGREE + ROW];
        let mut turned = [[0.0; 2]; DEGREE + ROW];
        (d[0], d[1], v[0]) = (deflection, velocity, velocity);
        let (mut w, mut newest) = (raised, [velocity; 2]);
        turned[DEGREE + ROW - 1] = [w; 2];
        let mut load = push[0] - pull * hertz.origin;
        for k in 0..DEGREE {
            let next = k + 1;
            let rate = RECIPROCALS[next];
            // Of order k + 1, whose deflection is known, but for the product with the n-th power's newest.
            let mut by_velocity = newest[0] * raised;
            let mut by_depth = newest[1] * raised;
            let mut first = 0.0;
            if k > 0 {
                let length = (k - 1).next_multiple_of(ROW);
                let a = &moved[ROW + k - 1 - length..ROW + k - 1];
                let b = &turned[DEGREE + ROW - 1 - length..DEGREE + ROW - 1];
                let inner = inner_sums(a, b);
                by_velocity += inner[0];
                by_depth += inner[1];
                first = velocity;
            }
            let mut resisting = twice_decay * v[k] + pull * d[k] + kappa * w;
            let share = rate * above;
            let last = w;
            w = inverse * (share * by_velocity - by_depth)
                + (inverse * first * (share - 1.0)) * last;
            by_depth += first * last;
            turned[DEGREE + ROW - 1 - next] = [w; 2];
            if grip > 0.0 {
                resisting += grip * (next as f64 * (by_depth + deflection * w));
            }
            v[next] = rate * (load - resisting);
            if next < DEGREE {
                d[next + 1] = v[next] * RECIPROCALS[next + 1];
                newest = [v[next], d[next + 1]];
                moved[ROW + k] = newest;
            }
            load = push[next];
        }
        v
    }
}

/// Products that are added up side by side.
const ROW: usize = 4;

/// Sums of the products of two rows, lane by lane.
#[inline(always)]
fn inner_sums(a: &[[f64; 2]], b: &[[f64; 2]]) -> [f64; 2] {
    let mut sums = [[0.0; 2]; ROW];
    for (a, b) in a.chunks_exact(ROW).zip(b.chunks_exact(ROW)) {
        for row in 0..ROW {
            for lane in 0..2 {
                sums[row][lane] += a[row][lane] * b[row][lane];
            }
        }
    }
    [0, 1].map(|lane| (sums[0][lane] + sums[1][lane]) + (sums[2][lane] + sums[3][lane]))
}
