//! The machine as its outputs see it.

use std::cell::OnceCell;
use std::f64::consts::TAU;

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use softstop::{Contacts, Energy, Impact, PhaseKind, Rates, Sample, Simulation, Snapshot};

use crate::drive::Drive;
use crate::external::External;

/// A running machine: sampled once at each time, however many outputs are read.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Machine {
    #[serde(serialize_with = "keep", deserialize_with = "restore")]
    simulation: Simulation,
    pub(crate) more: More,
    #[serde(skip)]
    seen: Seen,
}

/// What the engine does not know of.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct More {
    #[serde(skip_serializing_if = "is_default")]
    pub external: External,
    /// The drive, if the inputs lead it.
    #[serde(skip_serializing_if = "is_default")]
    pub drive: Option<Box<Drive>>,
    /// Turns of the engine's drive before its clock began.
    #[serde(skip_serializing_if = "is_default")]
    pub turns: f64,
    /// What is known of the contacts of the last step; what happened since its checkpoint comes on top.
    #[serde(skip_serializing_if = "is_default")]
    pub contacts: Option<Box<Contacts>>,
    pub is_open: bool,
    /// The machine where the last step ended, if contacts of this step are told from it: something was set since.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ended: Option<Box<Machine>>,
    /// The machine where the last step began, if that was taken in pieces.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub origin: Option<Box<Machine>>,
}

/// What was computed of the present state.
#[derive(Debug, Clone, Default)]
struct Seen {
    sample: OnceCell<Sample>,
    energy: OnceCell<Energy>,
    rates: OnceCell<Rates>,
    contacts: OnceCell<Contacts>,
}

impl Machine {
    pub(crate) fn new(simulation: Simulation, more: More) -> Self {
        Self {
            simulation,
            more,
            seen: Seen::default(),
        }
    }

    pub(crate) fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// The simulation, to be changed: what was seen of it holds no more.
    pub(crate) fn change(&mut self) -> &mut Simulation {
        self.seen = Seen::default();
        &mut self.simulation
    }

    pub(crate) fn sample(&self) -> &Sample {
        self.seen.sample.get_or_init(|| self.simulation.sample())
    }

    pub(crate) fn rates(&self) -> &Rates {
        self.seen.rates.get_or_init(|| self.simulation.rates())
    }

    pub(crate) fn energy(&self) -> &Energy {
        self.seen.energy.get_or_init(|| self.simulation.energy())
    }

    /// What happened in the last step.
    pub(crate) fn contacts(&self) -> &Contacts {
        if let Some(ended) = &self.more.ended {
            return ended.contacts();
        }
        self.seen.contacts.get_or_init(|| {
            let kept = self.more.contacts.as_deref().copied().unwrap_or_default();
            if self.more.is_open {
                kept.and(&self.simulation.contacts().unwrap_or_default())
            } else {
                kept
            }
        })
    }

    /// Keeps what contacts of the last step are told from, before something is set that hides it: to tell them takes as long
    /// as the step, and few ask for them.
    pub(crate) fn close(&mut self) {
        self.more.origin = None;
        if self.more.is_open && !self.simulation.was_free_since_checkpoint() {
            self.more.ended = Some(Box::new(self.clone()));
        }
        self.more.is_open = false;
    }

    /// True if something was set since the last step, or none was taken: no stretch leads to the present state.
    pub(crate) fn is_step_over(&self) -> bool {
        !self.more.is_open && self.more.origin.is_none()
    }

    /// Keeps the contacts of a piece of a step.
    pub(crate) fn keep_contacts(&mut self) {
        if self.more.is_open {
            let contacts = *self.contacts();
            self.more.contacts = (contacts != Contacts::default()).then(|| contacts.into());
            self.more.is_open = false;
        }
    }

    /// The last impact; before the first one, zeros.
    pub(crate) fn last_impact(&self) -> Impact {
        self.simulation.last_impact().unwrap_or_default()
    }

    /// Value and first two derivatives of the force of the drive, in N.
    pub(crate) fn drive_force(&self) -> (f64, f64, f64) {
        let of = match &self.more.drive {
            Some(drive) if !drive.is_harmonic() => drive.force_at(self.simulation.time()),
            _ => {
                let angle = self.simulation.reduced_drive_angle();
                let of = self.simulation.scene().excitation;
                Drive::new(angle, 0.0, of.frequency, of.amplitude).force_at(0.0)
            }
        };
        let [value, rate, curvature, ..] = *of.derivatives();
        (value, rate, curvature)
    }

    /// Power of the drive in W with its first two derivatives.
    pub(crate) fn drive_power(&self) -> (f64, f64, f64) {
        let ((force, rate, curvature), of) = (self.drive_force(), self.sample());
        (
            force * of.velocity,
            rate * of.velocity + force * of.acceleration,
            curvature * of.velocity + 2.0 * rate * of.acceleration + force * of.jerk,
        )
    }

    /// Work of the drive in J.
    pub(crate) fn drive_work(&self) -> f64 {
        let mass = self.simulation.scene().mass;
        self.energy().supplied - self.more.external.work_to(self.sample().position, mass)
    }

    /// Drive angle in rad, speed in rad/s and its rate.
    pub(crate) fn drive_angle(&self) -> (f64, f64, f64) {
        match &self.more.drive {
            Some(drive) => {
                let now = self.simulation.time();
                let speed = drive.speed_at(now);
                (drive.whole_angle_at(now), speed.value(), speed.rate())
            }
            None => {
                let angle = TAU.mul_add(self.more.turns, self.simulation.drive_angle());
                (angle, self.simulation.scene().excitation.frequency, 0.0)
            }
        }
    }

    /// Force on the frame in N with its first two derivatives: what pushes the mass and does not accelerate it.
    pub(crate) fn frame_force(&self) -> (f64, f64, f64) {
        let (push, rate, curvature) = self.simulation.forcing();
        let (mass, of) = (self.simulation.scene().mass, self.sample());
        (
            push - mass * of.acceleration,
            rate - mass * of.jerk,
            curvature - mass * self.rates().snap,
        )
    }

    /// Whether the mass is held at rest.
    pub(crate) fn is_held(&self) -> bool {
        matches!(self.sample().phase, PhaseKind::Stuck | PhaseKind::Resting)
    }

    /// Number of the present phase, as in the enumeration [`PHASE`](crate::units::PHASE).
    pub(crate) fn phase(&self) -> i32 {
        match self.sample().phase {
            PhaseKind::Free => 1,
            PhaseKind::Pierce => 2,
            PhaseKind::Cut => 3,
            PhaseKind::Gap => 4,
            PhaseKind::Stop => 5,
            PhaseKind::Stuck => 6,
            PhaseKind::Resting => 7,
            PhaseKind::Released => 8,
            PhaseKind::Chatter => 9,
        }
    }
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

fn keep<S: Serializer>(simulation: &Simulation, serializer: S) -> Result<S::Ok, S::Error> {
    simulation.snapshot().serialize(serializer)
}

fn restore<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Simulation, D::Error> {
    let snapshot = Snapshot::deserialize(deserializer)?;
    Simulation::restored(&snapshot).map_err(serde::de::Error::custom)
}
