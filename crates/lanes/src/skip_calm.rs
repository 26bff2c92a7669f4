//! Skips all drive periods at once in lanes that provably meet no face any more.

use pulp::Simd;

use super::engine::Engine;
use super::lanes::{Lanes, Mask};
use super::parts::Parts;
use super::scan::ScanResult;

/// Drive periods at the end of a job that are never skipped: more than one scan covers.
const UNSKIPPED_PERIODS: f64 = 4.0;

impl<S: Simd, const N: usize> Engine<'_, S, N> {
    /// Moves the active lanes that stand before nothing, or only before the end of a period, on to the last periods of
    /// their job if they never meet a face: the free motion dies away, and the largest sum of it and the steady one
    /// lies below the guard. An observer is told of the periods that are skipped.
    #[inline(always)]
    pub fn skip_calm_periods<const HAS_OTHER_ENDS: bool>(
        &mut self,
        phase: usize,
        active: Mask<S, N>,
        reached: &mut ScanResult<S, N>,
    ) {
        let law = &self.laws[phase];
        let parts = reached.parts;
        let left = self.state.left;
        let (zero, last) = (left.like(0.0), left.like(UNSKIPPED_PERIODS));
        let far = law.longest.mul_add(parts.u.abs(), parts.y.abs()) + law.swing;
        let (ceiling, floor) = law.edges::<HAS_OTHER_ENDS>();
        let room = if HAS_OTHER_ENDS {
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
            self.tell_calm_periods(phase, calm, reached);
        }
        self.count_calm_periods(calm);
        let law = &self.laws[phase];
        let time = (left - last) * self.state.drive.period;
        let frequency = self.state.drive.frequency;
        let (y, u) = Parts::free_after(law, frequency, calm.choose(time, zero), (parts.y, parts.u));
        let later = Parts { y, u, ..parts };
        reached.parts = Parts::choose(calm, &later, &parts);
        reached.go = reached.go | calm;
        self.state.left = calm.choose(last, left);
    }

    /// Counts the periods that these lanes skip, unless they follow a trial cycle.
    #[cold]
    #[inline(never)]
    fn count_calm_periods(&mut self, calm: Mask<S, N>) {
        for lane in 0..Lanes::<S, N>::COUNT {
            if calm.get(lane) && !self.returns[lane].is_trial() {
                self.count_skipped(lane, self.state.left.get(lane) - UNSKIPPED_PERIODS);
            }
        }
    }

    /// Tells the observer of all ends of periods that lanes skip.
    #[inline(always)]
    fn tell_calm_periods(&mut self, phase: usize, calm: Mask<S, N>, reached: &ScanResult<S, N>) {
        let law = &self.laws[phase];
        let drive = self.state.drive;
        let Parts { y, u, .. } = reached.parts;
        let (zero, one, last) = (y.like(0.0), y.like(1.0), y.like(UNSKIPPED_PERIODS));
        let rest = drive.period - (self.state.offset + reached.count * law.window);
        let mut free = Parts::free_after(law, drive.frequency, calm.choose(rest, zero), (y, u));
        let (xx, vx) = Parts::free_after(law, drive.frequency, drive.period, (one, zero));
        let (xv, vv) = Parts::free_after(law, drive.frequency, drive.period, (zero, one));
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
