//! One motion along a flow, from one departure.

use std::sync::Arc;

use super::response::Responses;
use super::{Chatter, Flow, Hertz, LARGEST_LOSS, Segment, Taylor};

/// Everything a motion starts from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Departure {
    /// Position in m.
    pub position: f64,
    /// Velocity in m/s.
    pub velocity: f64,
    /// cos and sin of the drive angle.
    pub drive: (f64, f64),
    /// Constant force per mass c in m/s^2: the law's own and the external one.
    pub constant: f64,
    /// Rate r of the external force per mass in m/s^3.
    pub ramp: f64,
    /// Acceleration in m/s^2 from rest, where the phase was chosen by it: the arc then starts with
    /// this very number.
    pub acceleration: Option<f64>,
}

/// A motion's state at one time after departure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// Time since departure in s.
    pub elapsed: f64,
    /// Position in m.
    pub position: f64,
    /// Velocity in m/s.
    pub velocity: f64,
    /// cos and sin of the drive angle.
    pub drive: (f64, f64),
    pub(super) deviation: (f64, f64),
    /// Scan windows are counted from here, so that their times do not drift.
    origin: f64,
    windows: u32,
}

/// The exact motion that follows from a departure.
#[derive(Debug, Clone, PartialEq)]
pub struct Course {
    /// The flow it follows.
    pub flow: Flow,
    /// Where it started.
    pub departure: Departure,
    pub(super) form: Form,
}

/// Windows counted from one origin.
const MOST_WINDOWS: u32 = 1 << 31;
/// Windows passed by rotation before a node is evaluated afresh.
const ROTATIONS: u32 = 8;

/// Ratio of the long window to the usual one from which it is worth asking whether it can be used.
const LONG: f64 = 4.0;
/// Free motion, relative to the whole, that counts as none.
const SETTLED: f64 = 16.0 * f64::EPSILON;

/// How states are evaluated; those of a linear law beyond the reach of one Taylor polynomial.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Form {
    /// Particular solution plus the free deviation from it at departure.
    Particular {
        particular: Particular,
        deviation: (f64, f64),
    },
    /// Answers from rest, by doubling.
    Responses,
    /// The mass does not move.
    Held,
    /// One Taylor step of a nonlinear law.
    Segment(Arc<Segment>),
    /// Bounces summed.
    Chatter(Chatter),
}

/// The particular solution offset + slope t + cosine cos(angle) + sine sin(angle).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Particular {
    pub offset: f64,
    pub slope: f64,
    pub cosine: f64,
    pub sine: f64,
    frequency: f64,
}

impl Particular {
    /// With offset + slope t = (c + r t)/b - 2 a r/b^2.
    fn new(flow: &Flow, from: &Departure, (cosine, sine): (f64, f64)) -> Self {
        let b = flow.modes.stiffness;
        let slope = from.ramp / b;
        let offset = (from.constant - 2.0 * flow.modes.decay * slope) / b;
        Self {
            offset,
            slope,
            cosine,
            sine,
            frequency: flow.frequency,
        }
    }

    /// Position and velocity.
    #[inline]
    fn at(&self, elapsed: f64, (cos, sin): (f64, f64)) -> (f64, f64) {
        (
            self.offset + self.slope * elapsed + self.cosine * cos + self.sine * sin,
            self.slope + self.frequency * (self.sine * cos - self.cosine * sin),
        )
    }
}

impl Course {
    /// The motion of `flow` from `departure`.
    pub fn new(flow: Flow, departure: Departure) -> Self {
        let form = match flow.steady {
            Some(steady) if is_well_conditioned(&flow, &departure) => {
                let particular = Particular::new(&flow, &departure, steady);
                let (x, v) = particular.at(0.0, departure.drive);
                let deviation = (departure.position - x, departure.velocity - v);
                Form::Particular {
                    particular,
                    deviation,
                }
            }
            _ => Form::Responses,
        };
        Self {
            flow,
            departure,
            form,
        }
    }

    /// One step of `flow` together with a power law, from `deflection` m beyond its face.
    pub(crate) fn nonlinear(
        flow: Flow,
        hertz: &Hertz,
        departure: Departure,
        deflection: f64,
    ) -> Self {
        let segment = Segment::new(&flow, hertz, &departure, deflection);
        Self {
            flow,
            departure,
            form: Form::Segment(Arc::new(segment)),
        }
    }

    /// The last bounces on a rigid stop at the departure's position.
    pub(crate) fn chattering(flow: Flow, departure: Departure, chatter: Chatter) -> Self {
        Self {
            flow,
            departure,
            form: Form::Chatter(chatter),
        }
    }

    /// The Taylor step of a nonlinear law.
    pub(crate) fn segment(&self) -> Option<&Segment> {
        match &self.form {
            Form::Segment(segment) => Some(segment),
            _ => None,
        }
    }

    /// The bounces summed.
    pub(crate) fn chatter(&self) -> Option<&Chatter> {
        match &self.form {
            Form::Chatter(chatter) => Some(chatter),
            _ => None,
        }
    }

    /// A mass held at the departure's position while the drive turns.
    pub fn held(flow: Flow, departure: Departure) -> Self {
        Self {
            flow,
            departure,
            form: Form::Held,
        }
    }

    /// True if nothing moves.
    pub fn is_held(&self) -> bool {
        self.form == Form::Held
    }

