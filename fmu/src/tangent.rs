//! Derivatives of the outputs along a direction: exact, but by differences of steps gone through again along the inputs
//! that lead the drive.

use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

use softstop::{Contacts, Perturbation, Sensitivity};
use softstop_fmi::variable::Scaled;
use softstop_fmi::{Events, Known, Outcome, Unit, slope};

use crate::machine::Machine;
use crate::signal;
use crate::start::slot;

/// Width of the first differences, as a share of what leads the drive.
const RELATIVE_WIDTH: f64 = 1e-3;

/// Time by which an event may miss itself as a step is gone through again, as shares of the drive period and of the time.
const EVENT_ROUNDING: (f64, f64) = (1e-12, 4.0 * f64::EPSILON);

/// What a direction of change at the beginning of the last step brings.
#[derive(Debug)]
pub struct Tangent {
    /// Derivatives along the part of the direction that is no input of the drive.
    pub(crate) exact: Sensitivity,
    pub(crate) machine: Machine,
    /// Derivative of the force of the drive in N by its amplitude, of the present state.
    pub(crate) drive_force_change: f64,
    /// Inputs of the drive over the step, with their seeds.
    rest: Vec<(usize, f64)>,
    /// The last step gone through again along these, by width and shift of its end.
    repetitions: RefCell<HashMap<[u64; 2], Option<Rc<Machine>>>>,
}

impl Tangent {
    pub(crate) fn new(machine: &Machine, direction: &[(Known, f64)]) -> Outcome<Self> {
        let mass = machine.simulation().scene().mass;
        // Of a direction of the present state all parts are.
        let is_present = (direction.iter()).any(|(known, _)| matches!(known, Known::State(_)));
        let drive = machine.more.drive.as_deref();
        let (mut by, mut drive_force_change, mut rest) = (Perturbation::default(), 0.0, Vec::new());
        for &(known, seed) in direction {
            match known {
                Known::Signal(signal::FORCE) => by.force += seed,
                Known::Signal(signal::BASE) => by.force -= mass * seed,
                Known::Signal(number) if !is_present => rest.push((number, seed)),
                Known::Signal(signal::AMPLITUDE) => {
                    let drive = drive.filter(|drive| drive.takes_amplitude);
                    let angle = drive.map(|drive| drive.angle_at(machine.time()));
                    drive_force_change += angle.map_or(0.0, |angle| seed * angle.cos());
                }
                // It turns from now on only.
                Known::Signal(_) => {}
                Known::Parameter(slot::INITIAL_POSITION) | Known::State(0) => by.position += seed,
                // A mass that is held stays at rest.
                Known::State(_) if machine.is_held() => {}
                Known::Parameter(_) | Known::State(_) => by.velocity += seed,
            }
        }
        by.force += drive_force_change;
        rest.retain(|(_, seed)| drive.is_some() && *seed != 0.0);
        let exact = match &machine.more.origin {
            Some(origin) => machine.sensitivity_in_pieces(origin, &by)?,
            None => machine.sensitivity(&by)?,
        };
        Ok(Self {
            exact,
            machine: machine.clone(),
            drive_force_change,
            rest,
            repetitions: RefCell::default(),
        })
    }

    /// The derivative of an output.
    pub(crate) fn along(&self, exact: fn(&Self) -> f64, output: Scaled<Machine>) -> f64 {
        exact(self) + self.difference(output)
    }

    /// The derivative of an output along inputs of the drive.
    fn difference(&self, (value, nominal): Scaled<Machine>) -> f64 {
        let last = &self.machine;
        let width =
            |&(number, seed): &(usize, f64)| RELATIVE_WIDTH * last.scale(number) / seed.abs();
        let width = self.rest.iter().map(width).fold(f64::INFINITY, f64::min);
        if width == f64::INFINITY {
            return 0.0;
        }
        let story = |machine: &Machine, of: &Contacts| (machine.phase(), of.impacts, of.pierced);
        let told = |machine: &Machine| story(machine, machine.contacts());
        let expected = match last.is_step_over() {
            true => story(last, &Contacts::default()),
            false => told(last),
        };
        // Energies count from the beginning of the last step. An event at its end is on the same side of that.
        let ends = [0.0, last.event_rounding()];
        let Some((unmoved, end_shift)) = ends.into_iter().find_map(|end_shift| {
            let unmoved = self.repeated(0.0, end_shift);
            Some((unmoved.filter(|of| told(of) == expected)?, end_shift))
        }) else {
            return f64::NAN;
        };
        let here = value(&unmoved);
        slope(here, nominal, width, |step| {
            let machine = self.repeated(step, end_shift)?;
            let there = value(&machine);
            (there == here || told(&machine) == expected).then_some(there)
        })
    }

