//! The beginning of an arc: its initial conditions, and the motion along it.

use super::motion::Motion;
use super::start::Start;
use crate::events::NextEvent;
use crate::flow::{ArcSolution, Chatter, Departure, DriveAngle, FinePosition};
use crate::phases::{Mode, PhaseId};

impl Motion {
    /// Begins an arc in this state and mode at the present start instant.
    pub(super) fn begin_arc(&mut self, state: Start, drive: DriveAngle, mode: Mode) {
        let acceleration =
            (state.velocity == 0.0).then(|| self.acceleration_at_rest(state.position, drive, mode));
        let departure = self.arc_departure(state, drive, mode, acceleration);
        self.begin_course(departure, mode, None, None);
    }

    /// The initial conditions of an arc in this state and mode: state, drive and external force.
    pub(super) fn arc_departure(
        &self,
        state: Start,
        drive: DriveAngle,
        mode: Mode,
        acceleration: Option<f64>,
    ) -> Departure {
        let constant = |phase: PhaseId| self.phases[phase].law.force;
        let law = mode.phase().map_or(0.0, constant);
        Departure {
            position: state.position,
            velocity: state.velocity,
            drive,
            forcing: self.force.on_arc().per_mass(law, self.phases.mass),
            acceleration,
        }
    }

    /// Begins an arc: sets its mode and its course (moving, held or chattering) and forgets the next event; between two steps
    /// `finer` says more sharply than the departure where the mass is.
    pub(super) fn begin_course(
        &mut self,
        departure: Departure,
        mode: Mode,
        finer: Option<FinePosition>,
        chatter: Option<Chatter>,
    ) {
        let held = &self.phases.held;
        match (mode, chatter) {
            (Mode::Moving(phase), _) => {
                let phase = &self.phases[phase];
                match (&phase.hertz, finer) {
                    (Some(hertz), finer) => {
                        let rounded = hertz.deflection(departure.position);
                        let deflection = finer.map_or(rounded, |finer| finer.deflection);
                        self.course
                            .restart_nonlinear(&phase.flow, hertz, departure, deflection);
                    }
                    (None, Some(FinePosition { low, .. })) => {
                        self.course = ArcSolution::next_step(&phase.flow, departure, low);
                    }
                    (None, None) => self.course.restart(&phase.flow, departure),
                }
            }
            (Mode::Chattering(_), Some(chatter)) => {
                self.course = ArcSolution::chattering(held, departure, chatter);
            }
            (Mode::Held(_) | Mode::Chattering(_), _) => {
                self.course = ArcSolution::held(held, departure);
            }
        }
        (self.mode, self.is_put) = (mode, false);
        self.outlook = NextEvent::ClearUntil(self.course.start_node());
    }

    /// Acceleration in m/s^2 with which a mass at rest starts in a mode: the very number by which the mode was chosen.
    pub(super) fn acceleration_at_rest(&self, position: f64, drive: DriveAngle, mode: Mode) -> f64 {
        match (self.mode, mode) {
            (Mode::Moving(_) | Mode::Chattering(_), Mode::Moving(phase)) => {
                let forcing = self.forcing_per_mass(drive);
                self.phases.acceleration(phase, position, 0.0, forcing)
            }
            // A held mass is let go in balance.
            _ => 0.0,
        }
    }
}
