//! Detection of what lies on one step of a branch: special points, ends.

use std::cell::RefCell;

use super::chord_and_cubic::CurveCubic;
use super::equations::{CurveNode, Equations, StepEnds};
use super::locate_zero::locate_zero;
use super::period_map::PeriodMap;
use super::{
    Continuation, GrazingTouch, SpecialKind, SpecialPoint, SwitchingSurface, TestFunction,
};
use crate::orbit::OrbitError;
use crate::tolerance::DIFFERENCE_WIDTH;
use softstop::internals::highest_point;

/// Crossings of a surface that come or go with one touch at most: onto it and back.
const MAX_TOUCH_CROSSINGS: usize = 2;
/// Share of a step over which a test is taken to be straight.
const STRAIGHT_SHARE: f64 = 0.02;

impl Continuation<'_> {
    /// The special points on a step of a branch, in their order.
    pub(super) fn specials_on_step(
        &self,
        (from, to): StepEnds<'_, PeriodMap>,
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
        found.extend(self.flip_pair_on_step((from, to))?);
        found.extend(self.grazings_on_step((from, to))?);
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(found.into_iter().map(|(_, special)| special).collect())
    }

    /// The special point between two nodes at which a test vanishes, and its share of the way.
    fn locate_critical(
        &self,
        ends: StepEnds<'_, PeriodMap>,
        test: TestFunction,
    ) -> Result<(f64, SpecialPoint), OrbitError> {
        let value = |node: &CurveNode<PeriodMap>| test.scaled_value(&node.here.point.monodromy);
        let (node, share) = locate_zero(&self.shooting, ends, value)?;
        let (kind, point) = (SpecialKind::Critical(test), self.point_at(&node)?);
        Ok((share, SpecialPoint { kind, point }))
    }

    /// The two flips of a step on which a multiplier passes -1 and comes back.
    fn flip_pair_on_step(
        &self,
        (from, to): StepEnds<'_, PeriodMap>,
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
        (from, to): StepEnds<'_, PeriodMap>,
    ) -> Result<Option<(f64, CurveNode<PeriodMap>)>, OrbitError> {
        let value = |node: &CurveNode<PeriodMap>| {
            TestFunction::Flip.scaled_value(&node.here.point.monodromy)
        };
        let [a, b] = [from, to].map(|node| &node.here.point.monodromy);
        let side = value(from).signum();
        let value = |node: &CurveNode<PeriodMap>| side * value(node);
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
            true => Ok(find_negative_value(&cubic, value)),
            false => Ok(None),
        }
    }

    /// The grazings on a step where the branch goes on, which is halved until they make the whole difference.
    fn grazings_on_step(
        &self,
        (from, to): StepEnds<'_, PeriodMap>,
    ) -> Result<Vec<(f64, SpecialPoint)>, OrbitError> {
        let counts = [from, to].map(|node| node.here.point.counts);
        let [a, b] = counts.map(|counts| counts.crossing_count());
        let [before, after] = counts.map(|counts| (counts.by_surface, counts.reversals));
        if a == b && before == after {
            return Ok(Vec::new());
        }
        let touches_of_surfaces = SwitchingSurface::ALL.map(|surface| {
            let [a, b] = [before, after].map(|(by_surface, _)| by_surface[surface as usize]);
            a.abs_diff(b).div_ceil(MAX_TOUCH_CROSSINGS)
        });
        let touches: usize = touches_of_surfaces.iter().sum();
        let is_whole = |graze: &GrazingTouch| {
            let own = match graze.is_symmetric {
                true => touches,
                false => touches_of_surfaces[graze.surface as usize],
            };
            own == touches
                && touches <= 1 + usize::from(graze.is_symmetric)
                && graze.crossings == a.min(b)
        };
        let (found, is_whole) = self.grazings_near_step((from, to), 0.0, is_whole)?;
        let least = (4.0 * f64::EPSILON * to.at.norm()).max(self.settings.smallest_step);
        if is_whole || before == after || (&to.at - &from.at).norm() < least {
            return Ok(found);
        }
        let middle = CurveCubic::between(&self.shooting, (from, to))?.node_at(0.5)?;
        let mut grazes = Vec::new();
        for (begins, half) in [(0.0, (from, &middle)), (0.5, (&middle, to))] {
            let found = self.grazings_on_step(half)?;
            let shares = found
                .into_iter()
                .map(|(share, special)| (begins + 0.5 * share, special));
            grazes.extend(shares);
        }
        Ok(grazes)
    }
}

/// A node on a step, with its share of the way, at which a test is negative that is positive at both ends.
fn find_negative_value<E: Equations>(
    cubic: &CurveCubic<'_, E>,
    value: impl Fn(&CurveNode<E::Point>) -> f64,
) -> Option<(f64, CurveNode<E::Point>)> {
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
