//! Over all drive periods at once, where nothing can happen any more.

use pulp::Simd;

use super::engine::Engine;
use super::lanes::Lanes;
use super::law::Law;
use super::parts::Parts;
use super::scan::Reached;

/// Drive periods at the end of a job that are gone through as always: more than a scan reaches.
const LAST: f64 = 4.0;

impl<S: Simd, const N: usize> Engine<'_, S, N> {
    /// Moves the lanes of a scan that met nothing on to the last periods of their job if they never meet anything: the
    /// free motion dies away, and the largest that it and the steady one can be together lies below the guard.
    #[inline(always)]
    pub fn leap(&mut self, phase: usize, reached: &mut Reached<S, N>) {
        if self.task.watch.periods {
            return;
        }
        let law = &self.laws[phase];
        let parts = reached.parts;
        let left = self.state.left;
        let (zero, one, last) = (left.like(0.0), left.like(1.0), left.like(LAST));
        let far = law.longest.mul_add(parts.u.abs(), parts.y.abs()) + law.swing;
        let calm = reached.go & far.below(law.edge - law.grain) & last.below(left);
        if !calm.any() {
            return;
        }
        let time = (left - last) * self.state.drive.period;
        let windows = time.mul_add(law.per_window, one.like(0.5)).floor();
        let rest = time.minus_product(windows, law.window);
        let begun = parts.after(law, self.state.drive.frequency, rest);
        let (y, u) = law.free_after(calm.choose(windows, zero), (begun.y, begun.u));
        let later = Parts { y, u, ..parts };
        reached.parts = Parts::choose(calm, &later, &parts);
        self.state.left = calm.choose(last, left);
    }
}

impl<S: Simd, const N: usize> Law<S, N> {
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
