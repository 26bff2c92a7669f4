//! Where an arc ends: the first crossing of any guard, guaranteed.
//!
//! The motion is scanned in windows. A window is passed only when a bound on the fourth derivative
//! proves that no guard rises through zero in it; otherwise it is halved down to the reach of one
//! Taylor polynomial, on which the first rise is found with a certificate. Nothing is
//! concluded from the signs at window ends alone.

mod guard;
mod isolate;
mod jets;
mod step;

pub use guard::Guard;

use serde::{Deserialize, Serialize};

use crate::flow::{Course, Node};
use isolate::Candidate;
use jets::{Ends, Jets};

/// A crossing found on a course.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// Time since departure in s.
    pub elapsed: f64,
    /// Which of the guards it is.
    pub guard: usize,
    /// Position in m.
    pub position: f64,
    /// Velocity in m/s.
    pub velocity: f64,
}

/// What is known of a course's first crossing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Outlook {
    /// It is this one.
    Crossing(Found),
    /// There is none up to the node that the search has reached.
    ClearUntil(Node),
    /// There is none up to the end of the course, this many seconds after departure.
    Ends(f64),
    /// There is none at all.
    Never,
    /// The motion left the range of floating-point numbers.
    Unbounded(Node),
}

/// Windows between two looks at whether the guards can be reached at all.
const WINDOWS_PER_LOOK: u32 = 8;

/// Searches the first crossing on `course` from `node` on, at least up to `until` seconds after
/// departure.
///
/// The windows are laid from the departure, so the answer does not depend on how a search is
/// divided into calls.
pub fn first_crossing(course: &Course, guards: &[Guard], node: Node, until: f64) -> Outlook {
    if let Some(segment) = course.segment() {
        return step::first_crossing(segment, guards, node);
    }
    if let Some(chatter) = course.chatter() {
        return Outlook::Ends(chatter.duration);
    }
    let scan = Scan { course, guards };
    let mut left = Jets::new(course, node);
    let mut windows = 0;
    while left.node.elapsed < until {
        if windows == WINDOWS_PER_LOOK && scan.is_out_of_reach(&left.node) {
            return Outlook::Never;
        }
        windows = if windows == WINDOWS_PER_LOOK {
            1
        } else {
            windows + 1
        };
        let right = Jets::new(course, course.next(&left.node));
        if !(right.node.position.is_finite() && right.node.velocity.is_finite()) {
            return Outlook::Unbounded(left.node);
        }
        let span = right.node.elapsed - left.node.elapsed;
        let bounds = if span < 2.0 * course.flow.window {
            course.flow.window_bounds
        } else {
            course.flow.modes.bounds(span)
        };
        if !scan.is_clear(&left, &right, bounds)
            && let Some(found) = scan.search(&left, &right)
        {
            return Outlook::Crossing(found);
        }
        left = right;
    }
    Outlook::ClearUntil(left.node)
}

struct Scan<'a> {
    course: &'a Course,
    guards: &'a [Guard],
}

impl Scan<'_> {
    fn is_out_of_reach(&self, node: &Node) -> bool {
        self.guards
            .iter()
            .all(|guard| guard.is_out_of_reach(self.course, node))
    }

    /// True if no guard can rise through zero between two nodes.
    #[inline]
    fn is_clear(&self, left: &Jets, right: &Jets, bounds: (f64, f64)) -> bool {
        self.guards
            .iter()
            .all(|guard| self.cannot_rise(guard, left, right, bounds))
    }

    #[inline]
    fn cannot_rise(&self, guard: &Guard, left: &Jets, right: &Jets, bounds: (f64, f64)) -> bool {
        let flow = &self.course.flow;
        let span = right.node.elapsed - left.node.elapsed;
        let ends = Ends {
            left: left.guard(guard),
            right: right.guard(guard),
        };
        ends.stay_below(span, left.bound(flow, guard, span, bounds)) || {
            let bound = left.low_bound(flow, guard, span, bounds);
            ends.stay_below_chord(span, bound)
                || ends.stay_at_zero(span, bound, left.rounding(guard))
        }
    }

    /// The first crossing between two nodes, by halving down to the reach of a Taylor polynomial.
    fn search(&self, left: &Jets, right: &Jets) -> Option<Found> {
        let span = right.node.elapsed - left.node.elapsed;
        let bounds = self.course.flow.modes.bounds(span);
        if self.is_clear(left, right, bounds) {
            return None;
        }
        if span <= self.course.flow.reach * 1.000001 {
            return self.search_polynomial(left, right, bounds);
        }
        let half = left.node.elapsed + 0.5 * span;
        if half <= left.node.elapsed || half >= right.node.elapsed {
            return self.search_polynomial(left, right, bounds);
        }
        let middle = self.course.node(half);
        let middle = Jets::new(self.course, middle);
        self.search(left, &middle)
            .or_else(|| self.search(&middle, right))
    }

    fn search_polynomial(&self, left: &Jets, right: &Jets, bounds: (f64, f64)) -> Option<Found> {
        let span = right.node.elapsed - left.node.elapsed;
        let node = left.node;
        let taylor = self.course.expand(&node);
        let rise = |guard: &Guard| {
            if self.cannot_rise(guard, left, right, bounds) {
                return None;
            }
            let candidate = Candidate {
                coefficients: &guard.polynomial(&taylor),
                bound: left.bound(&self.course.flow, guard, span, bounds),
                rounding: left.rounding(guard),
            };
            candidate.first_rise(span, (left.guard(guard), right.guard(guard)))
        };
        earliest(self.guards, rise).map(|(guard, after)| {
            let (position, velocity) = taylor.state(after);
            Found {
                elapsed: node.elapsed + after,
                guard,
                position,
                velocity,
            }
        })
    }
}

/// Which of the guards rises first, and when; of two at once the first.
fn earliest(guards: &[Guard], rise: impl Fn(&Guard) -> Option<f64>) -> Option<(usize, f64)> {
    let rises = guards.iter().map(rise).enumerate();
    rises
        .filter_map(|(index, rise)| Some((index, rise?)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
}
