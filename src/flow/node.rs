//! From node to node: a course is scanned window by window.

use super::course::{Course, Form};
use super::place::{Drive, Node};

/// Windows counted from one origin.
const MOST_WINDOWS: u32 = 1 << 31;
/// Windows passed by rotation before a node is evaluated afresh.
const ROTATIONS: u32 = 8;

/// Ratio of the long window to the usual one from which it is worth asking whether it can be used.
const LONG: f64 = 4.0;
/// Free motion, relative to the whole, that counts as none.
const SETTLED: f64 = 16.0 * f64::EPSILON;

impl Course {
    /// The departure as a node.
    pub fn start(&self) -> Node {
        let deviation = match self.form {
            Form::Particular { deviation, .. } => (deviation.x, deviation.y),
            _ => (0.0, 0.0),
        };
        Node {
            elapsed: 0.0,
            position: self.departure.position,
            velocity: self.departure.velocity,
            drive: self.departure.drive,
            deviation,
            origin: 0.0,
            windows: 0,
        }
    }

    /// The node at `elapsed`, evaluated afresh.
    pub fn node(&self, elapsed: f64) -> Node {
        let turn = Drive::at(self.flow.frequency * elapsed);
        let drive = self.departure.drive.turned(turn);
        let (position, velocity) = self.at(elapsed, drive);
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
