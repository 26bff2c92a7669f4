//! The nodes of a scan of an arc for crossings, the windows between them, and how the scan steps from one to the next.

use serde::{Deserialize, Serialize};

use super::arc_solution::{ArcSolution, Form, widened_interval};
use super::change_near_start::change_near_start;
use super::drive_angle::DriveAngle;
use super::particular_solution::ParticularSolution;
use super::taylor_polynomials::{TaylorPolynomials, linear_forcing_series};

/// Most windows that are counted from one origin node of a scan; then the node reached becomes the origin.
const MAX_COUNTED_WINDOWS: u32 = 1 << 31;
/// Scan windows over which nodes are advanced by rotation before one is evaluated afresh, against the growth of rounding.
const WINDOWS_PER_EXACT_NODE: u32 = 8;

/// Ratio of the long scan window to the usual one from which it is worth asking whether it can be used.
const MIN_LONG_WINDOW_RATIO: f64 = 4.0;

/// A state on an arc at one of the times between which a scan for crossings proceeds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ScanNode {
    /// Time since departure in s.
    pub elapsed: f64,
    /// Position in m.
    pub position: f64,
    /// Velocity in m/s.
    pub velocity: f64,
    /// The drive angle.
    pub drive: DriveAngle,
    pub(super) deviation: (f64, f64),
    /// Scan windows are counted from here, so that their times do not drift.
    pub(super) origin: f64,
    pub(super) windows: u32,
}

/// A scan window: the nodes at its ends, with a bound on the fourth derivative of the position between them.
pub(crate) struct ScanWindow<'a> {
    pub left: &'a ScanNode,
    pub right: &'a ScanNode,
    /// Bound on the fourth derivative of the position, in m/s^4.
    pub bound: f64,
}

impl ArcSolution {
    /// The scan node at the departure.
    pub fn start_node(&self) -> ScanNode {
        let from = &self.departure;
        self.node_of_state(0.0, from.drive, (from.position, from.velocity))
    }

    /// The scan node at `elapsed`, evaluated afresh.
    pub fn node_at(&self, elapsed: f64) -> ScanNode {
        let drive = self.drive_at(elapsed);
        self.node_of_state(elapsed, drive, self.state_at(elapsed, drive))
    }

    /// The scan node of a linear law within half its reach from the departure, with the changes of position and
    /// velocity since then; none otherwise.
    pub(crate) fn node_near_start(&self, elapsed: f64) -> Option<(ScanNode, (f64, f64))> {
        if elapsed > 0.5 * self.flow.reach || !self.is_closed_form() {
            return None;
        }
        let (way, rise) = change_near_start(&self.flow, &self.departure, elapsed);
        let state = (
            self.departure.position + way,
            self.departure.velocity + rise,
        );
        let node = self.node_of_state(elapsed, self.drive_at(elapsed), state);
        Some((node, (way, rise)))
    }

    /// The scan node at `elapsed` where drive angle and state are known.
    pub(crate) fn node_of_state(
        &self,
        elapsed: f64,
        drive: DriveAngle,
        (position, velocity): (f64, f64),
    ) -> ScanNode {
        let deviation = match self.form {
            Form::Particular { particular, .. } => {
                let (x, v) = particular.state_at(elapsed, drive);
                (position - x, velocity - v)
            }
            _ => (0.0, 0.0),
        };
        ScanNode {
            elapsed,
            position,
            velocity,
            drive,
            deviation,
            origin: elapsed,
            windows: 0,
        }
    }

    /// The scan node one window on: by rotation where that is possible, evaluated afresh every few windows, so that
    /// neither times nor states drift.
    #[inline]
    pub(crate) fn next_node(&self, node: &ScanNode) -> ScanNode {
        if self.flow.long_window > MIN_LONG_WINDOW_RATIO * self.flow.window && self.is_settled(node)
        {
            return self.node_at(node.elapsed + self.flow.long_window);
        }
        let (origin, windows) = (node.origin, node.windows + 1);
        let elapsed = origin + f64::from(windows) * self.flow.window;
        let particular = match self.form {
            Form::Particular { particular, .. } if windows % WINDOWS_PER_EXACT_NODE != 0 => {
                particular
            }
            _ if windows >= MAX_COUNTED_WINDOWS => return self.node_at(elapsed),
            _ => {
                return ScanNode {
                    origin,
                    windows,
                    ..self.node_at(elapsed)
                };
            }
        };
        self.rotated_node(&particular, node)
    }

