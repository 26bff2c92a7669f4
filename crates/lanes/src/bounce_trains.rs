//! Trains of bounces: whether lanes may follow a machine whose surfaces throw the mass back again and again.

use std::f64::consts::TAU;

use softstop::Excitation;
use softstop::internals::{Beyond, Exit, MAX_RESTITUTION, Phase, PhaseId, Phases, Surface};

/// Duration of the shortest bounce, in drive periods, that lanes follow at a surface at which bounces may come in trains.
const MIN_BOUNCE_DURATION: f64 = 1e-2;
/// Largest (damping / mass) times drive period with which lanes follow a machine with trains of bounces: under less damping,
/// bounces of at least [`MIN_BOUNCE_DURATION`] do not come to rest before the drive lifts the mass.
const MAX_DAMPING_EXPONENT: f64 = 6.0;

/// The phases and the drive of a machine, to find surfaces at which bounces come in trains (chatter): the drive can press the mass
/// onto them while they throw it back with hardly any loss, by a jump of the force that is larger than the press, or as a wall
/// that is nearly elastic. What ends a train only the safe engine can decide.
pub(super) struct BounceTrains<'a> {
    pub phases: &'a Phases,
    pub drive: Excitation,
}

impl BounceTrains<'_> {
    /// The constant force on the mass towards the stop, in N, at a surface under the law of a phase.
    fn force_towards_stop(&self, phase: PhaseId, surface: &Surface) -> f64 {
        let law = &self.phases[phase].law;
        surface.side * (law.force - law.stiffness * surface.position)
    }

    /// Bound in N on the rounding of the force at a position under the law of a phase.
    fn force_rounding(&self, phase: PhaseId, position: f64) -> f64 {
        let law = &self.phases[phase].law;
        8.0 * f64::EPSILON * (law.force.abs() + (law.stiffness * position).abs())
    }

    /// True if bounces come in trains at a surface: it throws the mass back nearly elastically while the drive can press it on.
    fn bounces_at(&self, surface: &Surface) -> bool {
        let before = self.force_towards_stop(surface.before, surface);
        let mut beyond = [Some(surface.beyond), surface.beyond_unfed]
            .into_iter()
            .flatten();
        let elastic = beyond.any(|above| match above {
            Beyond::Phase(above) => {
                let after = self.force_towards_stop(above, surface);
                let least = after + self.force_rounding(above, surface.position);
                least < before && after < self.drive.amplitude
            }
            Beyond::Wall { restitution } => restitution > MAX_RESTITUTION,
        });
        elastic && before + self.drive.amplitude > 0.0
    }

    /// True if the lanes meet no train of bounces that comes to rest: the drive lifts the mass from each surface with trains before
    /// damping has made the bounces too short.
    pub fn ends_before_rest(&self) -> bool {
        let damping = self.phases.phases.iter().map(|phase| phase.law.damping);
        let damping = damping.fold(0.0, f64::max) / self.phases.mass;
        let strong = damping * TAU / self.drive.frequency > MAX_DAMPING_EXPONENT;
        let lifts = |surface: &Surface| {
            self.force_towards_stop(surface.before, surface) < self.drive.amplitude && !strong
        };
        let mut surfaces = self.phases.surfaces.iter();
        surfaces.all(|surface| lifts(surface) || !self.bounces_at(surface))
    }

    /// Speed in m/s from which on bounces at the surfaces of a phase last at least [`MIN_BOUNCE_DURATION`].
    pub fn slowest_bounce(&self, phase: &Phase) -> f64 {
        let surfaces = phase.exits.iter().filter_map(|exit| match exit {
            Exit::Forward(surface) | Exit::Backward(surface) => Some(&self.phases[*surface]),
            Exit::Reversal { .. } | Exit::Switch(_) => None,
        });
        let press = |surface: &Surface| {
            self.force_towards_stop(surface.before, surface) + self.drive.amplitude
        };
        let presses = surfaces
            .filter(|surface| self.bounces_at(surface))
            .map(press);
        let half = 0.5 * MIN_BOUNCE_DURATION * TAU / self.drive.frequency;
        presses.fold(0.0, f64::max) / self.phases.mass * half
    }
}
