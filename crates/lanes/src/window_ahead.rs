//! The window that lanes decide, with the motion in it.

use pulp::Simd;

use super::engine::Engine;
use super::free_and_steady_parts::Parts;
use super::lane_laws::Laws;
use super::lanes::{Lanes, Mask};
use super::scan_windows::ScanResult;

/// The window that each lane decides next, or the first part of it, with the motion at its ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct WindowAhead<S: Simd, const N: usize> {
    pub frequency: Lanes<S, N>,
    /// The motion now, at the end of the part that is decided, and a window from now.
    pub here: Parts<S, N>,
    pub there: Parts<S, N>,
    pub next: Parts<S, N>,
    pub span: Lanes<S, N>,
    /// (span / window)^4.
    pub scale: Lanes<S, N>,
}

impl<S: Simd, const N: usize> WindowAhead<S, N> {
    /// Position from the guard's edge, velocity and acceleration of a motion given by its parts.
    #[inline(always)]
    pub fn state_from_edge(&self, law: &Laws<S, N>, parts: &Parts<S, N>) -> [Lanes<S, N>; 3] {
        [
            parts.y + (parts.p - law.edge),
            parts.u + parts.q,
            parts.acceleration(law, self.frequency),
        ]
    }
}

impl<S: Simd, const N: usize> Engine<'_, S, N> {
    /// The window ahead of all lanes, of which the lanes `pending` decide the first `span` seconds.
    #[inline(always)]
    pub fn window_ahead(
        &self,
        law: &Laws<S, N>,
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
}
