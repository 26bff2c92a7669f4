//! Skips all drive periods at once in lanes that provably meet no surface any more.

use pulp::Simd;

use super::engine::Engine;
use super::free_and_steady_parts::Parts;
use super::lanes::{Lanes, Mask};
use super::scan_windows::ScanResult;

/// Drive periods at the end of a job that are never skipped: more than one scan covers.
const UNSKIPPED_PERIODS: f64 = 4.0;

impl<S: Simd, const N: usize> Engine<'_, S, N> {
    /// Moves active lanes on to the last drive periods of their job if they provably never meet a surface again: their free motion
    /// dies away, and the largest sum of it and the steady motion lies below the guard. Observers are told of the skipped periods.
    #[inline(always)]
    pub fn skip_contactless_periods<const HAS_OTHER_ENDS: bool>(
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
        let skipped =
            active & zero.below(reached.count) & far.below(room - law.ambiguity) & last.below(left);
        if !skipped.any() {
            return;
        }
        if self.task.watch.periods {
            self.tell_skipped_periods(phase, skipped, reached);
        }
        self.count_skipped_periods(skipped);
        let law = &self.laws[phase];
        let time = (left - last) * self.state.drive.period;
        let frequency = self.state.drive.frequency;
        let (y, u) = Parts::free_after(
            law,
            frequency,
            skipped.choose(time, zero),
            (parts.y, parts.u),
        );
        let later = Parts { y, u, ..parts };
        reached.parts = Parts::choose(skipped, &later, &parts);
        reached.go = reached.go | skipped;
        self.state.left = skipped.choose(last, left);
    }

    /// Counts the periods that lanes without further contact skip, unless they follow a trial cycle.
    #[cold]
    #[inline(never)]
    fn count_skipped_periods(&mut self, skipped: Mask<S, N>) {
        for lane in 0..Lanes::<S, N>::COUNT {
            if skipped.get(lane) && !self.returns[lane].is_trial() {
                self.count_skipped(lane, self.state.left.get(lane) - UNSKIPPED_PERIODS);
            }
        }
    }

    /// Tells the observer of the beginnings of all periods that lanes without further contact skip.
    #[inline(always)]
    fn tell_skipped_periods(
        &mut self,
        phase: usize,
        skipped: Mask<S, N>,
        reached: &ScanResult<S, N>,
    ) {
        let law = &self.laws[phase];
        let drive = self.state.drive;
        let Parts { y, u, .. } = reached.parts;
        let (zero, one, last) = (y.like(0.0), y.like(1.0), y.like(UNSKIPPED_PERIODS));
        let rest = drive.period - (self.state.offset + reached.count * law.window);
        let mut free = Parts::free_after(law, drive.frequency, skipped.choose(rest, zero), (y, u));
        let (xx, vx) = Parts::free_after(law, drive.frequency, drive.period, (one, zero));
        let (xv, vv) = Parts::free_after(law, drive.frequency, drive.period, (zero, one));
        let (cos, sin) = drive.begin;
        let p = law.cosine.mul_add(cos, law.sine * sin);
        let q = law.cosine_rate.mul_add(cos, law.sine_rate * sin);
        let (side, offset) = (law.side, law.offset);
        let (mut told, mut left) = (skipped, self.state.left);
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
