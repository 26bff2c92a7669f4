//! The drive of a running machine: where it stands, and another one from now on.

use std::f64::consts::TAU;

use super::clock::Clock;
use super::force::force_from_derivatives;
use super::simulation::{Checkpoint, Simulation};
use crate::error::MotionError;
use crate::scene::Scene;

impl Simulation {
    /// The drive angle in rad; it begins anew below 2 pi where frequency or phase are set.
    pub fn drive_angle(&self) -> f64 {
        let (clock, now) = (self.motion.clock(), self.motion.now());
        let turned = self.scene.excitation.frequency * now.offset + clock.phase;
        TAU.mul_add(now.cycles, turned)
    }

    /// Takes another drive and another external force, by its derivatives as in [`Simulation::set_force`], from now on: of
    /// this amplitude in N and frequency in rad/s, at this angle in rad. Phase, latched strip and bounces in a row stay as
    /// they are. The scene's own phase of the drive, which counts from time 0, is left alone.
    ///
    /// # Errors
    /// [`MotionError::NotFinite`], [`MotionError::Scene`] if amplitude or frequency make no valid scene, and those of
    /// [`Simulation::set_force`]; nothing is changed then.
    pub fn set_drive(
        &mut self,
        amplitude: f64,
        frequency: f64,
        angle: f64,
        force: &[f64],
    ) -> Result<(), MotionError> {
        let force = force_from_derivatives(force)?;
        if !angle.is_finite() {
            return Err(MotionError::NotFinite {
                name: "drive angle",
                value: angle,
            });
        }
        let mut scene = Scene::clone(&self.scene);
        (scene.excitation.amplitude, scene.excitation.frequency) = (amplitude, frequency);
        let scene = self.scene.recheck(scene)?;
        let clock = Clock::new(frequency, angle.rem_euclid(TAU));
        let work = self.tallies.work_under_way(&self.motion);
        self.restart_clock();
        let now = Clock::at_cycle(0);
        let through = (scene.phases().clone(), clock);
        if self.motion.set_drive(through, now, force) {
            self.tallies.counts.work += work;
        }
        self.scene = scene;
        self.mark = Checkpoint::OnArc(self.motion.now());
        Ok(())
    }

    /// Lets the time of another clock begin now.
    pub(super) fn restart_clock(&mut self) {
        self.earlier = self.last_impact();
        self.tallies.counts.last_impact = None;
        self.epoch = self.now;
    }
}
