//! Puts a machine into states that are solved for elsewhere, under the law that holds.

use super::motion::Motion;
use super::simulation::{Checkpoint, Simulation};
use super::start::Start;
use crate::events::{FoundCrossing, Guard, NextEvent};
use crate::phases::Phase;

impl Motion {
    /// The guards that end the present law, each with its value in the present state.
    pub(super) fn guard_values(&self) -> impl Iterator<Item = (Guard, f64)> {
        let Start { position, velocity } = self.state();
        let forcing = self
            .phases
            .forcing_per_mass(self.clock.drive(self.now), &self.force());
        let guards = self.present_guards().into_owned();
        guards.into_iter().map(move |guard| {
            let value = guard.value_at(position, velocity) + guard.forcing * forcing;
            (guard, value)
        })
    }

    /// Begins an arc in a state by the law that holds, wherever that is.
    pub(super) fn begin_in_state(&mut self, state: Start) {
        let drive = self.clock.drive(self.now);
        let departure = self.arc_departure(state, drive, self.mode, None);
        let is_before_face = |phase: &&Phase| {
            let hertz = phase.hertz.as_ref();
            hertz.is_some_and(|hertz| hertz.deflection(state.position) < 0.0)
        };
        // There a power law does not press.
        let linear = self.phase().filter(is_before_face).map(|phase| phase.flow);
        match linear {
            Some(flow) => {
                self.course.restart(&flow, departure);
                self.outlook = NextEvent::ClearUntil(self.course.start_node());
            }
            None => self.begin_course(departure, self.mode, None, None),
        }
        self.is_put = true;
    }

    /// Stands before the crossing of a guard that the state has passed already.
    fn stand_before_passed_guard(&mut self) {
        let Start { position, velocity } = self.state();
        let is_passed = |&(_, (guard, value)): &(usize, (Guard, f64))| {
            let leaves = guard.velocity != 0.0 || guard.position * velocity >= 0.0;
            value > 0.0 && leaves
        };
        let passed = self.guard_values().enumerate().find(is_passed);
        if let Some((guard, _)) = passed {
            self.outlook = NextEvent::Crossing(FoundCrossing {
                elapsed: 0.0,
                guard,
                position,
                velocity,
            });
        }
    }
}

impl Simulation {
    /// Puts the mass in another state at another time in s, whatever surface lies between, where it goes on by the law that
    /// holds now. Energies go on from where they are.
    pub fn set_state(&mut self, time: f64, state: impl Into<Start>) {
        self.counts.work += self.work_under_way();
        let motion = &mut self.motion;
        let at = motion.clock.instant(time - self.epoch);
        let elapsed = motion.clock.elapsed(motion.start, at);
        motion.force.next_arc(&motion.clock, at, elapsed);
        (motion.start, motion.now) = (at, at);
        motion.begin_in_state(state.into());
        (self.now, self.checkpoint) = (time, Checkpoint::OnArc(at));
    }

    /// Goes on by the law of another machine with these phases, and stands right before the crossing that ends it where the
    /// present state lies beyond that: [`Simulation::cross`] lets it happen.
    pub fn continue_law_of(&mut self, of: &Self) {
        self.motion.mode = of.motion.mode;
        self.motion.begin_in_state(self.motion.state());
        self.motion.stand_before_passed_guard();
    }
}
