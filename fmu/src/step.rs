//! How the machine takes its inputs, and goes on.

use std::mem;
use std::ops::ControlFlow;

use softstop::internals::{Polynomial, budget};
use softstop::{Crossing, Effort, MotionError, Observer, Simulation};
use softstop_fmi::{Advance, Derivatives, Events, Outcome};

use crate::drive::Drive;
use crate::machine::{Machine, More};
use crate::signal;

/// Work that one step may cost, all together: half a million crossings, about a second. A step that would take longer
/// is carried out in part, so that no importer waits for ever.
const EFFORT: Effort = Effort::windows(1 << 25);
/// Work after which a step ends in the middle of the search for a crossing, where none can be carried out in part.
const BACKSTOP: u64 = 1 << 27;
/// Pieces of a drive that changes its speed that one step may take, for about as long.
const MOST_PIECES: usize = 1 << 18;

/// Whether there was a crossing.
struct Passes(bool);

impl Observer for Passes {
    fn crossing(&mut self, _: &Crossing) {
        self.0 = true;
    }
}

/// Impacts and pierced strips so far.
pub(crate) struct Tally {
    impacts: u64,
    pierced: u64,
}

impl Tally {
    pub fn of(simulation: &Simulation) -> Self {
        Self {
            impacts: simulation.impact_count(),
            pierced: simulation.pierce_count(),
        }
    }

    /// Tells what has happened since, if there was an impact; how many there were.
    pub fn tell(&self, simulation: &Simulation, events: &mut Events) -> u64 {
        let impacts = simulation.impact_count() - self.impacts;
        if let Some(last) = simulation.last_impact().filter(|_| impacts > 0) {
            let pierced = simulation.pierce_count() - self.pierced;
            events.tell(|| {
                format!(
                    "impacts: {impacts}, strips pierced: {pierced}; last impact at {} s with {} m/s",
                    last.time, last.velocity
                )
            });
        }
        impacts
    }
}

impl More {
    /// All of it but what is known of the last step.
    pub(crate) fn afresh(self) -> Self {
        Self {
            contacts: None,
            is_open: false,
            ended: None,
            origin: None,
            ..self
        }
    }
}

impl Machine {
    /// A continuous input as it goes on from now.
    pub(crate) fn signal(&self, number: usize) -> Polynomial {
        let (now, drive) = (self.simulation().time(), self.more.drive.as_deref());
        let of_drive = |of: fn(&Drive, f64) -> Polynomial| {
            drive.map_or_else(Polynomial::default, |drive| of(drive, now))
        };
        match number {
            signal::FORCE => self.more.external.force_at(now),
            signal::BASE => self.more.external.base_at(now),
            signal::SPEED => of_drive(Drive::speed_at),
            _ => of_drive(Drive::amplitude_at),
        }
    }

    /// Sets it, for [`Machine::push`] to be called.
    pub(crate) fn set(&mut self, number: usize, derivatives: &Derivatives) {
        let now = self.simulation().time();
        let mass = self.simulation().scene().mass;
        let position = self.sample().position;
        let More {
            external, drive, ..
        } = &mut self.more;
        match (number, drive) {
            (signal::FORCE, _) => external.set_force(now, position, mass, *derivatives),
            (signal::BASE, _) => external.set_base(now, position, mass, *derivatives),
            (signal::SPEED, Some(drive)) if drive.takes_speed => drive.set_speed(now, *derivatives),
            (signal::AMPLITUDE, Some(drive)) if drive.takes_amplitude => {
                drive.set_amplitude(now, *derivatives);
            }
            _ => {}
        }
    }

    /// Lets the engine feel the inputs as they go on from now.
    pub(crate) fn push(&mut self) -> Outcome<()> {
        let now = self.simulation().time();
        self.push_until(now)
    }

    /// Sets the force that holds now, where the drive is followed up to a time.
    fn push_until(&mut self, until: f64) -> Outcome<()> {
        let now = self.simulation().time();
        let force = self.more.external.at(now, self.simulation().scene().mass);
        let Some(drive) = &mut self.more.drive else {
            return Ok(self.change().set_force(force.derivatives())?);
        };
        drive.count_turns(now);
        let piece = drive.piece(now, until);
        let sum = |k: usize| force.derivatives()[k] + piece.rest.derivatives()[k];
        let force: Derivatives = std::array::from_fn(sum);
        let simulation = self.change();
        let outcome = simulation.set_drive(piece.amplitude, piece.frequency, piece.angle, &force);
        outcome.map_err(|error| format!("under drive.speed and drive.amplitude: {error}").into())
    }

    /// Goes on to a time that is not in the past, or to right before the first crossing that does not happen before `halt`.
    pub(crate) fn go_to(
        &mut self,
        until: f64,
        halt: Option<f64>,
        events: &mut Events,
    ) -> Outcome<Advance<Self>> {
        let more = &mut self.more;
        if more.contacts.is_some() || more.origin.is_some() || more.ended.is_some() {
            (more.contacts, more.origin, more.ended) = (None, None, None);
        }
        more.is_open = true;
        let mut effort = EFFORT;
        if !more.drive.as_ref().is_some_and(|drive| drive.varies()) {
            return self.go_straight(until, halt, &mut effort, events);
        }
        self.more.is_open = false;
        let mut origin = Box::new(self.clone());
        origin.change().set_checkpoint();
        match self.go_in_pieces(until, halt, &mut effort, events, &mut |_| Ok(())) {
            Ok(Advance::Short { reason, .. }) => Ok(Advance::Short {
                reason,
                before: Some(origin),
            }),
            Ok(advance) => {
                self.more.origin = Some(origin);
                Ok(advance)
            }
            Err(error) => {
                *self = *origin;
                Err(error)
            }
        }
    }

