//! Decides what happens in the window ahead of each lane: nothing, a crossing, or what the safe engine has to tell.

use pulp::Simd;

use super::engine::Engine;
use super::guard::Guard;
use super::guard_search::Found;
use super::lanes::{Lanes, Mask};
use super::law::{Law, MIN_WINDOW_SHARE};
use super::move_lanes::LaneEnd;
use super::parts::Parts;
use super::scan::ScanResult;
use super::window_ahead::WindowAhead;

/// Shortest time that is decided at once, in windows: less that is left of a period is taken for this long.
const MIN_DECIDED_SPAN: f64 = 1e-12;

impl<S: Simd, const N: usize> Engine<'_, S, N> {
    /// Decides the window ahead of the lanes that the scan has stopped, and moves all `active` ones on, none longer
    /// than `due`; those that came to the end of their job, and those that the safe engine has to take.
    #[inline(always)]
    pub fn decide_window<const HAS_OTHER_ENDS: bool>(
        &mut self,
        phase: usize,
        active: Mask<S, N>,
        reached: &ScanResult<S, N>,
        due: Lanes<S, N>,
    ) -> (Mask<S, N>, Mask<S, N>) {
        let law = &self.laws[phase];
        let pending = active.and_not(reached.go);
        let scanned = reached.count * law.window;
        let remaining = due - scanned;
        let least = law.window * due.like(MIN_DECIDED_SPAN);
        let span = (self.state.window_fraction * law.window)
            .min(remaining)
            .max(least);
        let ahead = self.window_ahead(law, reached, pending, span);
        let guard = Guard::of_window::<HAS_OTHER_ENDS>(law, &ahead, reached.error_bound);
        let found = guard.search_window::<HAS_OTHER_ENDS>(law, &ahead, pending);
        let (hits, doubtful) =
            self.move_to_decision::<HAS_OTHER_ENDS>(phase, active, &guard, &found, scanned);
        let arrived = found.clear & remaining.at_most(span);
        self.state.window_fraction = self.next_shares(active, pending.and_not(hits | found.clear));
        let doubtful = doubtful | self.state.window_fraction.below(due.like(MIN_WINDOW_SHARE));
        (self.end_periods(arrived), doubtful)
    }

    /// The window ahead of all lanes, of which the lanes `pending` decide the first `span` seconds.
    #[inline(always)]
    fn window_ahead(
        &self,
        law: &Law<S, N>,
        reached: &ScanResult<S, N>,
        pending: Mask<S, N>,
        span: Lanes<S, N>,
    ) -> WindowAhead<S, N> {
        let frequency = self.state.drive.frequency;
        let here = reached.parts;
        let next = reached.next;
        let (mut there, mut scale) = (next, span.like(1.0));
        let part = pending & span.below(law.window);
        if part.any() {
            let at = here.within_window(law, frequency, &next, part.choose(span, law.window));
            there = Parts::choose(part, &at, &next);
            let share = span * law.per_window;
            let square = share * share;
            scale = part.choose(square * square, scale);
        }
        WindowAhead {
            frequency,
            here,
            there,
            next,
            span,
            scale,
        }
    }

    /// Moves the active lanes to the end of the window or to their crossing; those that cross, and the doubtful ones.
    #[inline(always)]
    fn move_to_decision<const HAS_OTHER_ENDS: bool>(
        &mut self,
        phase: usize,
        active: Mask<S, N>,
        guard: &Guard<S, N>,
        found: &Found<S, N>,
        scanned: Lanes<S, N>,
    ) -> (Mask<S, N>, Mask<S, N>) {
        let law = &self.laws[phase];
        let zero = scanned.like(0.0);
        let hits = found.hits & guard.slow.below(found.rate);
        let doubtful = found.doubtful | found.hits.and_not(hits);
        let time = scanned + found.time;
        let moved = active.and_not(doubtful) & zero.below(time);
        let parts = &found.parts;
        let (x, v) = (
            law.side.mul_add(parts.y + parts.p, law.offset),
            law.side * hits.choose(found.velocity, parts.u + parts.q),
        );
        let end = if HAS_OTHER_ENDS {
            let (is_low, is_further) = (guard.is_low, guard.is_further);
            let (at_face, at_further) = (hits.and_not(is_further), hits & is_further);
            let turns = at_further & law.ends_at_reversal();
            let turned = turns.choose(zero, v);
            let x = at_further.choose(found.position, x);
            let beyond = is_low.choose(law.beyond_low, law.beyond_high);
            let bounced = v * is_low.choose(law.bounce_low, law.bounce);
            let impact = is_low.choose(law.impact_low, law.impact);
            LaneEnd {
                x: at_face.choose(is_low.choose(law.low, law.high), x),
                v: at_face.choose(bounced, turned),
                beyond: is_further.choose(law.beyond_guard, beyond),
                impact: is_further.choose(zero, impact),
                before: v,
            }
        } else {
            LaneEnd {
                x: hits.choose(law.end, x),
                v: hits.choose(v * law.end_bounce, v),
                beyond: law.beyond_end,
                impact: law.end_impact,
                before: v,
            }
        };
        let (cos, sin) = parts.drive_angle(law);
        self.move_lanes((moved, hits), &end, (cos, sin), time);
        (hits, doubtful)
    }

    /// Shares of a window that the active lanes decide next: half of that which could not be decided.
    #[inline(always)]
    fn next_shares(&self, active: Mask<S, N>, undecided: Mask<S, N>) -> Lanes<S, N> {
        let share = self.state.window_fraction;
        let halved = share * share.like(0.5);
        undecided.choose(halved, active.choose(share.like(1.0), share))
    }
}
