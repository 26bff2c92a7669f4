//! What passed between the mass and its stop and strip over the last advance.

use serde::{Deserialize, Serialize};

use super::arc::Arc;
use super::clock::{Clock, Instant};
use super::crossing::{Crossing, CrossingKind, Impact};
use super::observer::Observer;
use super::simulation::Simulation;
use super::start::Start;
use crate::error::MotionError;
use crate::flow::integrate;
use crate::largest_value::largest_value;
use crate::phases::PhaseKind;
use crate::scene::Scene;

/// Impacts, and the contact force, over a stretch of time.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Contacts {
    /// How many impacts.
    pub impacts: u64,
    /// How many strips were pierced through.
    pub pierced: u64,
    /// The first impact.
    pub first: Option<Impact>,
    /// The impact with the highest velocity.
    pub hardest: Option<Impact>,
    /// Largest contact force in N of either stop, at least 0; the blow of a rigid stop has none.
    pub peak: f64,
    /// Integral of the contact force in N s, blows included; a stop below counts as negative.
    pub impulse: f64,
}

impl Contacts {
    /// What passed over this stretch of time and the one that follows.
    #[must_use]
    pub fn and(&self, next: &Self) -> Self {
        let harder = |next: &Impact| self.hardest.is_none_or(|one| next.velocity > one.velocity);
        Self {
            impacts: self.impacts + next.impacts,
            pierced: self.pierced + next.pierced,
            first: self.first.or(next.first),
            hardest: next.hardest.filter(harder).or(self.hardest),
            peak: self.peak.max(next.peak),
            impulse: self.impulse + next.impulse,
        }
    }
}

impl Simulation {
    /// What happened over the last advance, or since [`Simulation::set_checkpoint`] was called or something was set. It is gone
    /// through again to tell, unless the mass was free all the way.
    ///
    /// # Errors
    /// [`MotionError`] if it cannot be gone through again.
    pub fn contacts(&self) -> Result<Contacts, MotionError> {
        if self.was_free_since_checkpoint() {
            return Ok(Contacts::default());
        }
        let (motion, from) = self.motion_through_checkpoint();
        let mut watch = ContactRecorder {
            scene: &self.scene,
            clock: *motion.clock(),
            epoch: self.epoch,
            from,
            contacts: Contacts::default(),
        };
        self.replay(&mut watch)?;
        Ok(watch.contacts)
    }
}

/// An observer that gathers impacts and the contact force from an instant on.
struct ContactRecorder<'a> {
    scene: &'a Scene,
    clock: Clock,
    epoch: f64,
    from: Instant,
    contacts: Contacts,
}

impl Observer for ContactRecorder<'_> {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let from = self.clock.elapsed(arc.start, self.from).max(0.0);
        if arc.kind == PhaseKind::Free || elapsed <= from {
            return;
        }
        let (mass, damping) = (self.scene.mass, self.scene.damping);
        // F = forcing - k1 x - b1 x' - m x'', of which the last two have integrals.
        let rest = |time: f64| static_force(self.scene, arc, time);
        self.contacts.impulse += integrate((from, elapsed), rate_of(self.scene, arc), rest);
        let (begin, end) = (arc.at(from), arc.node_after(elapsed));
        self.contacts.impulse -= damping * (end.position - begin.position);
        self.contacts.impulse -= mass * (end.velocity - begin.velocity);

        let (_, peak) = contact_peak(self.scene, arc, (from, elapsed));
        self.contacts.peak = self.contacts.peak.max(peak);
    }

    fn crossing(&mut self, crossing: &Crossing) {
        if crossing.kind != CrossingKind::Rest {
            let change = crossing.velocity - crossing.velocity_after;
            self.contacts.impulse += self.scene.mass * change;
        }
        let impact = crossing.impact_velocity().map(|velocity| Impact {
            time: self.epoch + self.clock.time(crossing.instant),
            velocity,
        });
        let pierced = u64::from(crossing.pierces());
        self.contacts = self.contacts.and(&Contacts {
            impacts: u64::from(impact.is_some()),
            pierced,
            first: impact,
            hardest: impact,
            ..Contacts::default()
        });
    }
}

/// The force in N of drive, external force and the spring of the suspension, without its damper, at a time of an arc.
fn static_force(scene: &Scene, arc: &Arc<'_>, time: f64) -> f64 {
    let law = arc.phase.map_or(0.0, |phase| phase.law.force);
    scene.mass * arc.course.forcing_at(time) - law - scene.stiffness * arc.at(time).position
}

/// What the contact force of an arc oscillates no faster than with, in rad/s.
fn rate_of(scene: &Scene, arc: &Arc<'_>) -> f64 {
    let fastest = arc.course.flow.modes.fastest_rate();
    scene.excitation.frequency + arc.phase.map_or(0.0, |_| fastest)
}

/// When between two times of an arc either stop presses with the largest contact force, in s after its start, and that
/// force in N.
pub(crate) fn contact_peak(scene: &Scene, arc: &Arc<'_>, span: (f64, f64)) -> (f64, f64) {
    largest_value(span, rate_of(scene, arc), |time| {
        let Start { position, velocity } = arc.at(time);
        let force = arc.phase.map_or_else(
            || static_force(scene, arc, time),
            |phase| phase.contact_force(position, velocity),
        );
        arc.side * force
    })
}