    /// The last step gone through again, once for all outputs.
    fn repeated(&self, step: f64, end_shift: f64) -> Option<Rc<Machine>> {
        let mut repetitions = self.repetitions.borrow_mut();
        let repetition = repetitions.entry([step, end_shift].map(f64::to_bits));
        let again = || self.machine.repeated(&self.rest, step, end_shift).ok();
        repetition.or_insert_with(|| again().map(Rc::new)).clone()
    }
}

impl Machine {
    /// The exact derivatives over a stretch under one harmonic drive.
    fn sensitivity(&self, by: &Perturbation) -> Outcome<Sensitivity> {
        let (simulation, external) = (self.simulation(), &self.more.external);
        let force = external.at(simulation.time_of_checkpoint(), simulation.scene().mass);
        Ok(simulation.sensitivity(by, force.derivatives())?)
    }

    /// The exact derivatives over a step that began as `origin` and was taken in pieces.
    fn sensitivity_in_pieces(&self, origin: &Self, by: &Perturbation) -> Outcome<Sensitivity> {
        let mut sum = Sensitivity::default();
        (sum.position, sum.velocity) = (by.position, by.velocity);
        let mut add = |before: &Self, machine: &Self| {
            let by = Perturbation {
                position: sum.position,
                velocity: sum.velocity,
                ..*by
            };
            let mut next = machine.sensitivity(&by)?;
            next.supplied += sum.supplied;
            next.dissipated += sum.dissipated;
            next.impulse += sum.impulse;
            next.work += sum.work;
            let kept = before.more.contacts.as_deref().copied();
            let (kept, piece) = (kept.unwrap_or_default(), machine.simulation().contacts()?);
            if piece.impacts == 0 {
                next.impact_time = sum.impact_time;
                next.impact_velocity = sum.impact_velocity;
            }
            if kept.impacts > 0 {
                next.first = sum.first;
            }
            if kept.and(&piece).hardest == kept.hardest {
                next.hardest = sum.hardest;
            }
            if piece.peak <= kept.peak {
                next.peak = sum.peak;
            }
            sum = next;
            Ok(())
        };
        let mut last = origin.clone();
        self.replay_to_last_piece(&mut last, &mut |machine| add(machine, machine))?;
        add(&last, self)?;
        Ok(sum)
    }

    /// How much of an input of the drive is much.
    fn scale(&self, number: usize) -> f64 {
        let (scene, of) = (self.simulation().scene(), self.sample());
        let rate = scene.excitation.frequency.abs();
        let length = of.position.abs() + of.velocity.abs() / rate;
        let length = if length > 0.0 { length } else { 1.0 };
        match number {
            signal::SPEED => rate,
            _ => {
                let amplitude = self.signal(signal::AMPLITUDE).value().abs();
                amplitude.max(scene.mass * rate * rate * length)
            }
        }
    }

    /// By how much in s the end of the last step is moved so that an event there stays before it, or behind it.
    fn event_rounding(&self) -> f64 {
        let simulation = self.simulation();
        let (of_period, of_time) = EVENT_ROUNDING;
        let rounding = of_period * simulation.scene().period() + of_time * simulation.time().abs();
        match simulation.is_at_crossing() {
            true => -rounding,
            false => rounding,
        }
    }

    /// The last step again, up to an end that comes `end_shift` in s later, under inputs of the drive that were moved by `step`
    /// along a direction.
    fn repeated(&self, direction: &[(usize, f64)], step: f64, end_shift: f64) -> Outcome<Self> {
        let begin = self.more.origin.as_deref().unwrap_or(self);
        let simulation = begin.simulation().at_checkpoint();
        let mut machine = Self::new(simulation, begin.more.clone().afresh());
        for &(number, seed) in direction {
            let mut signal = *machine.signal(number).derivatives();
            signal[0] += step * seed;
            machine.set(number, &signal);
        }
        machine.push()?;
        let end = self.simulation().time();
        if end > machine.simulation().time() {
            let end = end + end_shift;
            let halt = self.simulation().is_at_crossing().then_some(end);
            machine.go_to(end, halt, &mut Events::default())?;
        }
        Ok(machine)
    }
}
