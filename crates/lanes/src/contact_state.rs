//! The state of a contact under a power law, lane by lane.

use pulp::Simd;

use super::lane_laws::Laws;
use super::lanes::{Lanes, Mask, Pair};

/// State of a power-law contact in every lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContactState<S: Simd, const N: usize> {
    /// Square root s of the deflection; velocity towards the stop.
    pub root: Lanes<S, N>,
    pub velocity: Lanes<S, N>,
    /// cos and sin of the drive angle.
    pub angle: Pair<S, N>,
    /// Time since the contact was taken up, in s.
    pub time: Lanes<S, N>,
}

impl<S: Simd, const N: usize> ContactState<S, N> {
    #[inline(always)]
    pub fn choose(mask: Mask<S, N>, yes: &Self, no: &Self) -> Self {
        Self {
            root: mask.choose(yes.root, no.root),
            velocity: mask.choose(yes.velocity, no.velocity),
            angle: (
                mask.choose(yes.angle.0, no.angle.0),
                mask.choose(yes.angle.1, no.angle.1),
            ),
            time: mask.choose(yes.time, no.time),
        }
    }

    /// The longest step, in sigma, over which the series of drive and suspension converge fast from this state.
    #[inline(always)]
    pub fn longest_step(&self, law: &Laws<S, N>) -> Lanes<S, N> {
        let four = law.window.like(4.0);
        let by_speed = (law.window * four / self.velocity.abs()).square_root();
        (law.window / self.root).min(by_speed)
    }
}
