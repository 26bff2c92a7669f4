//! The scan of an arc for its first crossing, window by window.

use super::first_rise::{GuardPolynomial, earliest_rise};
use super::guard::Guard;
use super::guard_ends::GuardEnds;
use super::node_derivatives::NodeDerivatives;
use super::rise_verdict::{GuardPoint, RiseVerdict, judge_interval};
use super::single_rise::locate_single_rise;
use super::step_crossing::crossing_on_step;
use super::{FoundCrossing, NextEvent};
use crate::budget;
use crate::flow::{ArcSolution, ScanNode, ScanWindow};

/// Scan windows between two tests whether any guard can be reached at all on the rest of the arc.
const WINDOWS_PER_REACH_TEST: u32 = 8;

/// Searches an arc for its first crossing from `node` on, at least up to `until` seconds after departure, and charges
/// the work to the [`budget`].
///
/// The windows are laid from the departure, so the answer does not depend on how a search is
/// divided into calls. Where a budget is spent on the way, the answer means nothing.
pub fn first_crossing(
    course: &ArcSolution,
    guards: &[Guard],
    node: ScanNode,
    until: f64,
) -> NextEvent {
    let begin = node.elapsed;
    let outlook = search_arc(course, guards, node, until);
    let reached = match &outlook {
        NextEvent::Crossing(found) => found.elapsed,
        NextEvent::ClearUntil(node) | NextEvent::Unbounded(node) => node.elapsed,
        NextEvent::Ends(_) | NextEvent::Never => begin,
    };
    budget::charge(match course.taylor_step() {
        Some(_) => budget::TAYLOR_STEP,
        None => 1 + ((reached - begin) / course.flow.window) as u64,
    });
    outlook
}

/// Searches an arc for its first crossing as [`first_crossing`] does, which charges what the scanned time costs.
fn search_arc(course: &ArcSolution, guards: &[Guard], node: ScanNode, until: f64) -> NextEvent {
    if let Some(step) = course.taylor_step() {
        return crossing_on_step(step, guards, node);
    }
    if let Some(chatter) = course.chatter() {
        return NextEvent::Ends(chatter.duration);
    }
    let scan = ArcScan { course, guards };
    let window = course.flow.window;
    let watches_position = guards.iter().all(Guard::is_of_position);
    let mut node = node;
    let mut reached: Option<NodeDerivatives> = None;
    let mut tested = node.elapsed;
    while node.elapsed < until {
        if node.elapsed > tested + f64::from(WINDOWS_PER_REACH_TEST) * window {
            if scan.guards_are_out_of_reach(&node) {
                return NextEvent::Never;
            }
            tested = node.elapsed;
        }
        let mut ahead = None;
        if watches_position {
            let doubtful = course.skip_clear_windows(&mut node, until, |window| {
                scan.position_guards_stay_below(window)
            });
            if node.elapsed >= until {
                break;
            }
            if let Some((next, bound)) = doubtful {
                let (left, right) = (&node, &next);
                match scan.first_crossing_of_only_guard(&ScanWindow { left, right, bound }) {
                    Some(Some(found)) => return NextEvent::Crossing(found),
                    Some(None) => {
                        node = next;
                        continue;
                    }
                    None => ahead = Some(next),
                }
            }
        }
        budget::charge(budget::NODE_DERIVATIVES);
        let known = reached.filter(|jets| jets.node.elapsed == node.elapsed);
        let left = known.unwrap_or_else(|| NodeDerivatives::new(course, node));
        let right = NodeDerivatives::new(
            course,
            ahead.unwrap_or_else(|| course.next_node(&left.node)),
        );
        if !(right.node.position.is_finite() && right.node.velocity.is_finite()) {
            return NextEvent::Unbounded(left.node);
        }
        let span = right.node.elapsed - left.node.elapsed;
        let bounds = if span < 2.0 * window {
            course.flow.window_bounds
        } else {
            course.flow.modes.solution_bounds(span)
        };
        if (ahead.is_some() || !scan.stays_below(&left, &right, bounds))
            && let Some(found) = scan.search_by_halving(&left, &right, bounds)
        {
            return NextEvent::Crossing(found);
        }
        node = right.node;
        reached = Some(right);
    }
    NextEvent::ClearUntil(node)
}

