//! The section of a branch: the drive angle at which it is looked at.
//!
//! Where the state at drive angle phi comes to lie on a surface, the orbit crosses the surface as before. But if the
//! force jumps there, so does the acceleration, and the state at that angle changes its direction along the branch;
//! at a rigid wall it jumps from before the impact to after it, and at rest it does not change at all. No short step of
//! a smooth curve leads over that. Seen in the middle of the longest flight the same branch is smooth.

use nalgebra::DVector;

use super::arclength::{Node, correct, curve_tangent};
use super::follow::{Continuation, SectionChange, same_orientation};
use super::period_map::{PeriodMap, before_wall, state_after};
use super::point::BranchPoint;
use crate::tolerance::DIFFERENCE_WIDTH;
use softstop::{MotionError, Trajectory};

impl<'a> Continuation<'a> {
    /// Turns the section of a branch to where no crossing stands in the way; none if this section is as good as any.
    pub(super) fn turn_section(
        &self,
        node: &Node<PeriodMap>,
        direction: &DVector<f64>,
    ) -> Option<SectionChange<'a>> {
        let continuation = self.clear_of(node)?;
        let by = continuation.shooting.turn - self.shooting.turn;
        let carried = |at: &DVector<f64>| self.carry_place(at, by);
        let at = carried(&node.at).ok()?;
        let back = carried(&(&node.at - DIFFERENCE_WIDTH * direction)).ok()?;
        let along = (&at - back).normalize();
        let seen = correct(&continuation.shooting, &at, Some(&along)).ok()?;
        if (&seen.at - &at).norm() > self.settings.newton_reach {
            return None;
        }
        let (mut along, _) = curve_tangent(&continuation.shooting, &seen, &along).ok()?;
        // Where small changes grow too much on the way, what is carried back may point backward.
        let [before, after] = [node, &seen].map(|node| &node.here.point.monodromy);
        if !same_orientation((direction, before), (&along, after)) {
            along.neg_mut();
        }
        Some(SectionChange {
            continuation,
            node: seen,
            along,
        })
    }

    /// This continuation with its section in the middle of the orbit's longest flight; none if no crossing is near.
    pub(super) fn clear_of(&self, node: &Node<PeriodMap>) -> Option<Self> {
        let margin = node.here.point.margin;
        if margin > self.settings.section_margin {
            return None;
        }
        let (middle, gap) = longest_flight(&node.here.point.trajectory, self.shooting.periods);
        let is_better = 0.5 * gap > 2.0 * margin;
        is_better.then(|| self.with_turn(self.shooting.turn + middle))
    }

    /// Carries a place to another section: to that some drive periods later on the same motion.
    pub(super) fn carry_place(
        &self,
        at: &DVector<f64>,
        periods: f64,
    ) -> Result<DVector<f64>, MotionError> {
        let whole = self.shooting.periods as f64;
        let scene = self.shooting.scene_at(at)?;
        let begin = before_wall(&scene, self.shooting.state_at(at));
        let state = state_after(&scene, begin, periods.rem_euclid(whole))?;
        Ok(self.shooting.scaled(state, self.shooting.parameters(at)))
    }

    /// The place of a point of a branch, as it is seen at this section.
    pub(super) fn place_of(&self, point: &BranchPoint) -> Result<DVector<f64>, MotionError> {
        let plain = self.with_turn(0.0);
        let at = plain.shooting.scaled(point.state(), [point.parameter]);
        match self.shooting.turn {
            0.0 => Ok(at),
            turn => plain.carry_place(&at, turn),
        }
    }
}

/// Middle and length in drive periods of the longest flight of a motion: it crosses nothing and is not held.
fn longest_flight(motion: &Trajectory, periods: u64) -> (f64, f64) {
    let ended = motion.arcs.iter();
    let all = ended.filter_map(|arc| {
        let time = motion.clock.time(arc.crossing?.instant);
        let flies = !(arc.course.is_held() || arc.course.is_chattering());
        Some((time / motion.clock.period(), flies))
    });
    // The longest flight may lead over time 0.
    let again = all.clone().take(1);
    let again = again.map(|(time, flies)| (time + periods as f64, flies));
    let pairs = all.clone().zip(all.skip(1).chain(again));
    let flights = pairs.filter(|(_, (_, flies))| *flies);
    let flights = flights.map(|((from, _), (to, _))| (0.5 * (from + to), to - from));
    flights.fold((0.0, 0.0), |longest, flight| {
        if flight.1 > longest.1 {
            flight
        } else {
            longest
        }
    })
}
