//! Decides what happens in the window ahead of each lane: nothing, a crossing, or what the safe engine has to tell.

use pulp::Simd;

use super::engine::Engine;
use super::guard_search::SearchResult;
use super::lane_laws::MIN_WINDOW_SHARE;
use super::lanes::{Lanes, Mask};
use super::move_lanes::LaneEnd;
use super::scan_windows::ScanResult;
use super::window_guard::WindowGuard;

/// Shortest time that lanes decide at once, in windows: where less is left of a period it is taken for this long.
const MIN_DECIDED_SPAN: f64 = 1e-12;

impl<S: Simd, const N: usize> Engine<'_, S, N> {
    /// Decides for each lane that the scan has stopped whether its guard rises through zero in the window ahead, and moves all
    /// `active` lanes to the crossing or on, none longer than `due`. Returns the lanes that came to the end of their job, and
    /// those that the safe engine has to take.
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
        let guard = WindowGuard::of_window::<HAS_OTHER_ENDS>(law, &ahead, reached.error_bound);
        let found = guard.search_window::<HAS_OTHER_ENDS>(law, &ahead, pending);
        let (hits, doubtful) =
            self.move_to_decision::<HAS_OTHER_ENDS>(phase, active, &guard, &found, scanned);
        let arrived = found.clear & remaining.at_most(span);
        self.state.window_fraction = self.next_shares(active, pending.and_not(hits | found.clear));
        let doubtful = doubtful | self.state.window_fraction.below(due.like(MIN_WINDOW_SHARE));
        (self.end_periods(arrived), doubtful)
    }

    /// Moves the active lanes to the end of their window or to their crossing; returns those that cross, and the doubtful ones.
    #[inline(always)]
    fn move_to_decision<const HAS_OTHER_ENDS: bool>(
        &mut self,
        phase: usize,
        active: Mask<S, N>,
        guard: &WindowGuard<S, N>,
        found: &SearchResult<S, N>,
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
            let (at_position, at_further) = (hits.and_not(is_further), hits & is_further);
            let turns = at_further & law.ends_at_reversal();
            let turned = turns.choose(zero, v);
            let x = at_further.choose(found.position, x);
            let beyond = is_low.choose(law.beyond_low, law.beyond_high);
            let bounced = v * is_low.choose(law.bounce_low, law.bounce);
            let impact = is_low.choose(law.impact_low, law.impact);
            LaneEnd {
                x: at_position.choose(is_low.choose(law.low, law.high), x),
                v: at_position.choose(bounced, turned),
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

    /// The share of a window that each active lane decides next: all of it, or half of the share that could not be decided.
    #[inline(always)]
    fn next_shares(&self, active: Mask<S, N>, undecided: Mask<S, N>) -> Lanes<S, N> {
        let share = self.state.window_fraction;
        let halved = share * share.like(0.5);
        undecided.choose(halved, active.choose(share.like(1.0), share))
    }
}