/// The scan of an arc, window by window, for the first crossing of its guards.
struct ArcScan<'a> {
    course: &'a ArcSolution,
    guards: &'a [Guard],
}

impl ArcScan<'_> {
    fn guards_are_out_of_reach(&self, node: &ScanNode) -> bool {
        self.guards
            .iter()
            .all(|guard| guard.is_out_of_reach(self.course, node))
    }

    /// True if all guards stay below zero over a scan window; they depend on the position alone.
    #[inline(always)]
    fn position_guards_stay_below(&self, window: &ScanWindow<'_>) -> bool {
        let span = window.right.elapsed - window.left.elapsed;
        for guard in self.guards {
            let ends = GuardEnds::of_window(guard, window);
            if !ends.stay_below(span, guard.position.abs() * window.bound) {
                return false;
            }
        }
        true
    }

    /// The first crossing in a scan window of the only guard, which depends on the position alone: `Some(None)` if
    /// there is none, `None` if that takes a closer search.
    fn first_crossing_of_only_guard(
        &self,
        window: &ScanWindow<'_>,
    ) -> Option<Option<FoundCrossing>> {
        let [guard] = self.guards else {
            return None;
        };
        let &ScanWindow { left, right, bound } = window;
        let span = right.elapsed - left.elapsed;
        let size = bound + right.position + right.velocity;
        if span > self.course.flow.reach * 1.000001 || !size.is_finite() {
            return None;
        }
        let ends = GuardEnds::of_window(guard, window).points(span);
        let bound = guard.position.abs() * bound;
        let rounding = guard.rounding_at(left.position, left.velocity, 0.0);
        self.first_crossing_of_guard((0, guard), (left, right), ends, (bound, rounding))
    }

    /// The first crossing of one guard between two nodes, by its values there and bounds on its fourth derivative and
    /// its rounding: `Some(None)` if there is none, `None` if more than one rise cannot be ruled out. The guard does
    /// not depend on the forcing.
    #[inline]
    fn first_crossing_of_guard(
        &self,
        (index, guard): (usize, &Guard),
        nodes: (&ScanNode, &ScanNode),
        ends: (GuardPoint, GuardPoint),
        (bound, rounding): (f64, f64),
    ) -> Option<Option<FoundCrossing>> {
        match judge_interval(ends.0, ends.1, bound, rounding) {
            RiseVerdict::NoRise => Some(None),
            RiseVerdict::Unknown => None,
            _ => {
                let (elapsed, position, velocity) =
                    locate_single_rise(self.course, guard, nodes, ends)?;
                Some(Some(FoundCrossing {
                    elapsed,
                    guard: index,
                    position,
                    velocity,
                }))
            }
        }
    }

    /// True if a bound on the fourth derivatives, which settles most windows, proves all guards below zero between two nodes.
    #[inline(always)]
    fn stays_below(
        &self,
        left: &NodeDerivatives,
        right: &NodeDerivatives,
        bounds: (f64, f64),
    ) -> bool {
        let span = right.node.elapsed - left.node.elapsed;
        for guard in self.guards {
            let bound = left.bound_g4(&self.course.flow, guard, span, bounds);
            if !GuardEnds::new(guard, left, right).stay_below(span, bound) {
                return false;
            }
        }
        true
    }

    /// True if bounds on derivatives prove that one guard does not rise through zero between two nodes.
    fn cannot_rise(
        &self,
        guard: &Guard,
        left: &NodeDerivatives,
        right: &NodeDerivatives,
        bounds: (f64, f64),
    ) -> bool {
        let span = right.node.elapsed - left.node.elapsed;
        let ends = GuardEnds::new(guard, left, right);
        let bound = left.bound_g4(&self.course.flow, guard, span, bounds);
        self.guard_stays_below((guard, left), (&ends, bound), (span, bounds))
    }

    /// True if one guard, with its values at both ends of `span` and bounds on its second and fourth derivative, cannot
    /// rise through zero there.
    #[inline(always)]
    fn guard_stays_below(
        &self,
        (guard, left): (&Guard, &NodeDerivatives),
        (ends, bound): (&GuardEnds, f64),
        (span, bounds): (f64, (f64, f64)),
    ) -> bool {
        ends.stay_below(span, bound) || {
            let bound = left.bound_g2(&self.course.flow, guard, span, bounds);
            ends.stay_below_chord(span, bound)
                || ends.stay_at_zero(span, bound, left.guard_rounding(guard))
        }
    }

    /// The first crossing between two nodes, by halving the time between them until one Taylor polynomial reaches over it.
    #[inline(never)]
    fn search_by_halving(
        &self,
        left: &NodeDerivatives,
        right: &NodeDerivatives,
        bounds: (f64, f64),
    ) -> Option<FoundCrossing> {
        let span = right.node.elapsed - left.node.elapsed;
        let half = left.node.elapsed + 0.5 * span;
        let halves = half > left.node.elapsed && half < right.node.elapsed;
        if span <= self.course.flow.reach * 1.000001 || !halves {
            return self.search_window(left, right, bounds);
        }
        let can_rise = |guard: &Guard| !self.cannot_rise(guard, left, right, bounds);
        if !self.guards.iter().any(can_rise) {
            return None;
        }
        if !budget::charge(budget::EXACT_NODE) {
            return None;
        }
        let middle = NodeDerivatives::new(self.course, self.course.node_at(half));
        let bounds = self.course.flow.modes.solution_bounds(0.5 * span);
        self.search_by_halving(left, &middle, bounds)
            .or_else(|| self.search_by_halving(&middle, right, bounds))
    }

    /// The first crossing between two nodes that one Taylor polynomial reaches over, expanded where a guard may rise twice.
    fn search_window(
        &self,
        left: &NodeDerivatives,
        right: &NodeDerivatives,
        bounds: (f64, f64),
    ) -> Option<FoundCrossing> {
        let span = right.node.elapsed - left.node.elapsed;
        let mut first: Option<FoundCrossing> = None;
        for (index, guard) in self.guards.iter().enumerate() {
            let ends = GuardEnds::new(guard, left, right);
            let bound = left.bound_g4(&self.course.flow, guard, span, bounds);
            if self.guards.len() > 1
                && self.guard_stays_below((guard, left), (&ends, bound), (span, bounds))
            {
                continue;
            }
            let is_simple = guard.forcing == 0.0 && self.course.is_closed_form();
            let single = is_simple.then(|| {
                let (nodes, doubt) = (
                    (&left.node, &right.node),
                    (bound, left.guard_rounding(guard)),
                );
                self.first_crossing_of_guard((index, guard), nodes, ends.points(span), doubt)
            });
            let Some(rise) = single.flatten() else {
                return self.search_polynomial(left, right, bounds);
            };
            first = match (first, rise) {
                (Some(first), Some(rise)) if first.elapsed <= rise.elapsed => Some(first),
                (first, rise) => rise.or(first),
            };
        }
        first
    }

    /// The first crossing between two nodes on the Taylor polynomial about the left one.
    #[inline(never)]
    fn search_polynomial(
        &self,
        left: &NodeDerivatives,
        right: &NodeDerivatives,
        bounds: (f64, f64),
    ) -> Option<FoundCrossing> {
        budget::charge(budget::POLYNOMIAL);
        let span = right.node.elapsed - left.node.elapsed;
        let node = left.node;
        let taylor = self.course.expand(&node);
        let rise = |guard: &Guard| {
            if self.cannot_rise(guard, left, right, bounds) {
                return None;
            }
            let candidate = GuardPolynomial {
                coefficients: &guard.taylor_coefficients(&taylor),
                bound: left.bound_g4(&self.course.flow, guard, span, bounds),
                rounding: left.guard_rounding(guard),
            };
            let (left, right) = GuardEnds::new(guard, left, right).points(span);
            candidate.first_rise(left, right)
        };
        earliest_rise(self.guards, rise).map(|(guard, after)| {
            let (position, velocity) = taylor.state_after(after);
            FoundCrossing {
                elapsed: node.elapsed + after,
                guard,
                position,
                velocity,
            }
        })
    }
}