    /// Position in m and velocity in m/s, `elapsed` >= 0 seconds after departure, when the drive
    /// stands at `drive` = (cos, sin).
    pub fn at(&self, elapsed: f64, drive: (f64, f64)) -> (f64, f64) {
        match &self.form {
            Form::Held => return (self.departure.position, 0.0),
            Form::Segment(segment) => return segment.state(elapsed),
            Form::Chatter(chatter) => {
                let (distance, velocity) = chatter.at(elapsed);
                return (self.departure.position + distance, velocity);
            }
            Form::Particular { .. } | Form::Responses => {}
        }
        if elapsed <= 0.5 * self.flow.reach {
            return self.expand(&self.start()).state(elapsed);
        }
        match self.form {
            Form::Particular {
                particular,
                deviation,
            } => {
                let (x, v) = particular.at(elapsed, drive);
                let (y, rate) = self.flow.modes.at(elapsed).apply(deviation.0, deviation.1);
                (x + y, v + rate)
            }
            _ => match self.flow.late {
                Some((steady, settled)) if elapsed >= settled => {
                    Particular::new(&self.flow, &self.departure, steady).at(elapsed, drive)
                }
                _ => self.by_responses(elapsed),
            },
        }
    }

    fn by_responses(&self, elapsed: f64) -> (f64, f64) {
        let from = &self.departure;
        let (x, v) = self
            .flow
            .modes
            .at(elapsed)
            .apply(from.position, from.velocity);
        let answers = Responses::at(&self.flow.modes, self.flow.frequency, elapsed);
        let (a, (cos, sin)) = (self.flow.amplitude, from.drive);
        let sum = |c: f64, r: f64, p: f64, q: f64| {
            from.constant * c + from.ramp * r + a * (cos * p - sin * q)
        };
        (
            x + sum(
                answers.constant.0,
                answers.ramp.0,
                answers.cosine.0,
                answers.sine.0,
            ),
            v + sum(
                answers.constant.1,
                answers.ramp.1,
                answers.cosine.1,
                answers.sine.1,
            ),
        )
    }

    /// The departure as a node.
    pub fn start(&self) -> Node {
        let deviation = match self.form {
            Form::Particular { deviation, .. } => deviation,
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
        let (sin, cos) = (self.flow.frequency * elapsed).sin_cos();
        let drive = turned(self.departure.drive, (cos, sin));
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
        let [[c, s], [dc, ds]] = self.flow.window_modes;
        let (y, rate) = node.deviation;
        let deviation = (c * y + s * rate, dc * y + ds * rate);
        let drive = turned(node.drive, self.flow.window_turn);
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

    /// Constant and ramp of the push per mass, seen from a node.
    pub(crate) fn push_at(&self, elapsed: f64) -> (f64, f64) {
        let from = &self.departure;
        (from.constant + from.ramp * elapsed, from.ramp)
    }

    /// Taylor polynomials about a node.
    pub(crate) fn expand(&self, node: &Node) -> Taylor {
        let taylor = Taylor::about(
            &self.flow,
            (node.position, node.velocity),
            node.drive,
            self.push_at(node.elapsed),
        );
        if self.is_held() {
            taylor.at_rest(node.position)
        } else {
            match self.departure.acceleration {
                Some(acceleration) if node.elapsed == 0.0 => taylor.with_acceleration(acceleration),
                _ => taylor,
            }
        }
    }

    /// Bounds on the position from `node` to the end of time (infinite where it may grow).
    pub(crate) fn position_range(&self, node: &Node) -> (f64, f64) {
        match self.form {
            Form::Held => (node.position, node.position),
            Form::Particular { particular, .. } if particular.slope == 0.0 => {
                let (y, rate) = node.deviation;
                let steady = particular.cosine.hypot(particular.sine);
                around(
                    particular.offset,
                    steady + self.flow.modes.envelope(y, rate),
                )
            }
            _ => (f64::NEG_INFINITY, f64::INFINITY),
        }
    }

    /// Bounds on the push per mass to the end of time.
    pub(crate) fn push_range(&self) -> (f64, f64) {
        if self.departure.ramp == 0.0 {
            around(self.departure.constant, self.flow.amplitude)
        } else {
            (f64::NEG_INFINITY, f64::INFINITY)
        }
    }
}

/// An interval, widened by more than the rounding of its ends.
fn around(centre: f64, radius: f64) -> (f64, f64) {
    let slack = 1e-12 * (centre.abs() + radius);
    (centre - radius - slack, centre + radius + slack)
}

/// The static deflection must not dwarf the motion it has to describe.
fn is_well_conditioned(flow: &Flow, from: &Departure) -> bool {
    let (b, w) = (flow.modes.stiffness.abs(), flow.frequency);
    let stiff = w * w <= LARGEST_LOSS * b;
    let at_rest = from.constant == 0.0 && from.ramp == 0.0;
    let small = from.position.abs().max(from.velocity.abs() / w) * LARGEST_LOSS;
    at_rest || stiff || (from.ramp == 0.0 && from.constant.abs() <= small * b)
}

/// (cos, sin) of the sum of two angles.
#[inline]
pub(crate) fn turned((cos, sin): (f64, f64), (c, s): (f64, f64)) -> (f64, f64) {
    (cos * c - sin * s, sin * c + cos * s)
}