    /// Lets the machine as it was before a step in pieces go through all but the last one again, which this machine can tell
    /// of, as it may have passed an event at its end or not; tells it after each piece.
    pub(crate) fn replay_to_last_piece(
        &self,
        origin: &mut Self,
        each: &mut dyn FnMut(&Self) -> Outcome<()>,
    ) -> Outcome<()> {
        let end = self.simulation().time_of_checkpoint();
        let (mut effort, mut events) = (EFFORT, Events::default());
        origin.go_in_pieces(end, None, &mut effort, &mut events, each)?;
        Ok(())
    }

    /// Goes on under a drive that changes, piece by piece; tells the machine after each one.
    fn go_in_pieces(
        &mut self,
        until: f64,
        halt: Option<f64>,
        effort: &mut Effort,
        events: &mut Events,
        each: &mut dyn FnMut(&Self) -> Outcome<()>,
    ) -> Outcome<Advance<Self>> {
        let short = |reason| {
            let before = None;
            Ok(Advance::Short { reason, before })
        };
        for _ in 0..MOST_PIECES {
            let now = self.simulation().time();
            if now >= until {
                return Ok(Advance::Arrived);
            }
            let drive = self.more.drive.as_ref();
            let end = drive.map_or(until, |drive| drive.end_of_piece(now, until));
            if end <= now {
                return short(format!(
                    "drive.speed or drive.amplitude changes faster than the time {now} s tells"
                ));
            }
            self.push_until(end)?;
            let outcome = self.go_straight(end, halt, effort, events)?;
            each(self)?;
            self.more.is_open = true;
            if matches!(outcome, Advance::Event) {
                return Ok(outcome);
            }
            self.keep_contacts();
            if matches!(outcome, Advance::Short { .. }) {
                return Ok(outcome);
            }
        }
        short(format!(
            "{MOST_PIECES} pieces of a quarter of a radian so far"
        ))
    }

    /// Goes on under a drive and an external force that the engine has as they are.
    fn go_straight(
        &mut self,
        until: f64,
        halt: Option<f64>,
        effort: &mut Effort,
        events: &mut Events,
    ) -> Outcome<Advance<Self>> {
        let external = &self.more.external;
        let force = external.varies.then(|| {
            let simulation = self.simulation();
            external.at(simulation.time(), simulation.scene().mass)
        });
        let simulation = self.change();
        let before = Tally::of(simulation);
        let mut passes = Passes(false);
        let backstop = || match halt {
            None => simulation.watch(until, effort),
            Some(halt) => simulation.watch_before(until, Some(halt), &mut (effort, &mut passes)),
        };
        let (outcome, _) = budget::run_within(BACKSTOP, backstop);
        if passes.0 {
            events.note();
        }
        let impacts = before.tell(simulation, events);
        let outcome = match outcome {
            Ok(ControlFlow::Continue(())) => Advance::Arrived,
            Ok(ControlFlow::Break(())) if simulation.is_at_crossing() => Advance::Event,
            Ok(ControlFlow::Break(())) => {
                // To go through so many contacts again would take as long.
                self.more.is_open = false;
                let before = self.simulation().before_advance();
                let machine = |before| Box::new(Self::new(before, self.more.clone().afresh()));
                Advance::Short {
                    reason: format!("{impacts} impacts so far"),
                    before: before.map(machine),
                }
            }
            // The motion has not left the point at which the step begins.
            Err(
                error @ (MotionError::Unbounded { .. }
                | MotionError::Stalled { .. }
                | MotionError::Endless { .. }
                | MotionError::OverBudget { .. }),
            ) => {
                return Ok(Advance::Short {
                    reason: error.to_string(),
                    before: Some(Box::new(self.clone())),
                });
            }
            Err(error) => return Err(error.into()),
        };
        if let Some(force) = force {
            let work = self
                .simulation()
                .work_since_checkpoint(force.derivatives())?;
            self.more.external.count(work);
        }
        Ok(outcome)
    }

    /// Takes over other parameters, all of them or none.
    pub(crate) fn retune(&mut self, scene: &softstop::Scene) -> Outcome<()> {
        if self.more.drive.is_none() && scene == self.simulation().scene() {
            return Ok(());
        }
        let before = self.clone();
        let outcome = self.take_over(scene);
        if outcome.is_err() {
            *self = before;
        }
        outcome
    }

    /// The work of tuning is not the drive's.
    fn take_over(&mut self, scene: &softstop::Scene) -> Outcome<()> {
        let (angle, _, _) = self.drive_angle();
        let supplied = |simulation: &Simulation| simulation.energy().supplied;
        let before = supplied(self.simulation());
        let mut scene = scene.clone();
        let (now, driven) = (
            self.simulation().time(),
            self.simulation().scene().excitation,
        );
        if let Some(drive) = &mut self.more.drive {
            let wanted = mem::replace(&mut scene.excitation, driven);
            scene.excitation.phase = wanted.phase;
            drive.follow(now, wanted.frequency, wanted.amplitude);
        }
        self.change().tune(&scene)?;
        let work = supplied(self.simulation()) - before;
        self.more.external.count(work);
        if self.more.drive.is_some() {
            return self.push();
        }
        let turned = angle - self.simulation().drive_angle();
        self.more.turns = (turned / std::f64::consts::TAU).round();
        Ok(())
    }
}