    /// The scan node one window on, by the transition matrix of a window and the turn of the drive in it.
    #[inline(always)]
    fn rotated_node(&self, particular: &ParticularSolution, node: &ScanNode) -> ScanNode {
        let (origin, windows) = (node.origin, node.windows + 1);
        let elapsed = origin + f64::from(windows) * self.flow.window;
        let (free, (y, rate)) = (&self.flow.window_modes, node.deviation);
        let deviation = (
            free.m11 * y + free.m12 * rate,
            free.m21 * y + free.m22 * rate,
        );
        let drive = node.drive.turned(self.flow.window_turn);
        let (x, v) = particular.state_at(elapsed, drive);
        ScanNode {
            elapsed,
            position: x + deviation.0,
            velocity: v + deviation.1,
            drive,
            deviation,
            origin,
            windows,
        }
    }

    /// Advances a scan node by rotation over windows that `is_clear` says have no crossing, up to `until`. Returns the
    /// right end of the first window that is not clear, with its bound; none if there is no such window, or the next
    /// node needs another evaluation.
    #[inline(never)]
    pub(crate) fn skip_clear_windows(
        &self,
        node: &mut ScanNode,
        until: f64,
        is_clear: impl Fn(&ScanWindow<'_>) -> bool,
    ) -> Option<(ScanNode, f64)> {
        let flow = &self.flow;
        let Form::Particular { particular, .. } = self.form else {
            return None;
        };
        if flow.long_window > MIN_LONG_WINDOW_RATIO * flow.window {
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
        while node.elapsed < until && !(node.windows + 1).is_multiple_of(WINDOWS_PER_EXACT_NODE) {
            let next = self.rotated_node(&particular, node);
            let ((y, rate), DriveAngle { cos, sin }) = (node.deviation, node.drive);
            let x4 = cosine * cos + sine * sin + (fourth.0 * y + fourth.1 * rate);
            let x5 = flow.frequency * (sine * cos - cosine * sin) + (fifth.0 * y + fifth.1 * rate);
            let bound = x4.abs() * most + x5.abs() * rest + driven;
            let window = ScanWindow {
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

    /// True if at a scan node the free motion has decayed to 16 roundings of the whole motion, so that long windows will do.
    fn is_settled(&self, node: &ScanNode) -> bool {
        match self.form {
            Form::Particular { particular, .. } => {
                let (y, rate) = node.deviation;
                let size = node.position.abs() + particular.offset.abs();
                self.flow.modes.amplitude_bound(y, rate) <= 16.0 * f64::EPSILON * size
            }
            Form::Responses => {
                let late = self.flow.late;
                late.is_some_and(|(_, settled)| node.elapsed >= settled)
            }
            _ => false,
        }
    }

    /// Taylor polynomials of this motion about a scan node.
    pub(crate) fn expand(&self, node: &ScanNode) -> TaylorPolynomials {
        let forcing =
            linear_forcing_series(&self.flow, node.drive, self.linear_forcing_at(node.elapsed));
        let known = self.departure.acceleration;
        let acceleration = known.filter(|_| node.elapsed == 0.0);
        let state = (node.position, node.velocity);
        let taylor = TaylorPolynomials::expand(&self.flow, state, acceleration, forcing);
        match self.is_held() {
            true => taylor.held_at(node.position),
            false => taylor,
        }
    }

    /// Bounds in m on the position from `node` to the end of time, infinite where it may grow.
    pub(crate) fn position_range(&self, node: &ScanNode) -> (f64, f64) {
        match self.form {
            Form::Held => (node.position, node.position),
            Form::Particular { particular, .. } if particular.slope == 0.0 => {
                let (y, rate) = node.deviation;
                let steady = particular.cosine.hypot(particular.sine);
                widened_interval(
                    particular.offset,
                    steady + self.flow.modes.amplitude_bound(y, rate),
                )
            }
            _ => (f64::NEG_INFINITY, f64::INFINITY),
        }
    }
}
