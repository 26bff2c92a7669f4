//! What one period of a periodic motion does: how far it goes, how hard it hits, what it presses, what it costs.

mod forces_and_energies;

use serde::{Deserialize, Serialize};

use crate::orbit::Orbit;
pub use forces_and_energies::peak_contact_force;
pub(crate) use forces_and_energies::peak_stop_force;
use forces_and_energies::{
    STRIP_PHASES, largest_contact_force_in, peak_compliant_stop_force, peak_drive_power,
    supplied_and_lost_energy,
};
use softstop::{CrossingKind, MotionError, PhaseKind, Stop};

/// Figures of one period of a periodic motion, in SI units; of z = 1 it is one drive period, one stroke.
///
/// All follow from the exact motion: positions from its turning points, energies from integrals along its arcs,
/// forces and powers from their peaks on each arc.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct CycleMetrics {
    /// How long it lasts, in s: the drive periods after which the motion repeats.
    pub duration: f64,
    /// Before-impact velocity of the hardest impact, in m/s; 0 without impacts.
    pub impact_velocity: f64,
    /// Kinetic energy m v^2/2 of the mass right before that impact, in J.
    pub impact_energy: f64,
    /// Kinetic energy of all impacts together, per second, in W. Of complete chatter, the summed bounces are left out.
    pub impact_power: f64,
    /// Largest position X_m, in m.
    pub highest: f64,
    /// Lowest position, in m.
    pub lowest: f64,
    /// Way from the lowest position to the largest, in m.
    pub length: f64,
    /// The largest position less that of the strip's far side in m: above zero it is cut through; none without one.
    pub beyond_strip: Option<f64>,
    /// Strips cut through.
    pub strips: u64,
    /// Way left from the largest position to a rigid stop behind stop or strip, in m; 0 if hit, none without one.
    pub before_wall: Option<f64>,
    /// Largest force of contact, of strip or stop with what contact adds to the damping, in N: F in
    /// m x'' + b1 x' + k1 x + F = F0 cos(w t). Blows of rigid stops, which last no time, are not in it.
    pub contact_force: f64,
    /// Largest force of contact in N while a stop that gives way is touched, its preload included.
    pub stop_force: f64,
    /// That force without the stop's preload, by which the force jumps at first touch.
    pub stop_force_above_preload: f64,
    /// Largest force of contact in N while the strip is touched: the force with which it is cut.
    pub strip_force: f64,
    /// Largest change of momentum by a blow on a rigid stop, in N s; 0 without any.
    pub impulse: f64,
    /// Work of the drive, in J.
    pub supplied: f64,
    /// The energies in J by which the work of the drive is dissipated.
    pub losses: Losses,
    /// Mean power of the drive, in W.
    pub mean_power: f64,
    /// Largest power of the drive, F0 cos(w t + phi) x', in W.
    pub peak_power: f64,
}

/// Energies in J that a period dissipates.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Losses {
    /// In the suspension's damper b1, while nothing is touched.
    pub free_damping: f64,
    /// In the damper of contact, which replaces it there.
    pub contact_damping: f64,
    /// By restitution, in blows on rigid stops.
    pub impacts: f64,
    /// In the strip: the work done on it.
    pub strip: f64,
    /// In the stop by its own law: hysteresis, Hunt and Crossley's dissipation, a deflection that is not given back.
    pub stop: f64,
}

/// The largest position in m less that of the strip's far side; none without a strip.
pub(crate) fn depth_beyond_strip(orbit: &Orbit) -> Option<f64> {
    let scene = &orbit.scene;
    let strip = scene.piercing.as_ref()?;
    Some(orbit.max_position - (scene.clearance + strip.thickness))
}

impl CycleMetrics {
    /// The figures of one period of an orbit.
    ///
    /// # Errors
    /// [`MotionError`] if its motion cannot be computed.
    pub fn of(orbit: &Orbit) -> Result<Self, MotionError> {
        let scene = &orbit.scene;
        let motion = orbit.trajectory()?;
        let (supplied, losses) = supplied_and_lost_energy(&motion);
        let duration = scene.period() * orbit.periods as f64;
        let energy = |velocity: f64| 0.5 * scene.mass * velocity * velocity;
        let hardest = orbit.before_impact_velocity();
        let highest = orbit.max_position;
        let preload = match scene.stop {
            Stop::Preloaded { preload, .. } => preload,
            _ => 0.0,
        };
        let behind = scene
            .wall()
            .filter(|_| !matches!(scene.stop, Stop::Rigid { .. }));
        let lowest = motion.min_position();
        let force = |kinds: &[PhaseKind]| largest_contact_force_in(&motion, kinds);
        let (stop_force, strip_force) = (peak_compliant_stop_force(&motion), force(STRIP_PHASES));
        let blows = motion.crossings();
        let blows = blows.filter(|it| matches!(it.kind, CrossingKind::Rebound { .. }));
        let impulses = blows.map(|it| scene.mass * (it.velocity - it.velocity_after).abs());
        Ok(Self {
            duration,
            impact_velocity: hardest,
            impact_energy: energy(hardest),
            // The sum of no terms is -0.0.
            impact_power: (0.0 + orbit.before_impact_velocities().map(energy).sum::<f64>())
                / duration,
            highest,
            lowest,
            length: highest - lowest,
            beyond_strip: depth_beyond_strip(orbit),
            strips: motion.crossings().filter(|it| it.pierces()).count() as u64,
            before_wall: behind.map(|wall| wall.position - highest),
            contact_force: stop_force.max(strip_force).max(force(&[PhaseKind::Gap])),
            stop_force,
            stop_force_above_preload: (stop_force - preload).max(0.0),
            strip_force,
            impulse: impulses.fold(0.0, f64::max),
            supplied,
            losses,
            mean_power: supplied / duration,
            peak_power: peak_drive_power(&motion),
        })
    }
}
