//! Where a motion is: the layer, the state in it, and the arc from there with what ends it.

use crate::methods::Task;

use super::ReferenceError;
use super::arc::{Arc, Outlook, State, linear};
use super::machine::{Grip, Law, Layer, Machine};
use super::number::{Digits, Real, float, is_negative, is_zero};

/// What ends an arc.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Event {
    /// The lower end of the layer.
    Low,
    /// Its upper end.
    High,
    /// The velocity changes its sign under dry friction.
    Turn,
    /// The stop begins or ceases to press.
    Switch,
}

/// A place on the way of a motion.
pub(super) struct Place {
    pub(super) machine: Machine,
    pub(super) digits: Digits,
    pub(super) state: State,
    /// The present layer.
    pub(super) layer: usize,
    /// Which of its laws holds.
    pub(super) forward: bool,
    /// The stop presses.
    pub(super) presses: bool,
    /// The event at the start of the arc.
    pub(super) last: Option<Event>,
    /// Time in s at which the motion ends.
    pub(super) end: Real,
}

impl Place {
    /// Where a task starts.
    pub(super) fn new(task: &Task, digits: Digits) -> Result<Self, ReferenceError> {
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
        })
    }

    /// True of a start on the upper end of a layer, upwards.
    pub(super) fn begins_above(&self) -> bool {
        let State {
            position, velocity, ..
        } = &self.state;
        let end = &self.machine.layers[self.layer].to;
        let at_end = end.as_ref().is_some_and(|end| position >= end);
        at_end && !is_zero(velocity) && !is_negative(velocity)
    }

    /// Into the layer that any other start belongs to.
    pub(super) fn settle(&mut self) {
        let from = self.machine.layers[self.layer].from.as_ref();
        let below = from == Some(&self.state.position) && is_negative(&self.state.velocity);
        self.enter(self.layer - usize::from(below));
    }

    /// Goes on from rest.
    pub(super) fn leave(&mut self, forward: bool, layer: usize) {
        self.last = None;
        self.forward = forward;
        self.enter(layer);
    }

    pub(super) fn undecided(&self) -> ReferenceError {
        ReferenceError::Undecided {
            time: float(&self.state.time),
            digits: self.digits.0,
        }
    }

    fn law(&self) -> &Law {
        let layer = &self.machine.layers[self.layer];
        match &layer.grip {
            Grip::Pressing { free, .. } if !self.presses => free,
            _ if self.forward => &layer.forward,
            _ => &layer.backward,
        }
    }

    /// The arc from here; `balanced` if a mass at rest is let go.
    pub(super) fn arc(&self, balanced: bool) -> Arc {
        let above = self.machine.layers[self.layer].to.as_ref();
        let outlook = Outlook { balanced, above };
        linear(
            self.law(),
            &self.machine.drive,
            &self.state,
            &outlook,
            self.digits,
        )
    }

    /// The polynomials whose fall below zero ends an arc.
    pub(super) fn guards(&self, arc: &Arc) -> Vec<(Event, Vec<Real>)> {
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
        let layer = &self.machine.layers[self.layer];
        match &layer.grip {
            Grip::Firm => None,
            Grip::Pressing {
                position, velocity, ..
            } => {
                let pairs = arc.position.iter().zip(&arc.velocity);
                let terms = pairs.map(|(x, v)| position * x + velocity * v);
                let mut press: Vec<Real> = terms.collect();
                press[0] = self.pressure(position, velocity);
                Some(press)
            }
        }
    }

    /// Force in N of spring and damper of a Kelvin-Voigt stop.
    fn pressure(&self, stiffness: &Real, damping: &Real) -> Real {
        let face = self.machine.layers[self.layer].from.as_ref();
        let depth = face.map_or(Real::ZERO, |face| &self.state.position - face);
        stiffness * depth + damping * &self.state.velocity
    }

    /// Into a layer with the present state.
    pub(super) fn enter(&mut self, layer: usize) {
        self.layer = layer;
        self.presses = match &self.machine.layers[layer].grip {
            Grip::Firm => true,
            Grip::Pressing {
                position, velocity, ..
            } => {
                let pressure = self.pressure(position, velocity);
                let opens = is_zero(&pressure) && is_negative(&self.state.velocity);
                !is_negative(&pressure) && !opens
            }
        };
        let velocity = &self.state.velocity;
        if !is_zero(velocity) {
            self.forward = !is_negative(velocity);
        }
    }
}
