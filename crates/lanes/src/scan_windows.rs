//! Scans window by window as long as a bound proves that the lanes meet nothing.

use pulp::Simd;

use super::cubic::Cubic;
use super::engine::Engine;
use super::free_and_steady_parts::Parts;
use super::lane_laws::Laws;
use super::lanes::{Lanes, Mask};

/// Most windows of one scan, about a drive period; after it the lanes that have stopped decide their windows.
pub(super) const MAX_SCAN_WINDOWS: usize = 12;
/// Least distance of the second Bernstein coefficient of a window's cubic from the guard, in units of the cubic's error bound,
/// that proves a motion clear of the guard that it leaves at the left end.
pub(super) const LEAVING_MARGIN: f64 = 16.0 / 3.0;

/// Where a scan has brought the lanes, and whether they may go on.
#[derive(Debug, Clone, Copy)]
pub(super) struct ScanResult<S: Simd, const N: usize> {
    /// The motion where they stand.
    pub parts: Parts<S, N>,
    /// The motion a window later.
    pub next: Parts<S, N>,
    /// |x''''| window^4 / 384.
    pub error_bound: Lanes<S, N>,
    /// Windows scanned.
    pub count: Lanes<S, N>,
    /// Lanes that may go on.
    pub go: Mask<S, N>,
}

impl<S: Simd, const N: usize> Engine<'_, S, N> {
    /// The result of a scan of no windows: all lanes stand where they are, and decide their next window at once.
    #[inline(always)]
    pub fn stand_before_window(&self, law: &Laws<S, N>, active: Mask<S, N>) -> ScanResult<S, N> {
        let parts = self.motion_parts(law);
        ScanResult {
            parts,
            next: parts.after_window(law),
            error_bound: parts.position_error(law),
            count: parts.y.like(0.0),
            go: active.and_not(active),
        }
    }

    /// Moves the lanes on window by window, between two positions that end the phase or up to one, until each stands before a
    /// window in which it may meet them, or which is its last. `cap`: windows up to the end of its time.
    #[inline(always)]
    pub fn scan_windows<const HAS_OTHER_ENDS: bool>(
        &self,
        law: &Laws<S, N>,
        active: Mask<S, N>,
        cap: Lanes<S, N>,
    ) -> ScanResult<S, N> {
        let one = cap.like(1.0);
        let mut reached = self.stand_before_window(law, active);
        let ScanResult {
            mut parts,
            mut next,
            error_bound,
            ..
        } = reached;
        let (x, v) = (parts.y + parts.p, parts.u + parts.q);
        let (ceiling, floor) = law.edges::<HAS_OTHER_ENDS>();
        let mut apart = (ceiling - law.ambiguity).below(x).not();
        let leaves = v.below(-law.slow);
        let mut go = active & self.state.window_fraction.equals(one) & (apart | leaves);
        let limit = ceiling - error_bound;
        let mut top = law.third.mul_add(v, x);
        // On the edge the first two Bernstein coefficients need no proof.
        top = apart.choose(top.max(x), one.like(f64::NEG_INFINITY));
        let leaving = error_bound.mul_add(one.like(-LEAVING_MARGIN), ceiling);
        let mut below = apart.choose(limit, leaving);
        let lowest = floor + error_bound;
        let (mut bottom, mut above) = (x, lowest);
        if HAS_OTHER_ENDS {
            let apart = x.below(floor + law.ambiguity).not();
            go = go & (apart | law.slow.below(v));
            let ahead = law.third.mul_add(v, x);
            bottom = apart.choose(ahead.min(x), one.like(f64::INFINITY));
            let leaving = error_bound.mul_add(one.like(LEAVING_MARGIN), floor);
            above = apart.choose(lowest, leaving);
        }
        let capped = (go & cap.below(one.like(MAX_SCAN_WINDOWS as f64))).any();
        // All lanes move on, those that have stopped too, or each window would wait for the verdict on the one before.
        for window in 0..MAX_SCAN_WINDOWS {
            let count = one.like(window as f64);
            let (x, v) = (next.y + next.p, next.u + next.q);
            let before = x.minus_product(law.third, v);
            let mut clear = top.max(x.max(before)).below(below);
            let suspect = go.and_not(clear) & apart & x.below(limit);
            if HAS_OTHER_ENDS {
                clear = clear & above.below(bottom.min(x.min(before)));
            } else if suspect.any() {
                let left = (parts.y + parts.p, parts.u + parts.q);
                let top = Cubic::interpolate(left, (x, v), law.window).maximum();
                clear = clear | (suspect & top.below(limit));
            }
            if capped {
                clear = clear & (count + one).at_most(cap);
            }
            let stops = go.and_not(clear);
            if stops.any() {
                reached.stop_lanes(stops, &parts, &next, count);
                go = go & clear;
                if !go.any() {
                    break;
                }
            }
            parts = next;
            next = parts.after_window(law);
            apart = one.at_most(one);
            (top, below) = (law.third.mul_add(v, x), limit);
            (bottom, above) = (top, lowest);
        }
        if go.any() {
            reached.stop_lanes(go, &parts, &next, one.like(MAX_SCAN_WINDOWS as f64));
        }
        ScanResult { go, ..reached }
    }
}

impl<S: Simd, const N: usize> ScanResult<S, N> {
    /// Notes that some lanes stand here, before the next window.
    #[inline(always)]
    fn stop_lanes(
        &mut self,
        lanes: Mask<S, N>,
        parts: &Parts<S, N>,
        next: &Parts<S, N>,
        count: Lanes<S, N>,
    ) {
        self.parts = Parts::choose(lanes, parts, &self.parts);
        self.next = Parts::choose(lanes, next, &self.next);
        self.count = lanes.choose(count, self.count);
    }
}
