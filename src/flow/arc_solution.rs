//! The exact motion of one arc, from its departure on.

use std::sync::Arc;

use nalgebra::Vector2;

use super::change_near_start::change_near_start;
use super::linear_law::MAX_DIGIT_LOSS;
use super::particular_solution::ParticularSolution;
use super::series::{derivative, value};
use super::zero_state_responses::ZeroStateResponses;
use super::{Chatter, Departure, DriveAngle, LinearLaw, PowerLaw, TaylorStep};

/// The exact motion of one arc under one law, from its departure on.
#[derive(Debug, Clone, PartialEq)]
pub struct ArcSolution {
    /// The flow it follows.
    pub flow: LinearLaw,
    /// Where it started.
    pub departure: Departure,
    pub(super) form: Form,
}

/// How an [`ArcSolution`] evaluates its states.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Form {
    /// The particular solution plus the free deviation from it at departure.
    Particular {
        particular: ParticularSolution,
        deviation: Vector2<f64>,
    },
    /// Answers from rest, by doubling.
    Responses,
    /// The mass does not move.
    Held,
    /// One Taylor step: of a nonlinear law, or under a force that is not linear in time.
    TaylorStep(Arc<TaylorStep>),
    /// Bounces summed.
    Chatter(Chatter),
}

impl Form {
    fn new(flow: &LinearLaw, departure: &Departure) -> Self {
        match flow.steady {
            _ if !departure.forcing.is_linear() => {
                Self::TaylorStep(Arc::new(TaylorStep::of_linear_law(flow, departure, 0.0)))
            }
            Some(steady) if particular_solution_is_accurate(flow, departure) => {
                let particular = ParticularSolution::new(flow, departure, steady);
                let (x, v) = particular.state_at(0.0, departure.drive);
                let deviation = Vector2::new(departure.position - x, departure.velocity - v);
                Self::Particular {
                    particular,
                    deviation,
                }
            }
            _ => Self::Responses,
        }
    }
}

impl ArcSolution {
    /// The motion of `flow` from `departure`; under a forcing of degree 2 or higher, its first Taylor step.
    pub fn new(flow: &LinearLaw, departure: Departure) -> Self {
        Self::with_form(flow, departure, Form::new(flow, &departure))
    }

    /// Replaces this motion by that of `flow` from another departure.
    pub(crate) fn restart(&mut self, flow: &LinearLaw, departure: Departure) {
        self.form = Form::new(flow, &departure);
        self.flow = *flow;
        self.departure = departure;
    }

    fn with_form(flow: &LinearLaw, departure: Departure, form: Form) -> Self {
        Self {
            flow: *flow,
            departure,
            form,
        }
    }

    /// The next Taylor step of `flow`, from a departure whose position lacks the rounding `low`.
    pub(crate) fn next_step(flow: &LinearLaw, departure: Departure, low: f64) -> Self {
        let step = TaylorStep::of_linear_law(flow, &departure, low);
        Self::with_form(flow, departure, Form::TaylorStep(Arc::new(step)))
    }

    /// Replaces this motion by one Taylor step of `flow` together with a power law, from `deflection` m beyond its face.
    pub(crate) fn restart_nonlinear(
        &mut self,
        flow: &LinearLaw,
        hertz: &PowerLaw,
        departure: Departure,
        deflection: f64,
    ) {
        let step = TaylorStep::under_power_law(flow, hertz, &departure, deflection);
        if let Form::TaylorStep(before) = &mut self.form
            && let Some(place) = Arc::get_mut(before)
        {
            *place = step;
        } else {
            self.form = Form::TaylorStep(Arc::new(step));
        }
        self.flow = *flow;
        self.departure = departure;
    }

    /// The arc of the last bounces on a rigid stop at the departure's position, summed as a geometric series.
    pub(crate) fn chattering(flow: &LinearLaw, departure: Departure, chatter: Chatter) -> Self {
        Self::with_form(flow, departure, Form::Chatter(chatter))
    }

    /// The Taylor step that this arc is; none if it has another form.
    pub(crate) fn taylor_step(&self) -> Option<&TaylorStep> {
        match &self.form {
            Form::TaylorStep(step) => Some(step),
            _ => None,
        }
    }

    /// True if this is the arc of the last bounces on a rigid stop, summed as a geometric series.
    pub fn is_chattering(&self) -> bool {
        self.chatter().is_some()
    }

    /// The sum of the last bounces that this arc is; none if it has another form.
    pub(crate) fn chatter(&self) -> Option<&Chatter> {
        match &self.form {
            Form::Chatter(chatter) => Some(chatter),
            _ => None,
        }
    }

    /// The arc of a mass held at the departure's position while the drive turns; one Taylor step under curved forcing.
    pub fn held(flow: &LinearLaw, departure: Departure) -> Self {
        let form = if departure.forcing.is_linear() {
            Form::Held
        } else {
            Form::TaylorStep(Arc::new(TaylorStep::of_held_mass(flow, &departure)))
        };
        Self::with_form(flow, departure, form)
    }

    /// True if a state of the arc at any time costs no more than a few elementary functions.
    pub(crate) fn is_closed_form(&self) -> bool {
        matches!(self.form, Form::Particular { .. })
    }

    /// True if this arc is a Taylor step, which ends at its reach.
    pub fn is_series(&self) -> bool {
        matches!(self.form, Form::TaylorStep(_))
    }

    /// True if the mass stands still on this arc.
    pub fn is_held(&self) -> bool {
        match &self.form {
            Form::Held => true,
            Form::TaylorStep(step) => step.is_still(),
            _ => false,
        }
    }

