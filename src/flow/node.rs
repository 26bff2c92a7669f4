//! From node to node: a course is scanned window by window.

use super::arc_solution::{ArcSolution, Form};
use super::near_start::near_start;
use super::particular::Particular;
use super::place::{Drive, Node};

/// What is known of a scan window.
pub(crate) struct Window<'a> {
    pub left: &'a Node,
    pub right: &'a Node,
    /// Bound on the fourth derivative of the position, in m/s^4.
    pub bound: f64,
}

/// Windows counted from one origin.
const MOST_WINDOWS: u32 = 1 << 31;
/// Windows passed by rotation before a node is evaluated afresh.
const ROTATIONS: u32 = 8;

/// Ratio of the long window to the usual one from which it is worth asking whether it can be used.
const LONG: f64 = 4.0;
/// Free motion, relative to the whole, that counts as none.
const SETTLED: f64 = 16.0 * f64::EPSILON;

impl ArcSolution {
    /// The departure as a node.
    pub fn start(&self) -> Node {
        let from = &self.departure;
        self.placed(0.0, from.drive, (from.position, from.velocity))
    }

    /// The node at `elapsed`, evaluated afresh.
    pub fn node(&self, elapsed: f64) -> Node {
        let drive = self.drive_at(elapsed);
        self.placed(elapsed, drive, self.at(elapsed, drive))
    }

    /// The node of a linear law within half a reach, with what position and velocity have changed by.
    pub(crate) fn node_near_start(&self, elapsed: f64) -> Option<(Node, (f64, f64))> {
        if elapsed > 0.5 * self.flow.reach || !self.is_quick() {
            return None;
        }
        let (way, rise) = near_start(&self.flow, &self.departure, elapsed);
        let state = (
            self.departure.position + way,
            self.departure.velocity + rise,
        );
        let node = self.placed(elapsed, self.drive_at(elapsed), state);
        Some((node, (way, rise)))
    }

    pub(super) fn drive_at(&self, elapsed: f64) -> Drive {
        let turn = Drive::at(self.flow.frequency * elapsed);
        self.departure.drive.turned(turn)
    }

    /// The node at `elapsed` where drive and state are known.
    pub(crate) fn placed(
        &self,
        elapsed: f64,
        drive: Drive,
        (position, velocity): (f64, f64),
    ) -> Node {
        let deviation = match self.form {
            Form::Particular { particular, .. } => {
                let (x, v) = particular.at(elapsed, drive);
                (position - x, velocity - v)
            }
            _ => (0.0, 0.0),
        };
        Node {
            elapsed,
            position,
            velocity,
            drive,
            deviation,
            origin: elapsed,
            windows: 0,
        }
    }

    /// The node one scan window on: by rotation where that is possible, evaluated afresh every few
    /// windows, so that neither times nor states drift.
    #[inline]
    pub(crate) fn next(&self, node: &Node) -> Node {
        if self.flow.long_window > LONG * self.flow.window && self.is_settled(node) {
            return self.node(node.elapsed + self.flow.long_window);
        }
        let (origin, windows) = (node.origin, node.windows + 1);
        let elapsed = origin + f64::from(windows) * self.flow.window;
        let particular = match self.form {
            Form::Particular { particular, .. } if windows % ROTATIONS != 0 => particular,
            _ if windows >= MOST_WINDOWS => return self.node(elapsed),
            _ => {
                return Node {
                    origin,
                    windows,
                    ..self.node(elapsed)
                };
            }
        };
        self.rotated(&particular, node)
    }

    /// The node one scan window on.
    #[inline(always)]
    fn rotated(&self, particular: &Particular, node: &Node) -> Node {
        let (origin, windows) = (node.origin, node.windows + 1);
        let elapsed = origin + f64::from(windows) * self.flow.window;
        let (free, (y, rate)) = (&self.flow.window_modes, node.deviation);
        let deviation = (
            free.m11 * y + free.m12 * rate,
            free.m21 * y + free.m22 * rate,
        );
        let drive = node.drive.turned(self.flow.window_turn);
        let (x, v) = particular.at(elapsed, drive);
        Node {
            elapsed,
            position: x + deviation.0,
            velocity: v + deviation.1,
            drive,
            deviation,
            origin,
            windows,
        }
    }

    /// Passes the scan windows that are reached by rotation and `is_clear` of something, up to `until`. Where one is
    /// not, it ends at its left end, and tells its right end and its bound.
    #[inline(never)]
    pub(crate) fn skip_clear_windows(
        &self,
        node: &mut Node,
        until: f64,
        is_clear: impl Fn(&Window<'_>) -> bool,
    ) -> Option<(Node, f64)> {
        let flow = &self.flow;
        let Form::Particular { particular, .. } = self.form else {
            return None;
        };
        if flow.long_window > LONG * flow.window {
            return None;
        }
        let (damping, stiffness) = (2.0 * flow.modes.decay, flow.modes.stiffness);
        // Of the free motion, y'' = -damping y' - stiffness y and so on.
        let after = |(y, rate): (f64, f64)| (-stiffness * rate, y - damping * rate);
        let fourth = after(after(after((0.0, 1.0))));
        let fifth = after(fourth);
        let square = flow.frequency * flow.frequency;
        let (cosine, sine) = (
            square * square * particular.cosine,
            square * square * particular.sine,
        );
        let (most, rest) = flow.window_bounds;
        let driven = flow.amplitude * square * square * flow.window * rest;
        while node.elapsed < until && !(node.windows + 1).is_multiple_of(ROTATIONS) {
            let next = self.rotated(&particular, node);
            let ((y, rate), Drive { cos, sin }) = (node.deviation, node.drive);
            let x4 = cosine * cos + sine * sin + (fourth.0 * y + fourth.1 * rate);
            let x5 = flow.frequency * (sine * cos - cosine * sin) + (fifth.0 * y + fifth.1 * rate);
            let bound = x4.abs() * most + x5.abs() * rest + driven;
            let window = Window {
                left: node,
                right: &next,
                bound,
            };
            if !(bound < f64::INFINITY && is_clear(&window)) {
                return Some((next, bound));
            }
            *node = next;
        }
        None
    }

    /// True if nothing is left of the free motion.
    fn is_settled(&self, node: &Node) -> bool {
        match self.form {
            Form::Particular { particular, .. } => {
                let (y, rate) = node.deviation;
                let size = node.position.abs() + particular.offset.abs();
                self.flow.modes.envelope(y, rate) <= SETTLED * size
            }
            Form::Responses => {
                let late = self.flow.late;
                late.is_some_and(|(_, settled)| node.elapsed >= settled)
            }
            _ => false,
        }
    }
}
