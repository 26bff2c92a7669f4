//! Detection of what lies on one step of a branch: special points, ends.

use std::cell::RefCell;

use nalgebra::DVector;

use super::arclength::{Ends, Equations, Node};
use super::face::SwitchingSurface;
use super::follow::Continuation;
use super::grazing_test::GrazingTest;
use super::locate::{CurveCubic, along_chord, locate_zero};
use super::period_map::PeriodMap;
use super::point::{BranchEnd, BranchLimits, BranchPoint, GrazingTouch, SpecialKind, SpecialPoint};
use super::test_function::TestFunction;
use crate::orbit::OrbitError;
use crate::tolerance::{DIFFERENCE_WIDTH, NEAR};
use softstop::internals::highest_point;

/// Crossings of a face that come or go with one touch at most: onto it and back.
const MAX_TOUCH_CROSSINGS: usize = 2;
/// Share of a step over which a test is taken to be straight.
const STRAIGHT_SHARE: f64 = 0.02;

impl Continuation<'_> {
    /// The end of the range beyond which a step leads, and whether the step begins there, or beyond it by rounding.
    pub(super) fn bound_passed(
        &self,
        (from, to): Ends<'_, PeriodMap>,
        limits: &BranchLimits,
    ) -> Option<(f64, bool)> {
        let (low, high) = limits.range;
        let [before, now] = [from, to].map(|node| self.shooting.parameters(&node.at)[0]);
        let bound = now.clamp(low, high);
        let is_at = (before - bound) * (now - bound) >= 0.0;
        (bound != now).then_some((bound, is_at))
    }

    /// The orbit at the end of the range that a node has reached.
    pub(super) fn bound_at(
        &self,
        node: &Node<PeriodMap>,
        limits: &BranchLimits,
    ) -> Option<Node<PeriodMap>> {
        let (low, high) = limits.range;
        let state = self.shooting.state_at(&node.at);
        let reached = |bound: &f64| {
            let at = self.shooting.scaled(state, [*bound]);
            (at - &node.at).norm() < self.settings.border_distance
        };
        let bound = [low, high].into_iter().find(reached)?;
        let found = self.correct_start(bound, state).ok()?;
        let events = |node: &Node<PeriodMap>| node.here.point.sequence.event_counts();
        (events(&found) == events(node)).then_some(found)
    }

    /// The special points on a step of a branch, in their order.
    pub(super) fn specials_on_step(
        &self,
        (from, to): Ends<'_, PeriodMap>,
    ) -> Result<Vec<SpecialPoint>, OrbitError> {
        let mut found = Vec::new();
        let (a, b) = (&from.here.point, &to.here.point);
        for test in TestFunction::ALL {
            if test.passes_zero(&a.monodromy, &b.monodromy) {
                if test == TestFunction::Fold
                    && let Some(pitchfork) = self.pitchfork_on_step((from, to))?
                {
                    found.push(pitchfork);
                    continue;
                }
                found.push(self.locate_critical((from, to), test)?);
            }
        }
        found.extend(self.flips_there_and_back((from, to))?);
        found.extend(self.grazes_on_step((from, to))?);
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(found.into_iter().map(|(_, special)| special).collect())
    }

    /// The special point between two nodes at which a test vanishes, and its share of the way.
    fn locate_critical(
        &self,
        ends: Ends<'_, PeriodMap>,
        test: TestFunction,
    ) -> Result<(f64, SpecialPoint), OrbitError> {
        let value = |node: &Node<PeriodMap>| test.scaled_value(&node.here.point.monodromy);
        let (node, share) = locate_zero(&self.shooting, ends, value)?;
        let (kind, point) = (SpecialKind::Critical(test), self.point_at(&node)?);
        Ok((share, SpecialPoint { kind, point }))
    }

    /// The two flips of a step on which a multiplier passes -1 and comes back.
    fn flips_there_and_back(
        &self,
        (from, to): Ends<'_, PeriodMap>,
    ) -> Result<Vec<(f64, SpecialPoint)>, OrbitError> {
        let Some((share, middle)) = self.node_beyond_flips((from, to))? else {
            return Ok(Vec::new());
        };
        let halves = [(from, &middle, 0.0, share), (&middle, to, share, 1.0)];
        let flips = halves.map(|(from, to, begins, ends)| {
            let (own, special) = self.locate_critical((from, to), TestFunction::Flip)?;
            Ok((begins + own * (ends - begins), special))
        });
        flips.into_iter().collect()
    }

    /// A node of a step, and its share of the way, where a multiplier has passed -1 from either side of it and not yet come
    /// back: in narrow windows of frequency. Either the multipliers meet on the negative real axis and part in the other sense,
    /// or the test approaches zero at first and leaves it at last, so steeply that its tangents meet beyond zero.
    pub(super) fn node_beyond_flips(
        &self,
        (from, to): Ends<'_, PeriodMap>,
    ) -> Result<Option<(f64, Node<PeriodMap>)>, OrbitError> {
        let value =
            |node: &Node<PeriodMap>| TestFunction::Flip.scaled_value(&node.here.point.monodromy);
        let [a, b] = [from, to].map(|node| &node.here.point.monodromy);
        let side = value(from).signum();
        let value = |node: &Node<PeriodMap>| side * value(node);
        let (begins, ends) = (value(from), value(to));
        if a.trace() > 0.0 || begins.min(ends) <= 0.0 {
            return Ok(None);
        }
        let turns_over = a.m12 * b.m12 < 0.0 || a.m21 * b.m21 < 0.0;
        if !turns_over && begins.min(ends) > self.settings.max_test_change {
            return Ok(None);
        }
        let cubic = CurveCubic::between(&self.shooting, (from, to))?;
        let dips = || -> Result<bool, OrbitError> {
            let falls = (begins - value(&cubic.node_at(STRAIGHT_SHARE)?)) / STRAIGHT_SHARE;
            let rises = (ends - value(&cubic.node_at(1.0 - STRAIGHT_SHARE)?)) / STRAIGHT_SHARE;
            // begins - falls s = ends - rises (1 - s)
            let meet = (begins - ends + rises) / (falls + rises);
            Ok(falls > 0.0 && rises > 0.0 && begins < falls * meet)
        };
        match turns_over || dips()? {
            true => Ok(find_negative(&cubic, value)),
            false => Ok(None),
        }
    }

    /// The grazings on a step where the branch goes on, which is halved until they make the whole difference.
    fn grazes_on_step(
        &self,
        (from, to): Ends<'_, PeriodMap>,
    ) -> Result<Vec<(f64, SpecialPoint)>, OrbitError> {
        let sequences = [from, to].map(|node| node.here.point.sequence);
        let [a, b] = sequences.map(|sequence| sequence.crossing_count());
        let [before, after] = sequences.map(|sequence| (sequence.faces, sequence.reversals));
        if a == b && before == after {
            return Ok(Vec::new());
        }
        let touches_of_faces = SwitchingSurface::ALL.map(|face| {
            let [a, b] = [before, after].map(|(faces, _)| faces[face as usize]);
            a.abs_diff(b).div_ceil(MAX_TOUCH_CROSSINGS)
        });
        let touches: usize = touches_of_faces.iter().sum();
        let is_whole = |graze: &GrazingTouch| {
            let own = match graze.is_symmetric {
                true => touches,
                false => touches_of_faces[graze.face as usize],
            };
            own == touches
                && touches <= 1 + usize::from(graze.is_symmetric)
                && graze.crossings == a.min(b)
        };
        let (found, is_whole) = self.grazes_of_ends((from, to), 0.0, is_whole)?;
        let least = (4.0 * f64::EPSILON * to.at.norm()).max(self.settings.smallest_step);
        if is_whole || before == after || (&to.at - &from.at).norm() < least {
            return Ok(found);
        }
        let middle = CurveCubic::between(&self.shooting, (from, to))?.node_at(0.5)?;
        let mut grazes = Vec::new();
        for (begins, half) in [(0.0, (from, &middle)), (0.5, (&middle, to))] {
            let found = self.grazes_on_step(half)?;
            let shares = found
                .into_iter()
                .map(|(share, special)| (begins + 0.5 * share, special));
            grazes.extend(shares);
        }
        Ok(grazes)
    }

    /// The grazing orbits that Newton's method reaches from either of two nodes, between them or within as many of their distances
    /// beyond: the one that accounts for all crossings by which they differ, and true, or the first of each face, and false.
    pub(super) fn grazes_of_ends(
        &self,
        (from, to): Ends<'_, PeriodMap>,
        beyond: f64,
        is_whole: impl Fn(&GrazingTouch) -> bool,
    ) -> Result<(Vec<(f64, SpecialPoint)>, bool), OrbitError> {
        let way = &to.at - &from.at;
        let mut found: Vec<(f64, SpecialPoint)> = Vec::new();
        let mut faces = Vec::new();
        for node in [from, to] {
            for special in GrazingTest::of_node(&self.shooting, node).grazing_orbits(&self.shooting)
            {
                let SpecialKind::Grazing(mut graze) = special.kind else {
                    continue;
                };
                let at = self.place_of(&special.point)?;
                let (share, off) = along_chord((&from.at, &way), &at);
                if !(-beyond..=1.0 + beyond).contains(&share) || off > beyond.max(1.0) * way.norm()
                {
                    continue;
                }
                graze.dies = from.here.point.impacts.len() > graze.impacts;
                let special = SpecialPoint {
                    kind: SpecialKind::Grazing(graze),
                    ..special.clone()
                };
                if is_whole(&graze) {
                    return Ok((vec![(share, special)], true));
                }
                if !faces.contains(&graze.face) {
                    faces.push(graze.face);
                    found.push((share, special));
                }
                // Past a corner the steps that follow find the others.
                if beyond > 0.0 {
                    break;
                }
            }
        }
        Ok((found, false))
    }

    /// The flip at which an orbit becomes one of half as many periods, or the pitchfork at which it becomes symmetric,
    /// and why the branch ends there, if it does on a step: half the period leads to the other side of it.
    pub(super) fn merging_point(
        &self,
        (from, to): Ends<'_, PeriodMap>,
    ) -> Result<Option<(BranchPoint, BranchEnd)>, OrbitError> {
        let periods = self.shooting.periods;
        let is_even = periods.is_multiple_of(2);
        let (Some(a), Some(b)) = (self.merging_gap(from), self.merging_gap(to)) else {
            return Ok(None);
        };
        if a.dot(&b) >= 0.0 && b.norm() > NEAR * a.norm() {
            return Ok(None);
        }
        let share = a.norm() / (a.norm() + b.norm());
        let way = &to.at - &from.at;
        let at = &from.at + share * &way;
        // Where an impact passes drive angle phi the gaps change their sides, too: what is found then lies elsewhere.
        let is_near = |place: &DVector<f64>| (place - &at).norm() <= way.norm();
        if !is_even {
            let node = self.pitchfork(&at).ok().filter(|it| is_near(&it.at));
            let point = node.and_then(|node| self.point_at(&node).ok());
            return Ok(point.map(|point| (point, BranchEnd::Symmetric)));
        }
        let continuation = self.over_periods(periods / 2);
        let [parameter] = self.shooting.parameters(&at);
        let found = continuation
            .find_point(parameter, self.shooting.state_at(&at))
            .and_then(|near| continuation.locate(&near, TestFunction::Flip));
        let beside = |flip: &BranchPoint| self.place_of(flip).is_ok_and(|place| is_near(&place));
        let Some(flip) = found.ok().filter(beside) else {
            // Right beside grazing Newton's method does not settle on the flip: the gap vanishes there nevertheless.
            let left = |node: &Node<PeriodMap>| self.merging_gap(node).map(|gap| gap.dot(&a));
            let value = |node: &Node<PeriodMap>| left(node).unwrap_or(f64::NAN);
            let Ok((node, _)) = locate_zero(&self.shooting, (from, to), value) else {
                return Ok(None);
            };
            let gap = self.merging_gap(&node);
            if gap.is_none_or(|gap| gap.norm() >= NEAR * a.norm().max(b.norm())) {
                return Ok(None);
            }
            // So it does on the orbit without the touch.
            return match node.here.point.sequence == from.here.point.sequence {
                true => Ok(Some((self.point_at(&node)?, BranchEnd::Merged))),
                false => Err(OrbitError::LOST),
            };
        };
        let twice = BranchPoint {
            impacts: flip.impacts.repeat(2),
            monodromy: flip.monodromy.squared(),
            ..flip
        };
        Ok(Some((twice, BranchEnd::Merged)))
    }

    /// Scaled gap that closes where an orbit merges: from a state to that after half the periods, or to its mirror image; none
    /// where there is neither.
    pub(super) fn merging_gap(&self, node: &Node<PeriodMap>) -> Option<DVector<f64>> {
        let periods = self.shooting.periods;
        if !periods.is_multiple_of(2) {
            return self.mirror_gap(node);
        }
        let half = node.here.point.trajectory.at_cycle(periods / 2);
        let way = half - self.shooting.state_at(&node.at);
        Some(self.shooting.scaled(way, [0.0]))
    }
}

/// A node on a step, with its share of the way, at which a test is negative that is positive at both ends.
fn find_negative<E: Equations>(
    cubic: &CurveCubic<'_, E>,
    value: impl Fn(&Node<E::Point>) -> f64,
) -> Option<(f64, Node<E::Point>)> {
    let found = RefCell::new(None);
    let depth = |share: f64| {
        let node = match found.borrow().is_some() {
            true => None,
            false => cubic.node_at(share).ok(),
        };
        let depth = node.as_ref().map_or(f64::NEG_INFINITY, |node| -value(node));
        if depth > 0.0 {
            found.replace(node.map(|node| (share, node)));
        }
        depth
    };
    highest_point(0.0, 1.0, DIFFERENCE_WIDTH, depth);
    found.into_inner()
}