    /// Position in m and velocity in m/s of the arc, `elapsed` >= 0 seconds after departure, when the drive angle is `drive`.
    pub fn state_at(&self, elapsed: f64, drive: DriveAngle) -> (f64, f64) {
        match &self.form {
            Form::Held => return (self.departure.position, 0.0),
            Form::TaylorStep(_) if elapsed <= 0.0 => {
                return (self.departure.position, self.departure.velocity);
            }
            Form::TaylorStep(step) => return step.state_after(elapsed),
            Form::Chatter(chatter) => {
                let (distance, velocity) = chatter.state_after(elapsed);
                return (self.departure.position + distance, velocity);
            }
            Form::Particular { .. } | Form::Responses => {}
        }
        if elapsed <= 0.5 * self.flow.reach {
            let (way, rise) = change_near_start(&self.flow, &self.departure, elapsed);
            return (
                self.departure.position + way,
                self.departure.velocity + rise,
            );
        }
        match self.form {
            Form::Particular {
                particular,
                deviation,
            } => {
                let (x, v) = particular.state_at(elapsed, drive);
                let free = self.flow.modes.transition(elapsed) * deviation;
                (x + free.x, v + free.y)
            }
            _ => match self.flow.late {
                Some((steady, settled)) if elapsed >= settled => {
                    ParticularSolution::new(&self.flow, &self.departure, steady)
                        .state_at(elapsed, drive)
                }
                _ => self.state_by_responses(elapsed),
            },
        }
    }

    /// Position and velocity of the arc of a linear law by its zero-state responses.
    fn state_by_responses(&self, elapsed: f64) -> (f64, f64) {
        let (from, flow) = (&self.departure, &self.flow);
        let free = flow.modes.transition(elapsed) * Vector2::new(from.position, from.velocity);
        let answers = ZeroStateResponses::after_time(&flow.modes, flow.frequency, elapsed);
        let DriveAngle { cos, sin } = from.drive;
        let state = free
            + (from.forcing.value() * answers.constant
                + from.forcing.rate() * answers.ramp
                + flow.amplitude * (cos * answers.cosine - sin * answers.sine));
        (state.x, state.y)
    }

    /// Value in m/s^2 and rate of the arc's forcing per mass without the drive, if linear, `elapsed` seconds after departure.
    pub(crate) fn linear_forcing_at(&self, elapsed: f64) -> (f64, f64) {
        let forcing = &self.departure.forcing;
        (forcing.value() + forcing.rate() * elapsed, forcing.rate())
    }

    /// True if this motion is sure never to leave the range of floating-point numbers.
    pub(crate) fn is_bounded(&self) -> bool {
        match self.form {
            Form::Particular {
                particular: of,
                deviation: free,
            } => {
                let steady = of.offset.abs() + of.cosine.abs() + of.sine.abs();
                let size = steady + free.x.abs() + free.y.abs();
                of.slope == 0.0 && self.flow.modes.stiffness > 0.0 && size < 1e100
            }
            Form::Held | Form::Chatter(_) => true,
            Form::Responses | Form::TaylorStep(_) => false,
        }
    }

    /// Bounds in m/s^2 on the arc's forcing per mass, drive included, to the end of time: infinite if the external force changes.
    pub(crate) fn forcing_range(&self) -> (f64, f64) {
        let forcing = &self.departure.forcing;
        if forcing.rate() == 0.0 {
            widened_interval(forcing.value(), self.flow.amplitude)
        } else {
            (f64::NEG_INFINITY, f64::INFINITY)
        }
    }

    /// The forcing per mass of the arc in m/s^2, drive included, `elapsed` seconds after departure.
    pub(crate) fn forcing_at(&self, elapsed: f64) -> f64 {
        if let Form::TaylorStep(step) = &self.form {
            return step.forcing_at(step.sigma_after(elapsed));
        }
        self.linear_forcing_at(elapsed).0 + self.flow.amplitude * self.drive_at(elapsed).cos
    }

    /// The rate of the forcing per mass of a held mass in m/s^3, `elapsed` seconds after departure.
    pub(crate) fn forcing_rate_at_rest(&self, elapsed: f64) -> f64 {
        match &self.form {
            Form::TaylorStep(step) => value(&derivative(&step.forcing), elapsed),
            _ => {
                let (amplitude, w) = (self.flow.amplitude, self.flow.frequency);
                self.departure.forcing.rate() - amplitude * w * self.drive_at(elapsed).sin
            }
        }
    }

    /// The drive `elapsed` seconds after the arc's departure.
    pub(super) fn drive_at(&self, elapsed: f64) -> DriveAngle {
        let turn = DriveAngle::at(self.flow.frequency * elapsed);
        self.departure.drive.turned(turn)
    }
}

/// The interval about `centre`, widened by more than the rounding of its ends.
pub(super) fn widened_interval(centre: f64, radius: f64) -> (f64, f64) {
    let slack = 1e-12 * (centre.abs() + radius);
    (centre - radius - slack, centre + radius + slack)
}

/// True if the motion about the particular solution keeps its digits: the static deflection does not dwarf it. Else an arc takes
/// responses from rest.
fn particular_solution_is_accurate(flow: &LinearLaw, from: &Departure) -> bool {
    let (b, w) = (flow.modes.stiffness.abs(), flow.frequency);
    let stiff = w * w <= MAX_DIGIT_LOSS * b;
    let (constant, ramp) = (from.forcing.value(), from.forcing.rate());
    let at_rest = constant == 0.0 && ramp == 0.0;
    let small = from.position.abs().max(from.velocity.abs() / w) * MAX_DIGIT_LOSS;
    at_rest || stiff || (ramp == 0.0 && constant.abs() <= small * b)
}
