//! From event to event through the layers of a machine.

use crate::methods::Task;

use super::arc::{Arc, Outlook, State, linear};
use super::machine::{Grip, Law, Layer, Machine};
use super::number::{Digits, Real, float, is_negative, is_zero, size};
use super::root::first_root;
use super::{ReferenceError, rest::Rest};

/// Steps after which a reference is given up.
const MOST_STEPS: u64 = 2_000_000;
/// Crossings after which it is.
const MOST_CROSSINGS: u64 = 100_000;

/// What a run has found.
#[derive(Debug, Clone)]
pub struct Course {
    /// Position in m at the end.
    pub position: Real,
    /// Velocity in m/s at the end.
    pub velocity: Real,
    /// Times in s and before-impact velocities in m/s.
    pub impacts: Vec<(Real, Real)>,
    /// Crossings of all kinds.
    pub crossings: u64,
}

/// What ends an arc.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Event {
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
    pub(super) machine: Machine,
    pub(super) digits: Digits,
    pub(super) state: State,
    /// The present layer.
    pub(super) layer: usize,
    /// Which of its laws holds.
    pub(super) forward: bool,
    /// The stop presses.
    presses: bool,
    /// The event at the start of the arc.
    last: Option<Event>,
    pub(super) end: Real,
    impacts: Vec<(Real, Real)>,
    crossings: u64,
    steps: u64,
}

impl Walk {
    /// A motion from a task's start.
    ///
    /// # Errors
    /// [`ReferenceError`] if a law is not linear or the start cannot be decided.
    pub fn new(task: &Task, digits: Digits) -> Result<Self, ReferenceError> {
        let machine = Machine::new(&task.scene, digits)?;
        let position = digits.real(task.start.position);
        let below = |layer: &Layer| layer.from.as_ref().is_none_or(|from| *from <= position);
        let layer = machine.layers.iter().rposition(below).unwrap_or(0);
        let mut walk = Self {
            end: digits.real(task.periods) * digits.turn() / &machine.drive.frequency,
            state: State {
                time: digits.real(0.0),
                position,
                velocity: digits.real(task.start.velocity),
            },
            machine,
            digits,
            layer,
            forward: true,
            presses: true,
            last: None,
            impacts: Vec::new(),
            crossings: 0,
            steps: 0,
        };
        walk.start()?;
        Ok(walk)
    }

    /// Sorts out a start on a surface.
    fn start(&mut self) -> Result<(), ReferenceError> {
        let (x, v) = (self.state.position.clone(), self.state.velocity.clone());
        let at = |end: &Option<Real>| end.as_ref().is_some_and(|end| x >= *end);
        let layer = &self.machine.layers[self.layer];
        if at(&layer.to) && !is_zero(&v) && !is_negative(&v) {
            return self.pass(Event::High);
        }
        let below = layer.from.as_ref() == Some(&x) && is_negative(&v);
        self.enter(if below { self.layer - 1 } else { self.layer });
        Ok(())
    }

    /// Runs to the end.
    ///
    /// # Errors
    /// [`ReferenceError`] if it is interrupted or gets lost.
    pub fn run(mut self, go_on: &dyn Fn(f64) -> bool) -> Result<Course, ReferenceError> {
        let end = float(&self.end);
        while self.state.time < self.end {
            if !go_on((float(&self.state.time) / end).clamp(0.0, 1.0)) {
                return Err(ReferenceError::Interrupted);
            }
            self.step()?;
            self.steps += 1;
            if self.steps > MOST_STEPS || self.crossings > MOST_CROSSINGS {
                return Err(ReferenceError::Endless {
                    time: float(&self.state.time),
                    steps: self.steps,
                    crossings: self.crossings,
                });
            }
        }
        Ok(Course {
            position: self.state.position,
            velocity: self.state.velocity,
            impacts: self.impacts,
            crossings: self.crossings,
        })
    }

    fn step(&mut self) -> Result<(), ReferenceError> {
        let mut balanced = false;
        if is_zero(&self.state.velocity) {
            match self.rest() {
                Rest::Free => {}
                Rest::Leaves { forward, layer } => self.leave(forward, layer),
                Rest::Held {
                    until,
                    forward,
                    layer,
                } => {
                    if until >= self.end {
                        self.state.time = self.end.clone();
                        return Ok(());
                    }
                    self.state.time = until;
                    self.leave(forward, layer);
                    balanced = true;
                }
            }
        }
        let arc = self.arc(balanced);
        self.follow(&arc)
    }

    fn leave(&mut self, forward: bool, layer: usize) {
        self.last = None;
        self.forward = forward;
        self.enter(layer);
    }

    fn follow(&mut self, arc: &Arc) -> Result<(), ReferenceError> {
        let left = &self.end - &self.state.time;
        let (mut span, mut event) = (arc.reach.clone().min(left), None);
        for (kind, guard) in self.guards(arc) {
            if let Some(root) = first_root(&guard, &span).map_err(|_| self.undecided())? {
                (span, event) = (root, Some(kind));
            }
        }
        let ends = event.is_none() && span < arc.reach;
        (self.state.position, self.state.velocity) = arc.at(&span);
        self.state.time = if ends {
            self.end.clone()
        } else {
            &self.state.time + &span
        };
        self.last = event;
        match event {
            None => Ok(()),
            Some(event) => self.pass(event),
        }
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

    fn arc(&self, balanced: bool) -> Arc {
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
    fn guards(&self, arc: &Arc) -> Vec<(Event, Vec<Real>)> {
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

    fn pass(&mut self, event: Event) -> Result<(), ReferenceError> {
        self.crossings += 1;
        match event {
            Event::Switch => self.presses = !self.presses,
            Event::Turn => self.state.velocity = self.digits.real(0.0),
            Event::Low => {
                self.land(false)?;
                self.cross(self.layer - 1);
            }
            Event::High => {
                self.land(true)?;
                if self.layer == 0 {
                    let hit = (self.state.time.clone(), self.state.velocity.clone());
                    self.impacts.push(hit);
                }
                if self.layer + 1 == self.machine.layers.len() {
                    self.rebound();
                } else {
                    self.cross(self.layer + 1);
                }
            }
        }
        Ok(())
    }

    /// Moves on into a layer, unless that would be a bounce that counts as rest.
    fn cross(&mut self, layer: usize) {
        if self.is_faint() {
            self.state.velocity = self.digits.real(0.0);
        } else {
            self.enter(layer);
        }
    }

    /// Puts the mass on the surface that it has reached.
    fn land(&mut self, up: bool) -> Result<(), ReferenceError> {
        let layer = &self.machine.layers[self.layer];
        let surface = if up { &layer.to } else { &layer.from };
        let velocity = &self.state.velocity;
        if is_zero(velocity) || is_negative(velocity) == up {
            return Err(self.undecided());
        }
        if let Some(surface) = surface {
            self.state.position = surface.clone();
        }
        Ok(())
    }

    /// Newton's impact law.
    fn rebound(&mut self) {
        let restitution = self.machine.restitution.as_ref();
        let back = restitution.map_or(Real::ZERO, |r| r * &self.state.velocity);
        self.state.velocity = -back;
        self.forward = false;
        if self.is_faint() {
            self.state.velocity = self.digits.real(0.0);
        }
        self.enter(self.layer);
    }

    /// True if both sides press the mass onto its surface and the bounce that would follow is too short to matter.
    fn is_faint(&self) -> bool {
        let speed = size(&self.state.velocity);
        self.pressed()
            .is_some_and(|least| speed < least * &self.briefest())
    }
}
