//! The window that lanes decide, with the motion in it.

use pulp::Simd;

use super::lanes::Lanes;
use super::law::Law;
use super::parts::Parts;

/// The window that is decided, or the first part of it.
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
    /// The motion at a time within the window.
    #[inline(always)]
    pub fn motion_at(&self, law: &Law<S, N>, time: Lanes<S, N>) -> Parts<S, N> {
        self.here
            .within_window(law, self.frequency, &self.next, time)
    }

    /// Position from the edge, velocity and acceleration.
    #[inline(always)]
    pub fn state_from_edge(&self, law: &Law<S, N>, parts: &Parts<S, N>) -> [Lanes<S, N>; 3] {
        [
            parts.y + (parts.p - law.edge),
            parts.u + parts.q,
            parts.acceleration(law, self.frequency),
        ]
    }
}
