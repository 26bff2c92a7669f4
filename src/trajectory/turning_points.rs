//! The turning points of an arc.

use crate::budget;
use crate::events::{Guard, NextEvent, first_crossing};
use crate::flow::ArcSolution;

/// A turning point of an arc, where its velocity is zero.
#[derive(Debug, Clone, Copy)]
pub struct TurningPoint {
    /// True if the mass turns back, away from the stop.
    pub back: bool,
    /// Time in s since the arc began.
    pub elapsed: f64,
    /// Position in m.
    pub position: f64,
}

/// The turning points of an arc within `duration` seconds, back and forward by turns, the first one `back` or forward.
pub fn turning_points(
    course: &ArcSolution,
    duration: f64,
    back: bool,
) -> impl Iterator<Item = TurningPoint> {
    let moves = !course.is_held() && !course.is_chattering();
    let (mut node, mut back) = (course.start_node(), back);
    std::iter::from_fn(move || {
        if !moves || budget::is_spent() {
            return None;
        }
        let forward = Guard::turning_forward();
        let guard = if back { forward.negated() } else { forward };
        match first_crossing(course, &[guard], node, duration) {
            NextEvent::Crossing(found) if found.elapsed <= duration => {
                let turn = TurningPoint {
                    back,
                    elapsed: found.elapsed,
                    position: found.position,
                };
                node = course.node_at(found.elapsed);
                back = !back;
                Some(turn)
            }
            _ => None,
        }
    })
}
