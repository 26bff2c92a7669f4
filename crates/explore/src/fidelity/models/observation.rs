//! What a motion gives: impacts, forces, contacts, energies.

use std::f64::consts::TAU;

use serde::Serialize;

use softstop::internals::work;
use softstop::{Clock, Crossing, CrossingKind, MotionError, PhaseKind, Scene, Start, Touch};
use softstop_dynamics::internals::peak_contact_force;
use softstop_dynamics::orbit::{Orbit, OrbitError, Regime, StroboscopicMap, find};

/// What the settled motion of a machine gives.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Observation {
    /// Position in m and velocity in m/s at drive angle phi with which it was observed from.
    #[serde(serialize_with = "pair")]
    pub start: Start,
    /// Drive periods over which it was observed.
    pub periods: u64,
    /// Its regime; none if it does not repeat.
    pub regime: Option<Regime>,
    /// Impacts while it was observed.
    pub impacts: u64,
    /// Mean before-impact velocity in m/s; none without impacts, as all that follows but the position and
    /// the power.
    pub before_impact_velocity: Option<f64>,
    /// Mean drive angle at an impact in rad, 0 to 2 pi.
    pub impact_phase: Option<f64>,
    /// Largest contact force in N; none if a rigid stop is hit, where it has no bound.
    pub peak_force: Option<f64>,
    /// Mean time in s in contact per impact.
    pub contact_time: Option<f64>,
    /// Mean energy in J that is lost in contact per impact.
    pub energy_per_impact: Option<f64>,
    /// Largest position in m.
    pub max_position: f64,
    /// Mean power in W that the drive supplies.
    pub mean_power: f64,
}

fn pair<S: serde::Serializer>(start: &Start, serializer: S) -> Result<S::Ok, S::Error> {
    (start.position, start.velocity).serialize(serializer)
}

/// Drive periods after which a motion that is not z = 1 counts as settled.
const TRANSIENT: u64 = 400;
/// Drive periods over which a motion is observed that does not repeat.
const LONG: u64 = 200;

impl Observation {
    /// The stable z = 1 motion of a scene: the one that Newton's method reaches from `hint`, else the one
    /// that a search finds. If there is none, what the motion from `start` has settled on.
    ///
    /// # Errors
    /// [`MotionError`] if no motion can be computed.
    pub fn settled(scene: &Scene, hint: Option<Start>, start: Start) -> Result<Self, MotionError> {
        let near = |hint: Start| {
            let orbit = Orbit::find_near(scene, hint.into()).ok()?;
            orbit.is_stable().then_some(orbit)
        };
        let orbit = match hint.and_then(near) {
            Some(orbit) => Ok(orbit),
            None => find(scene),
        };
        match orbit {
            Ok(orbit) => Self::over(scene, orbit.state().into(), Some(Regime::ONE)),
            Err(OrbitError::Motion(error)) => Err(error),
            Err(_) => {
                let (regime, settled) = Regime::after_transient(scene, start, TRANSIENT)?;
                Self::over(scene, settled, regime)
            }
        }
    }

    /// A settled motion, observed over the periods in which it repeats.
    fn over(scene: &Scene, start: Start, regime: Option<Regime>) -> Result<Self, MotionError> {
        let periods = regime.map_or(LONG, |regime| regime.periods);
        let motion = StroboscopicMap::new(&scene.check()?, periods).trajectory(start.into())?;
        let (mut supplied, mut lost, mut contact_time) = (0.0, 0.0, 0.0);
        let mut peak: Option<f64> = None;
        for kept in &motion.arcs {
            let along = (&motion.observed_arc(kept), kept.duration);
            let work = work(along.0, scene.mass, along.1);
            supplied += work.supplied;
            if kept.kind != PhaseKind::Free {
                contact_time += kept.duration;
                lost += work.dissipated;
                let force = kept.phase.map(|_| peak_contact_force(scene, along));
                peak = peak.into_iter().chain(force).reduce(f64::max);
            }
            let crossing = kept.crossing.as_ref();
            lost += crossing.map_or(0.0, |crossing| crossing.lost_energy(scene.mass));
        }
        let rebounds = |it: &Crossing| matches!(it.kind, CrossingKind::Rebound { .. });
        let impacts: Vec<Touch> = motion.impacts().collect();
        let clock = motion.clock;
        let mean = |sum: f64| (!impacts.is_empty()).then(|| sum / impacts.len() as f64);
        let drives = impacts.iter().map(|impact| clock.drive(impact.instant));
        let (sine, cosine) = drives.fold((0.0, 0.0), |(sine, cosine), drive| {
            (sine + drive.sin, cosine + drive.cos)
        });
        Ok(Self {
            start,
            periods,
            regime,
            impacts: impacts.len() as u64,
            before_impact_velocity: mean(impacts.iter().map(|it| it.before_impact_velocity).sum()),
            impact_phase: mean(0.0).map(|_| f64::atan2(sine, cosine).rem_euclid(TAU)),
            peak_force: peak.filter(|_| !motion.crossings().any(rebounds)),
            contact_time: mean(contact_time),
            energy_per_impact: mean(lost),
            max_position: motion.max_position(),
            mean_power: supplied / clock.time(Clock::at_cycle(periods)),
        })
    }
}
