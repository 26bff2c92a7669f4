//! What pushes the mass beside the drive: the external force and the motion of the frame, and the work that both do.

use serde::{Deserialize, Serialize};
use softstop::internals::Polynomial;
use softstop_fmi::Derivatives;

/// Force on the mass and acceleration of the frame, each a polynomial in time.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct External {
    /// It is not constant: its work has to be counted step by step.
    pub varies: bool,
    /// Force in N, and acceleration in m/s^2, from the time `since` in s on.
    force: Polynomial,
    base: Polynomial,
    since: f64,
    /// Position in m up to which `work` counts.
    place: f64,
    /// Work in J of both, and of tuning, up to there.
    work: f64,
}

impl External {
    /// The force that both are in the moving frame, for a mass in kg, at a time.
    pub fn at(&self, time: f64, mass: f64) -> Polynomial {
        let (force, base) = (self.force_at(time), self.base_at(time));
        if base == Polynomial::default() {
            return force;
        }
        Polynomial::new(std::array::from_fn(|k| {
            force.derivatives()[k] - mass * base.derivatives()[k]
        }))
    }

    /// The force on the mass and its derivatives at a time.
    pub fn force_at(&self, time: f64) -> Polynomial {
        self.force.shifted(time - self.since)
    }

    /// The acceleration of the frame and its derivatives at a time.
    pub fn base_at(&self, time: f64) -> Polynomial {
        self.base.shifted(time - self.since)
    }

    /// Sets the force from `now` on, with the mass at `position`.
    pub fn set_force(&mut self, now: f64, position: f64, mass: f64, force: Derivatives) {
        self.settle(now, position, mass);
        self.force = Polynomial::new(force);
        self.varies = !(self.force.is_constant() && self.base.is_constant());
    }

    /// Sets the acceleration of the frame.
    pub fn set_base(&mut self, now: f64, position: f64, mass: f64, base: Derivatives) {
        self.settle(now, position, mass);
        self.base = Polynomial::new(base);
        self.varies = !(self.force.is_constant() && self.base.is_constant());
    }

    fn settle(&mut self, now: f64, position: f64, mass: f64) {
        self.work = self.work_to(position, mass);
        (self.force, self.base) = (self.force_at(now), self.base_at(now));
        (self.since, self.place) = (now, position);
    }

    /// Moves the mass by so much in m, without work.
    pub fn shift(&mut self, by: f64) {
        self.place += by;
    }

    /// Adds work in J that was done elsewhere.
    pub fn count(&mut self, work: f64) {
        self.work += work;
    }

    /// The work in J so far, with the mass at `position`.
    pub fn work_to(&self, position: f64, mass: f64) -> f64 {
        if self.varies {
            return self.work;
        }
        let force = self.force.value() - mass * self.base.value();
        self.work + force * (position - self.place)
    }
}
