//! A motion on its way: the layer, the state in it, and the arc from there with what ends it.

use softstop_lab::methods::Task;

use super::ReferenceError;
use super::arc::{Arc, State, linear};
use super::machine::{Grip, Law, Layer, Machine};
use super::number::{Digits, Real, float, is_negative, is_zero};

/// What ends an arc.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// The lower end of the layer.
    Low,
    /// Its upper end.
    High,
    /// The velocity changes its sign under dry friction.
    Turn,
    /// The stop begins or ceases to press.
    Switch,
}

/// A motion on its way.
pub struct Walk {
    pub machine: Machine,
    pub digits: Digits,
    /// The present state.
    pub state: State,
    /// The present layer.
    pub layer: usize,
    /// Which of its laws holds.
    pub forward: bool,
    /// The stop presses.
    pub presses: bool,
    /// The event at the start of the arc.
    pub last: Option<Event>,
    /// Time in s at which the motion ends.
    pub end: Real,
    /// Times in s and before-impact velocities in m/s.
    pub impacts: Vec<(Real, Real)>,
    /// Crossings of all kinds.
    pub crossings: u64,
}

impl Walk {
    /// Where a task starts.
    pub fn at(task: &Task, digits: Digits) -> Result<Self, ReferenceError> {
        let machine = Machine::new(&task.scene, digits)?;
        let position = digits.real(task.start.position);
        let below = |layer: &Layer| layer.from.as_ref().is_none_or(|from| *from <= position);
        Ok(Self {
            layer: machine.layers.iter().rposition(below).unwrap_or(0),
            end: digits.real(task.periods) * digits.turn() / &machine.drive.frequency,
            state: State {
                time: digits.real(0.0),
                position,
                velocity: digits.real(task.start.velocity),
            },
            machine,
            digits,
            forward: true,
            presses: true,
            last: None,
            impacts: Vec::new(),
            crossings: 0,
        })
    }

    /// True of a start on the upper end of a layer, upwards.
    pub fn begins_above(&self) -> bool {
        let (end, state) = (&self.machine.layers[self.layer].to, &self.state);
        let at_end = end.as_ref().is_some_and(|end| state.position >= *end);
        at_end && state.velocity > Real::ZERO
    }

    /// Into the layer that any other start belongs to.
    pub fn settle(&mut self) {
        let from = self.machine.layers[self.layer].from.as_ref();
        let below = from == Some(&self.state.position) && is_negative(&self.state.velocity);
        self.enter(self.layer - usize::from(below));
    }

    /// Goes on from rest.
    pub fn leave(&mut self, forward: bool, layer: usize) {
        self.last = None;
        self.forward = forward;
        self.enter(layer);
    }

    pub fn undecided(&self) -> ReferenceError {
        ReferenceError::Undecided {
            time: float(&self.state.time),
            digits: self.digits.0,
        }
    }

    fn law(&self) -> &Law {
        let layer = &self.machine.layers[self.layer];
        match &layer.grip {
            Some(grip) if !self.presses => &grip.free,
            _ => layer.law(self.forward),
        }
    }

    /// The arc from here; `balanced` if a mass at rest is let go.
    pub fn arc(&self, balanced: bool) -> Arc {
        let above = self.machine.layers[self.layer].to.as_ref();
        let laws = (self.law(), &self.machine.drive);
        linear(laws, &self.state, balanced, above, self.digits)
    }

    /// The polynomials whose fall below zero ends an arc.
    pub fn guards(&self, arc: &Arc) -> Vec<(Event, Vec<Real>)> {
        let layer = &self.machine.layers[self.layer];
        let mut guards = Vec::with_capacity(4);
        if let Some(from) = &layer.from {
            let mut way = arc.position.clone();
            way[0] -= from;
            guards.push((Event::Low, way));
        }
        if let Some(to) = &layer.to {
            let mut way: Vec<Real> = arc.position.iter().map(|term| -term).collect();
            way[0] += to;
            guards.push((Event::High, way));
        }
        if layer.rubs() {
            let turn = |term: &Real| if self.forward { term.clone() } else { -term };
            guards.push((Event::Turn, arc.velocity.iter().map(turn).collect()));
        }
        if let Some(mut press) = self.press(arc) {
            if self.last == Some(Event::Switch) {
                press[0] = self.digits.real(0.0);
            }
            if !self.presses {
                press.iter_mut().for_each(|term| *term = -&*term);
            }
            guards.push((Event::Switch, press));
        }
        guards
    }

    /// What is positive while the stop presses, along an arc.
    fn press(&self, arc: &Arc) -> Option<Vec<Real>> {
        let grip = self.machine.layers[self.layer].grip.as_ref()?;
        let pairs = arc.position.iter().zip(&arc.velocity);
        let terms = pairs.map(|(x, v)| &grip.stiffness * x + &grip.damping * v);
        let mut press: Vec<Real> = terms.collect();
        press[0] = self.pressure(grip);
        Some(press)
    }

    /// Force in N of spring and damper of a Kelvin-Voigt stop.
    fn pressure(&self, grip: &Grip) -> Real {
        let face = self.machine.layers[self.layer].from.as_ref();
        let depth = face.map_or(Real::ZERO, |face| &self.state.position - face);
        &grip.stiffness * depth + &grip.damping * &self.state.velocity
    }

    /// Into a layer with the present state.
    pub fn enter(&mut self, layer: usize) {
        self.layer = layer;
        let grip = self.machine.layers[layer].grip.as_ref();
        self.presses = grip.is_none_or(|grip| {
            let pressure = self.pressure(grip);
            let opens = is_zero(&pressure) && is_negative(&self.state.velocity);
            !is_negative(&pressure) && !opens
        });
        let velocity = &self.state.velocity;
        if !is_zero(velocity) {
            self.forward = !is_negative(velocity);
        }
    }
}
