//! Derivatives of the outputs along a direction: exact where the engine has them, else by differences of steps gone
//! through again.

use softstop::{Perturbation, Sensitivity};
use softstop_fmi::{Events, Known, Outcome, Unit, slope};

use crate::machine::Machine;
use crate::signal;
use crate::start::slot;

/// Width of the first differences, as a share of the motion.
const WIDTH: f64 = 1e-3;

/// The position as a state.
const POSITION: Known = Known::State(0);

/// What a direction of change at the beginning of the last step brings.
#[derive(Debug)]
pub struct Tangent {
    exact: Sensitivity,
    machine: Machine,
    /// The whole direction, and the part of it that `exact` leaves out.
    whole: Vec<(Known, f64)>,
    rest: Vec<(Known, f64)>,
}

impl Tangent {
    pub(crate) fn new(machine: &Machine, direction: &[(Known, f64)]) -> Outcome<Self> {
        let mass = machine.simulation().scene().mass;
        let is_state = |(known, _): &&(Known, f64)| matches!(known, Known::State(_));
        let mut by = Perturbation::default();
        // Of a direction of the present state all parts know it.
        let mut rest: Vec<_> = direction
            .iter()
            .filter(is_state)
            .map(|(known, _)| (*known, 0.0))
            .collect();
        for &(known, seed) in direction {
            match known {
                _ if machine.more.origin.is_some() => rest.push((known, seed)),
                Known::Signal(signal::FORCE) => by.force += seed,
                Known::Signal(signal::BASE) => by.force -= mass * seed,
                Known::Signal(_) if machine.more.drive.is_none() => {}
                Known::Signal(_) => rest.push((known, seed)),
                Known::Parameter(slot::INITIAL_POSITION) | POSITION => by.position += seed,
                // A mass that is held stays at rest.
                Known::State(_) if machine.is_held() => {}
                Known::Parameter(_) | Known::State(_) => by.velocity += seed,
            }
        }
        Ok(Self {
            exact: machine.simulation().sensitivity(&by)?,
            machine: machine.clone(),
            whole: direction.to_vec(),
            rest,
        })
    }

    /// The derivative of an output that the engine has derivatives of.
    pub(crate) fn along(&self, exact: fn(&Sensitivity) -> f64, value: fn(&Machine) -> f64) -> f64 {
        exact(&self.exact) + self.machine.difference(&self.rest, value)
    }

    /// The derivative of any output.
    pub(crate) fn of(&self, value: fn(&Machine) -> f64) -> f64 {
        self.machine.difference(&self.whole, value)
    }
}

impl Machine {
    fn difference(&self, direction: &[(Known, f64)], value: fn(&Self) -> f64) -> f64 {
        if direction.iter().all(|(_, seed)| *seed == 0.0) {
            return 0.0;
        }
        let width = |&(known, seed): &(Known, f64)| WIDTH * self.scale(known) / seed.abs();
        let width = direction.iter().map(width).fold(f64::INFINITY, f64::min);
        let story = |machine: &Self| {
            let of = machine.contacts();
            (machine.phase(), of.impacts, of.pierced)
        };
        let same = |machine: &Self| story(machine) == story(self);
        slope(value(self), width, |step| {
            let machine = self.repeated(direction, step).ok()?;
            same(&machine).then(|| value(&machine))
        })
    }

    /// How much of something is much.
    fn scale(&self, known: Known) -> f64 {
        let (scene, of) = (self.simulation().scene(), self.sample());
        let rate = scene.excitation.frequency.abs();
        let length = of.position.abs() + of.velocity.abs() / rate;
        let length = if length > 0.0 { length } else { 1.0 };
        match known {
            Known::Signal(signal::SPEED) => rate,
            Known::Signal(signal::BASE) => rate * rate * length,
            Known::Signal(_) => scene.mass * rate * rate * length,
            Known::Parameter(slot::INITIAL_POSITION) | POSITION => length,
            Known::Parameter(_) | Known::State(_) => rate * length,
        }
    }

    /// The last step again, from a beginning that was moved by `step` along a direction; the present state, if that is what
    /// is moved.
    fn repeated(&self, direction: &[(Known, f64)], step: f64) -> Outcome<Self> {
        let begin = self.more.origin.as_deref().unwrap_or(self);
        let (mut position, mut velocity) = (0.0, 0.0);
        for &(known, seed) in direction {
            match known {
                Known::Parameter(slot::INITIAL_POSITION) | POSITION => position += step * seed,
                Known::Parameter(_) | Known::State(_) => velocity += step * seed,
                Known::Signal(_) => {}
            }
        }
        let is_present = direction
            .iter()
            .any(|(known, _)| matches!(known, Known::State(_)));
        let mut machine = if is_present {
            self.clone()
        } else {
            let simulation = begin
                .simulation()
                .displaced_at_checkpoint(position, velocity)?;
            Self::new(simulation, begin.more.clone().afresh())
        };
        for &(known, seed) in direction {
            if let Known::Signal(number) = known {
                let mut signal = *machine.signal(number).derivatives();
                signal[0] += step * seed;
                machine.set(number, &signal);
            }
        }
        machine.push()?;
        if is_present {
            let of = self.sample();
            machine = machine.placed(
                self.time(),
                &[of.position + position, of.velocity + velocity],
            )?;
            machine.keep_law(self);
        }
        let end = self.simulation().time();
        if end > machine.simulation().time() {
            machine.go_to(end, None, &mut Events::default())?;
        }
        Ok(machine)
    }
}
