//! Over all drive periods at once, where nothing can happen any more.

use pulp::Simd;

use super::engine::Engine;
use super::lanes::{Lanes, Mask};
use super::law::Law;
use super::parts::Parts;
use super::scan::Reached;

/// Drive periods at the end of a job that are gone through as always: more than a scan reaches.
const LAST: f64 = 4.0;

impl<S: Simd, const N: usize> Engine<'_, S, N> {
    /// Moves the active lanes that stand before nothing, or only before the end of a period, on to the last periods of
    /// their job if they never meet anything: the free motion dies away, and the largest that it and the steady one can
    /// be together lies below the guard. An observer of periods is told of those that are left out.
    #[inline(always)]
    pub fn leap<const GUARDED: bool>(
        &mut self,
        phase: usize,
        active: Mask<S, N>,
        reached: &mut Reached<S, N>,
    ) {
        let law = &self.laws[phase];
        let parts = reached.parts;
        let left = self.state.left;
        let (zero, last) = (left.like(0.0), left.like(LAST));
        let far = law.longest.mul_add(parts.u.abs(), parts.y.abs()) + law.swing;
        let (ceiling, floor) = law.edges::<GUARDED>();
        let room = if GUARDED {
            ceiling.min(-floor)
        } else {
            ceiling
        };
        let calm =
            active & zero.below(reached.count) & far.below(room - law.ambiguity) & last.below(left);
        if !calm.any() {
            return;
        }
        if self.task.watch.periods {
            self.tell_calm(phase, calm, reached);
        }
        self.count_calm(calm);
        let law = &self.laws[phase];
        let time = (left - last) * self.state.drive.period;
        let frequency = self.state.drive.frequency;
        let (y, u) = law.free_at(frequency, calm.choose(time, zero), (parts.y, parts.u));
        let later = Parts { y, u, ..parts };
        reached.parts = Parts::choose(calm, &later, &parts);
        reached.go = reached.go | calm;
        self.state.left = calm.choose(last, left);
    }

    /// Counts the periods that these lanes leap over, unless they try a guess.
    #[cold]
    #[inline(never)]
    fn count_calm(&mut self, calm: Mask<S, N>) {
        for lane in 0..Lanes::<S, N>::COUNT {
            if calm.get(lane) && !self.returns[lane].is_trial() {
                self.count_leapt(lane, self.state.left.get(lane) - LAST);
            }
        }
    }

    /// Tells the watcher of all ends of periods that lanes leap over.
    #[inline(always)]
    fn tell_calm(&mut self, phase: usize, calm: Mask<S, N>, reached: &Reached<S, N>) {
        let law = &self.laws[phase];
        let drive = self.state.drive;
        let Parts { y, u, .. } = reached.parts;
        let (zero, one, last) = (y.like(0.0), y.like(1.0), y.like(LAST));
        let rest = drive.period - (self.state.offset + reached.count * law.window);
        let mut free = law.free_at(drive.frequency, calm.choose(rest, zero), (y, u));
        let (xx, vx) = law.free_at(drive.frequency, drive.period, (one, zero));
        let (xv, vv) = law.free_at(drive.frequency, drive.period, (zero, one));
        let (cos, sin) = drive.begin;
        let p = law.cosine.mul_add(cos, law.sine * sin);
        let q = law.cosine_rate.mul_add(cos, law.sine_rate * sin);
        let (side, offset) = (law.side, law.offset);
        let (mut told, mut left) = (calm, self.state.left);
        while told.any() {
            let x = side.mul_add(free.0 + p, offset);
            let v = side * (free.1 + q);
            left = left - one;
            self.tell_states(told, left, (x, v));
            told = told & last.below(left);
            free = (
                xx.mul_add(free.0, xv * free.1),
                vx.mul_add(free.0, vv * free.1),
            );
        }
    }
}

impl<S: Simd, const N: usize> Law<S, N> {
    /// A free motion after a time.
    #[inline(always)]
    fn free_at(
        &self,
        frequency: Lanes<S, N>,
        time: Lanes<S, N>,
        (y, u): (Lanes<S, N>, Lanes<S, N>),
    ) -> (Lanes<S, N>, Lanes<S, N>) {
        let windows = time.mul_add(self.per_window, y.like(0.5)).floor();
        let parts = Parts {
            y,
            u,
            p: y.like(0.0),
            q: y.like(0.0),
        };
        let begun = parts.after(self, frequency, time.minus_product(windows, self.window));
        self.free_after(windows, (begun.y, begun.u))
    }

    /// A free motion after whole windows, by powers of their matrix.
    #[inline(always)]
    fn free_after(
        &self,
        windows: Lanes<S, N>,
        (mut y, mut u): (Lanes<S, N>, Lanes<S, N>),
    ) -> (Lanes<S, N>, Lanes<S, N>) {
        let (zero, one, half) = (y.like(0.0), y.like(1.0), y.like(0.5));
        let (mut xx, mut xv, mut vx, mut vv) = (self.xx, self.xv, self.vx, self.vv);
        let mut left = windows;
        while zero.below(left).any() {
            let halved = (left * half).floor();
            let odd = one.equals(left - (halved + halved));
            let (next_y, next_u) = (xx.mul_add(y, xv * u), vx.mul_add(y, vv * u));
            (y, u) = (odd.choose(next_y, y), odd.choose(next_u, u));
            let (trace, cross) = (xx + vv, xv * vx);
            (xx, vv) = (xx.mul_add(xx, cross), vv.mul_add(vv, cross));
            (xv, vx) = (xv * trace, vx * trace);
            left = halved;
        }
        (y, u)
    }
}
