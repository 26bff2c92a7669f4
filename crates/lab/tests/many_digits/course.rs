//! From event to event through the layers of a machine.

use softstop_lab::methods::Task;

use super::ReferenceError;
use super::arc::Arc;
use super::number::{Digits, Real, float, is_negative, is_zero, size};
use super::rest::Rest;
use super::root::first_root;
use super::walk::{Event, Walk};

/// Steps after which a reference is given up.
const MOST_STEPS: u64 = 2_000_000;
/// Crossings after which it is.
const MOST_CROSSINGS: u64 = 100_000;

impl Walk {
    /// A motion from a task's start.
    ///
    /// # Errors
    /// [`ReferenceError`] if a law is not linear or the start cannot be decided.
    pub fn new(task: &Task, digits: Digits) -> Result<Self, ReferenceError> {
        let mut walk = Self::at(task, digits)?;
        if walk.begins_above() {
            walk.pass(Event::High)?;
        } else {
            walk.settle();
        }
        Ok(walk)
    }

    /// Runs to the end.
    ///
    /// # Errors
    /// [`ReferenceError`] if it is interrupted or gets lost.
    pub fn run(mut self, go_on: &dyn Fn(f64) -> bool) -> Result<Self, ReferenceError> {
        let end = float(&self.end);
        let mut steps = 0;
        while self.state.time < self.end {
            let time = float(&self.state.time);
            if !go_on((time / end).clamp(0.0, 1.0)) {
                return Err(ReferenceError::Interrupted);
            }
            self.step()?;
            steps += 1;
            if steps > MOST_STEPS || self.crossings > MOST_CROSSINGS {
                let (time, crossings) = (float(&self.state.time), self.crossings);
                return Err(ReferenceError::Endless {
                    time,
                    steps,
                    crossings,
                });
            }
        }
        Ok(self)
    }

    fn step(&mut self) -> Result<(), ReferenceError> {
        let mut balanced = false;
        if is_zero(&self.state.velocity) {
            match self.rest() {
                Rest::Free => {}
                Rest::Leaves(forward, layer) => self.leave(forward, layer),
                Rest::Held(until, ..) if until >= self.end => {
                    self.state.time = self.end.clone();
                    return Ok(());
                }
                Rest::Held(until, forward, layer) => {
                    self.state.time = until;
                    self.leave(forward, layer);
                    balanced = true;
                }
            }
        }
        let arc = self.arc(balanced);
        self.follow(&arc)
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
        self.state.time = match ends {
            true => self.end.clone(),
            false => &self.state.time + &span,
        };
        self.last = event;
        event.map_or(Ok(()), |event| self.pass(event))
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
                    let (time, velocity) = (&self.state.time, &self.state.velocity);
                    self.impacts.push((time.clone(), velocity.clone()));
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
        let (speed, least) = (size(&self.state.velocity), self.pressed());
        least.is_some_and(|least| speed < least * &self.briefest())
    }
}
