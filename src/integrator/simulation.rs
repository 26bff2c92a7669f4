//! A machine that runs on: the motion with its tallies, its inputs and its tunable parameters.

use super::clock::{Clock, Instant};
use super::force::polynomial;
use super::motion::{Motion, Start};
use super::observer::{Arc, Crossing, Observer};
use crate::error::MotionError;
use crate::flow::Polynomial;
use crate::phases::{Law, PhaseKind};
use crate::scene::Scene;
use crate::trajectory::{Work, mechanical_energy, work};

/// A running machine, SI units, absolute time in s.
#[derive(Debug, Clone)]
pub struct Simulation {
    scene: Scene,
    motion: Motion,
    /// Absolute time of the clock's time 0.
    epoch: f64,
    now: f64,
    tallies: Tallies,
}

/// Outputs at the present time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Position in m.
    pub position: f64,
    /// Velocity in m/s.
    pub velocity: f64,
    /// Acceleration in m/s^2.
    pub acceleration: f64,
    /// Jerk in m/s^3.
    pub jerk: f64,
    /// F in m x'' + b1 x' + k1 x + F = F0 cos(w t + phi) + f, in N: positive where stop or strip
    /// press the mass back; what contact adds to the damping b1 is part of it.
    pub contact_force: f64,
    /// What the mass does.
    pub phase: PhaseKind,
}

/// Drive periods up to which the drive angle is resolved.
const LAST_CYCLE: f64 = 9.0e15;

/// An impact at absolute time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// Time in s.
    pub time: f64,
    /// Before-impact velocity in m/s.
    pub velocity: f64,
}

/// Energies in J since the start; supplied = dissipated + change of mechanical.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energy {
    /// Kinetic, suspension and loaded stop.
    pub mechanical: f64,
    /// Work of drive, external force and tuning.
    pub supplied: f64,
    /// Work lost in dampers, strip and friction.
    pub dissipated: f64,
}

#[derive(Debug, Clone)]
struct Tallies {
    mass: f64,
    free: Law,
    impacts: u64,
    pierced: u64,
    last_impact: Option<(Instant, f64)>,
    work: Work,
}

impl Observer for Tallies {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        self.work += work(arc, self.mass, &self.free, elapsed);
    }

    fn crossing(&mut self, crossing: &Crossing) {
        self.work.dissipated += crossing.lost_energy(self.mass);
        self.pierced += u64::from(crossing.pierces());
        if let Some(velocity) = crossing.impact_velocity() {
            self.impacts += 1;
            self.last_impact = Some((crossing.instant, velocity));
        }
    }
}

impl Tallies {
    /// Work of the arc that is under way.
    fn work_under_way(&self, motion: &Motion) -> Work {
        let arc = motion.arc();
        let elapsed = motion.clock().elapsed(arc.start, motion.now());
        work(&arc, self.mass, &self.free, elapsed)
    }
}

impl Simulation {
    /// The machine at time 0 s.
    ///
    /// # Errors
    /// [`MotionError`] if the scene is invalid or the start not finite.
    pub fn new(scene: &Scene, start: Start) -> Result<Self, MotionError> {
        Self::new_at(scene, start, 0.0)
    }

    /// The machine at absolute time `time` in s; the drive is F0 cos(w t + phi) in absolute time.
    ///
    /// # Errors
    /// [`MotionError`] if the scene is invalid, the start or the time not finite, or the start beyond
    /// a rigid stop.
    pub fn new_at(scene: &Scene, start: Start, time: f64) -> Result<Self, MotionError> {
        Self::new_fed(scene, start, time, true)
    }

    /// The same, with or without a strip: also in the stroke in which it starts, if it starts beyond
    /// the clearance.
    ///
    /// # Errors
    /// As [`Simulation::new_at`].
    pub fn new_fed(scene: &Scene, start: Start, time: f64, fed: bool) -> Result<Self, MotionError> {
        scene.validate()?;
        start.validate()?;
        if !time.is_finite() {
            return Err(MotionError::NotFinite {
                name: "time",
                value: time,
            });
        }
        let clock = Clock::new(scene.excitation.frequency, scene.excitation.phase);
        let phases = scene.phases();
        let tallies = Tallies {
            mass: scene.mass,
            free: phases.free,
            impacts: 0,
            pierced: 0,
            last_impact: None,
            work: Work::default(),
        };
        let at = clock.instant(time);
        let motion = Motion::with(phases, clock, at, start, Polynomial::default(), fed)?;
        Ok(Self {
            scene: scene.clone(),
            motion,
            epoch: 0.0,
            now: time,
            tallies,
        })
    }

    /// The parameters that hold now.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The present time in s.
    pub fn time(&self) -> f64 {
        self.now
    }

    /// Advances to absolute time `until` in s, exactly, however the way is divided.
    ///
    /// # Errors
    /// [`MotionError`] if `until` is not finite or in the past, or the motion grows beyond all
    /// bounds; the machine then stays where it was.
    pub fn advance(&mut self, until: f64) -> Result<(), MotionError> {
        if !(until.is_finite() && until >= self.now) {
            return Err(MotionError::TimeBackwards {
                until,
                present: self.now,
            });
        }
        let farthest = LAST_CYCLE * self.motion.clock().period();
        if (until - self.epoch).abs() > farthest {
            return Err(MotionError::TooFar { until, farthest });
        }
        let instant = self.motion.clock().instant(until - self.epoch);
        // Equal times may be written as instants that differ in the last digit.
        if instant > self.motion.now() {
            let (motion, tallies) = (self.motion.clone(), self.tallies.clone());
            if let Err(error) = self.motion.advance(instant, &mut self.tallies) {
                (self.motion, self.tallies) = (motion, tallies);
                return Err(error);
            }
        }
        self.now = until;
        Ok(())
    }

