//! From event to event through the layers of a machine.

use crate::methods::Task;

use super::ReferenceError;
use super::arc::Arc;
use super::number::{Digits, Real, float, is_negative, is_zero, size};
use super::place::{Event, Place};
use super::rest::Rest;
use super::root::first_root;

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

/// A motion on its way.
pub struct Walk {
    place: Place,
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
        let mut walk = Self {
            place: Place::new(task, digits)?,
            impacts: Vec::new(),
            crossings: 0,
            steps: 0,
        };
        if walk.place.begins_above() {
            walk.pass(Event::High)?;
        } else {
            walk.place.settle();
        }
        Ok(walk)
    }

    /// Runs to the end.
    ///
    /// # Errors
    /// [`ReferenceError`] if it is interrupted or gets lost.
    pub fn run(mut self, go_on: &dyn Fn(f64) -> bool) -> Result<Course, ReferenceError> {
        let end = float(&self.place.end);
        while self.place.state.time < self.place.end {
            if !go_on((float(&self.place.state.time) / end).clamp(0.0, 1.0)) {
                return Err(ReferenceError::Interrupted);
            }
            self.step()?;
            self.steps += 1;
            if self.steps > MOST_STEPS || self.crossings > MOST_CROSSINGS {
                return Err(ReferenceError::Endless {
                    time: float(&self.place.state.time),
                    steps: self.steps,
                    crossings: self.crossings,
                });
            }
        }
        Ok(Course {
            position: self.place.state.position,
            velocity: self.place.state.velocity,
            impacts: self.impacts,
            crossings: self.crossings,
        })
    }

    fn step(&mut self) -> Result<(), ReferenceError> {
        let mut balanced = false;
        if is_zero(&self.place.state.velocity) {
            match self.place.rest() {
                Rest::Free => {}
                Rest::Leaves { forward, layer } => self.place.leave(forward, layer),
                Rest::Held {
                    until,
                    forward,
                    layer,
                } => {
                    if until >= self.place.end {
                        self.place.state.time = self.place.end.clone();
                        return Ok(());
                    }
                    self.place.state.time = until;
                    self.place.leave(forward, layer);
                    balanced = true;
                }
            }
        }
        let arc = self.place.arc(balanced);
        self.follow(&arc)
    }

    fn follow(&mut self, arc: &Arc) -> Result<(), ReferenceError> {
        let left = &self.place.end - &self.place.state.time;
        let (mut span, mut event) = (arc.reach.clone().min(left), None);
        for (kind, guard) in self.place.guards(arc) {
            if let Some(root) = first_root(&guard, &span).map_err(|_| self.place.undecided())? {
                (span, event) = (root, Some(kind));
            }
        }
        let ends = event.is_none() && span < arc.reach;
        (self.place.state.position, self.place.state.velocity) = arc.at(&span);
        self.place.state.time = if ends {
            self.place.end.clone()
        } else {
            &self.place.state.time + &span
        };
        self.place.last = event;
        match event {
            None => Ok(()),
            Some(event) => self.pass(event),
        }
    }

    fn pass(&mut self, event: Event) -> Result<(), ReferenceError> {
        self.crossings += 1;
        match event {
            Event::Switch => self.place.presses = !self.place.presses,
            Event::Turn => self.place.state.velocity = self.place.digits.real(0.0),
            Event::Low => {
                self.land(false)?;
                self.cross(self.place.layer - 1);
            }
            Event::High => {
                self.land(true)?;
                if self.place.layer == 0 {
                    let hit = (
                        self.place.state.time.clone(),
                        self.place.state.velocity.clone(),
                    );
                    self.impacts.push(hit);
                }
                if self.place.layer + 1 == self.place.machine.layers.len() {
                    self.rebound();
                } else {
                    self.cross(self.place.layer + 1);
                }
            }
        }
        Ok(())
    }

    /// Moves on into a layer, unless that would be a bounce that counts as rest.
    fn cross(&mut self, layer: usize) {
        if self.is_faint() {
            self.place.state.velocity = self.place.digits.real(0.0);
        } else {
            self.place.enter(layer);
        }
    }

    /// Puts the mass on the surface that it has reached.
    fn land(&mut self, up: bool) -> Result<(), ReferenceError> {
        let layer = &self.place.machine.layers[self.place.layer];
        let surface = if up { &layer.to } else { &layer.from };
        let velocity = &self.place.state.velocity;
        if is_zero(velocity) || is_negative(velocity) == up {
            return Err(self.place.undecided());
        }
        if let Some(surface) = surface {
            self.place.state.position = surface.clone();
        }
        Ok(())
    }

    /// Newton's impact law.
    fn rebound(&mut self) {
        let restitution = self.place.machine.restitution.as_ref();
        let back = restitution.map_or(Real::ZERO, |r| r * &self.place.state.velocity);
        self.place.state.velocity = -back;
        self.place.forward = false;
        if self.is_faint() {
            self.place.state.velocity = self.place.digits.real(0.0);
        }
        self.place.enter(self.place.layer);
    }

    /// True if both sides press the mass onto its surface and the bounce that would follow is too short to matter.
    fn is_faint(&self) -> bool {
        let speed = size(&self.place.state.velocity);
        self.place
            .pressed()
            .is_some_and(|least| speed < least * &self.place.briefest())
    }
}
