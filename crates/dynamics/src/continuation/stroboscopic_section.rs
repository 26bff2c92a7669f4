//! The section of a branch: the drive angle at which it is looked at.
//!
//! Where the state at drive angle phi comes to lie on a surface, the orbit crosses the surface as before. But if the
//! force jumps there, so does the acceleration, and the state at that angle changes its direction along the branch;
//! at a rigid wall it jumps from before the impact to after it, and at rest it does not change at all. No short step of
//! a smooth curve leads over that. Seen in the middle of the longest flight the same branch is smooth.

use nalgebra::DVector;

use super::equations::CurveNode;
use super::newton_corrector::{correct, curve_tangent};
use super::period_map::{PeriodMap, clamp_to_walls, state_after_periods};
use super::step_acceptance::same_orientation;
use super::{BranchPoint, Continuation};
use crate::orbit::OrbitError;
use crate::tolerance::DIFFERENCE_WIDTH;
use softstop::{MotionError, Trajectory};

/// A branch seen at another section: a node of it, and the direction in which it goes on.
pub(super) struct SectionChange<'a> {
    pub continuation: Continuation<'a>,
    pub node: CurveNode<PeriodMap>,
    pub along: DVector<f64>,
}

impl<'a> Continuation<'a> {
    /// Follows a branch from section to section, as far as `follow` says at each how it goes on.
    pub(super) fn follow_sections(
        &self,
        begin: (CurveNode<PeriodMap>, &DVector<f64>),
        mut follow: impl FnMut(
            &Self,
            (CurveNode<PeriodMap>, &DVector<f64>),
        ) -> Result<Option<SectionChange<'a>>, OrbitError>,
    ) -> Result<(), OrbitError> {
        let mut next = follow(self, begin)?;
        while let Some(SectionChange {
            continuation,
            node,
            along,
        }) = next
        {
            next = follow(&continuation, (node, &along))?;
        }
        Ok(())
    }

    /// Turns the section of a branch to where no crossing stands in the way; none if this section is as good as any.
    pub(super) fn turn_section(
        &self,
        node: &CurveNode<PeriodMap>,
        direction: &DVector<f64>,
    ) -> Option<SectionChange<'a>> {
        let continuation = self.with_clear_section(node)?;
        let by = continuation.shooting.turn - self.shooting.turn;
        let carried = |at: &DVector<f64>| self.carry_unknowns(at, by);
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

    /// This continuation with its section in the middle of the orbit's longest flight; none if no crossing lies near the present
    /// section.
    pub(super) fn with_clear_section(&self, node: &CurveNode<PeriodMap>) -> Option<Self> {
        let margin = node.here.point.margin;
        if margin > self.settings.section_margin {
            return None;
        }
        let (middle, gap) = longest_flight(&node.here.point.trajectory, self.shooting.periods);
        let is_better = 0.5 * gap > 2.0 * margin;
        is_better.then(|| self.with_turn(self.shooting.turn + middle))
    }

    /// Carries a place to another section: to that some drive periods later on the same motion.
    pub(super) fn carry_unknowns(
        &self,
        at: &DVector<f64>,
        periods: f64,
    ) -> Result<DVector<f64>, MotionError> {
        let whole = self.shooting.periods as f64;
        let scene = self.shooting.scene_at(at)?;
        let begin = clamp_to_walls(&scene, self.shooting.state_at(at));
        let state = state_after_periods(&scene, begin, periods.rem_euclid(whole))?;
        Ok(self
            .shooting
            .scaled_unknowns(state, self.shooting.parameters(at)))
    }

    /// The place of a point of a branch, as it is seen at this section.
    pub(super) fn unknowns_of(&self, point: &BranchPoint) -> Result<DVector<f64>, MotionError> {
        let plain = self.with_turn(0.0);
        let at = plain
            .shooting
            .scaled_unknowns(point.state(), [point.parameter]);
        match self.shooting.turn {
            0.0 => Ok(at),
            turn => plain.carry_unknowns(&at, turn),
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