    /// Outputs at the present time.
    pub fn sample(&self) -> Sample {
        let Start { position, velocity } = self.motion.state();
        let force = self.motion.force();
        let (cos, sin) = self.motion.clock().drive(self.motion.now());
        let drive = self.scene.excitation;
        let push = drive.amplitude * cos + force.value();
        let push_rate = force.rate() - drive.amplitude * drive.frequency * sin;
        let (contact_force, acceleration, jerk) = match self.motion.phase() {
            None => (push - self.scene.stiffness * position, 0.0, 0.0),
            Some(phase) => {
                let contact = phase.contact_force(&self.motion.phases().free, position, velocity);
                let free = self.scene.damping * velocity + self.scene.stiffness * position;
                let acceleration = (push - free - contact) / self.scene.mass;
                let (stiffness, damping) = phase.slopes(position, velocity);
                let resisting = damping * acceleration + stiffness * velocity;
                (
                    contact,
                    acceleration,
                    (push_rate - resisting) / self.scene.mass,
                )
            }
        };
        Sample {
            position,
            velocity,
            acceleration,
            jerk,
            contact_force,
            phase: self.motion.kind(),
        }
    }

    /// Sets the external force from now on by its derivatives now: value in N, rate in N/s, and so on
    /// in N/s^k up to [`HIGHEST_ORDER`](crate::flow::HIGHEST_ORDER); those that are not given are zero.
    ///
    /// # Errors
    /// [`MotionError::ForceNotFinite`] if one of them is not finite, [`MotionError::ForceOrder`] if one
    /// beyond the highest order is not zero; nothing is changed then.
    pub fn set_force(&mut self, derivatives: &[f64]) -> Result<(), MotionError> {
        let force = polynomial(derivatives)?;
        if self.motion.force() != force {
            self.tallies.work += self.tallies.work_under_way(&self.motion);
            let before = mechanical_energy(&self.scene, &self.motion);
            self.motion.set_force(force);
            // Of summed bounces nothing goes on under another force.
            self.tallies.work.dissipated += before - mechanical_energy(&self.scene, &self.motion);
        }
        Ok(())
    }

    /// Feeds a strip or not, from the next upward crossing of the clearance on.
    pub fn feed_strip(&mut self, fed: bool) {
        self.motion.feed_strip(fed);
    }

    /// Takes new parameters from now on. The drive angle stays continuous unless the drive's phase
    /// itself is changed; mass, suspension and geometry may change too.
    ///
    /// # Errors
    /// [`MotionError::Scene`] if the scene is invalid, [`MotionError::BeyondStop`] if its rigid stop
    /// would stand before the mass; nothing is changed then.
    pub fn tune(&mut self, scene: &Scene) -> Result<(), MotionError> {
        scene.validate()?;
        if *scene == self.scene {
            return Ok(());
        }
        let before = self.energy().mechanical;
        let (old, new) = (self.scene.excitation, scene.excitation);
        let (mut clock, mut at) = (*self.motion.clock(), self.motion.now());
        let retimed = old.frequency != new.frequency || old.phase != new.phase;
        if retimed {
            let angle = old.frequency * at.offset + clock.phase + new.phase - old.phase;
            let angle = angle.rem_euclid(std::f64::consts::TAU);
            clock = Clock::new(new.frequency, angle);
            at = Clock::at_cycle(0);
        }
        let motion = self.motion.resumed(scene.phases(), clock, at)?;
        self.tallies.work += self.tallies.work_under_way(&self.motion);
        if retimed {
            if let Some((instant, _)) = &mut self.tallies.last_impact {
                let time = self.motion.clock().time(*instant) + self.epoch;
                *instant = clock.instant(time - self.now);
            }
            self.epoch = self.now;
        }
        (self.motion, self.scene) = (motion, scene.clone());
        self.tallies.mass = scene.mass;
        self.tallies.free = self.motion.phases().free;
        let mechanical = mechanical_energy(scene, &self.motion);
        self.tallies.work.supplied += mechanical - before;
        Ok(())
    }

    /// Upward crossings of the clearance since the start.
    pub fn impact_count(&self) -> u64 {
        self.tallies.impacts
    }

    /// Strips pierced through since the start.
    pub fn pierce_count(&self) -> u64 {
        self.tallies.pierced
    }

    /// The last impact, if there was one.
    pub fn last_impact(&self) -> Option<Impact> {
        let (instant, velocity) = self.tallies.last_impact?;
        Some(Impact {
            time: self.epoch + self.motion.clock().time(instant),
            velocity,
        })
    }

    /// Energies since the start.
    pub fn energy(&self) -> Energy {
        let mut work = self.tallies.work;
        work += self.tallies.work_under_way(&self.motion);
        Energy {
            mechanical: mechanical_energy(&self.scene, &self.motion),
            supplied: work.supplied,
            dissipated: work.dissipated,
        }
    }
}
