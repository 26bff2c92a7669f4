//! Derivatives of the outputs along a direction: exact, but by differences of steps gone through again along the inputs
//! that lead the drive.

use softstop::{Perturbation, Sensitivity};
use softstop_fmi::variable::Scaled;
use softstop_fmi::{Events, Known, Outcome, Unit, slope};

use crate::machine::Machine;
use crate::signal;
use crate::start::slot;

/// Width of the first differences, as a share of what leads the drive.
const WIDTH: f64 = 1e-3;

/// What a direction of change at the beginning of the last step brings.
#[derive(Debug)]
pub struct Tangent {
    /// Derivatives along the part of the direction that is no input of the drive.
    pub(crate) exact: Sensitivity,
    pub(crate) machine: Machine,
    /// Derivative of the force of the drive in N by its amplitude, of the present state.
    pub(crate) drive_force: f64,
    /// Inputs of the drive over the step, with their seeds.
    rest: Vec<(usize, f64)>,
}

impl Tangent {
    pub(crate) fn new(machine: &Machine, direction: &[(Known, f64)]) -> Outcome<Self> {
        let mass = machine.simulation().scene().mass;
        // Of a direction of the present state all parts are.
        let is_present = (direction.iter()).any(|(known, _)| matches!(known, Known::State(_)));
        let drive = machine.more.drive.as_deref();
        let (mut by, mut drive_force, mut rest) = (Perturbation::default(), 0.0, Vec::new());
        for &(known, seed) in direction {
            match known {
                Known::Signal(signal::FORCE) => by.force += seed,
                Known::Signal(signal::BASE) => by.force -= mass * seed,
                Known::Signal(number) if !is_present => rest.push((number, seed)),
                Known::Signal(signal::AMPLITUDE) => {
                    let drive = drive.filter(|drive| drive.takes_amplitude);
                    let angle = drive.map(|drive| drive.angle_at(machine.time()));
                    drive_force += angle.map_or(0.0, |angle| seed * angle.cos());
                }
                // It turns from now on only.
                Known::Signal(_) => {}
                Known::Parameter(slot::INITIAL_POSITION) | Known::State(0) => by.position += seed,
                // A mass that is held stays at rest.
                Known::State(_) if machine.is_held() => {}
                Known::Parameter(_) | Known::State(_) => by.velocity += seed,
            }
        }
        by.force += drive_force;
        rest.retain(|(_, seed)| drive.is_some() && *seed != 0.0);
        let exact = match &machine.more.origin {
            Some(origin) => machine.sensitivity_in_pieces(origin, &by)?,
            None => machine.sensitivity(&by)?,
        };
        Ok(Self {
            exact,
            machine: machine.clone(),
            drive_force,
            rest,
        })
    }

    /// The derivative of an output.
    pub(crate) fn along(&self, exact: fn(&Self) -> f64, output: Scaled<Machine>) -> f64 {
        exact(self) + self.machine.difference(&self.rest, output)
    }
}

impl Machine {
    /// The exact derivatives over a stretch under one harmonic drive.
    fn sensitivity(&self, by: &Perturbation) -> Outcome<Sensitivity> {
        let (simulation, external) = (self.simulation(), &self.more.external);
        let force = external.at(simulation.time_of_checkpoint(), simulation.scene().mass);
        Ok(simulation.sensitivity(by, &force)?)
    }

    /// The exact derivatives over a step that began as `origin` and was taken in pieces.
    fn sensitivity_in_pieces(&self, origin: &Self, by: &Perturbation) -> Outcome<Sensitivity> {
        let mut sum = Sensitivity::default();
        (sum.position, sum.velocity) = (by.position, by.velocity);
        let mut add = |machine: &Self| {
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
            let kept = machine.more.contacts.as_deref().copied();
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
        self.go_again(&mut origin.clone(), &mut add)?;
        Ok(sum)
    }

    /// The derivative of an output along inputs of the drive.
    fn difference(&self, direction: &[(usize, f64)], (value, nominal): Scaled<Self>) -> f64 {
        let width = |&(number, seed): &(usize, f64)| WIDTH * self.scale(number) / seed.abs();
        let width = direction.iter().map(width).fold(f64::INFINITY, f64::min);
        if width == f64::INFINITY {
            return 0.0;
        }
        let story = |machine: &Self| {
            let of = machine.contacts();
            (machine.phase(), of.impacts, of.pierced)
        };
        // Energies and contacts count from the beginning of the last step.
        let Ok(unmoved) = self.repeated(direction, 0.0) else {
            return f64::NAN;
        };
        let here = value(&unmoved);
        slope(here, nominal, width, |step| {
            let machine = self.repeated(direction, step).ok()?;
            let there = value(&machine);
            (there == here || story(&machine) == story(&unmoved)).then_some(there)
        })
    }

    /// How much of an input of the drive is much.
    fn scale(&self, number: usize) -> f64 {
        let (scene, of) = (self.simulation().scene(), self.sample());
        let rate = scene.excitation.frequency.abs();
        let length = of.position.abs() + of.velocity.abs() / rate;
        let length = if length > 0.0 { length } else { 1.0 };
        match number {
            signal::SPEED => rate,
            _ => scene.mass * rate * rate * length,
        }
    }

    /// The last step again, under inputs of the drive that were moved by `step` along a direction.
    fn repeated(&self, direction: &[(usize, f64)], step: f64) -> Outcome<Self> {
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
            let halt = self.simulation().is_at_crossing().then_some(end);
            machine.go_to(end, halt, &mut Events::default())?;
        }
        Ok(machine)
    }
}
