//! What a motion gives: impacts, forces, contacts, energies.

use std::f64::consts::TAU;

use serde::Serialize;

use softstop::internals::work;
use softstop::{
    Arc, Clock, Crossing, CrossingKind, MotionError, Observer, PhaseKind, Scene, Start, Work,
};
use softstop_dynamics::internals::peak;
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
            let orbit = Orbit::near(scene, hint.into()).ok()?;
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
                let (regime, settled) = Regime::after(scene, start, TRANSIENT)?;
                Self::over(scene, settled, regime)
            }
        }
    }

    /// A settled motion, observed over the periods in which it repeats.
    fn over(scene: &Scene, start: Start, regime: Option<Regime>) -> Result<Self, MotionError> {
        let periods = regime.map_or(LONG, |regime| regime.periods);
        let sums = Sums::default();
        let mut seen = ObservationRecorder { scene, sums };
        let mut motion = scene.motion(start)?;
        motion.advance(Clock::at_cycle(periods), &mut seen)?;
        motion.tell_arc(&mut seen);
        let (sums, clock) = (seen.sums, motion.clock());
        let max_position = StroboscopicMap::new(scene, periods)?.max_position(start.into())?;
        let mean = |sum: f64| (sums.impacts > 0).then(|| sum / sums.impacts as f64);
        Ok(Self {
            start,
            periods,
            regime,
            impacts: sums.impacts,
            before_impact_velocity: mean(sums.velocity),
            impact_phase: (sums.impacts > 0).then(|| sums.sine.atan2(sums.cosine).rem_euclid(TAU)),
            peak_force: sums.peak_force.filter(|_| sums.rebounds == 0),
            contact_time: mean(sums.contact_time),
            energy_per_impact: mean(sums.lost),
            max_position,
            mean_power: sums.work.supplied / clock.time(Clock::at_cycle(periods)),
        })
    }
}

#[derive(Default)]
struct Sums {
    impacts: u64,
    rebounds: u64,
    velocity: f64,
    cosine: f64,
    sine: f64,
    peak_force: Option<f64>,
    contact_time: f64,
    lost: f64,
    work: Work,
}

/// Adds up what a motion gives.
struct ObservationRecorder<'a> {
    scene: &'a Scene,
    sums: Sums,
}

impl Observer for ObservationRecorder<'_> {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let work = work(arc, self.scene.mass, elapsed);
        self.sums.work += work;
        if arc.kind == PhaseKind::Free {
            return;
        }
        self.sums.contact_time += elapsed;
        self.sums.lost += work.dissipated;
        if let Some(phase) = arc.phase {
            let highest = peak(self.scene, arc, elapsed, |time| {
                let Start { position, velocity } = arc.at(time);
                phase.side * phase.contact_force(position, velocity)
            });
            let known = self.sums.peak_force.unwrap_or(highest);
            self.sums.peak_force = Some(highest.max(known));
        }
    }

    fn crossing(&mut self, crossing: &Crossing) {
        self.sums.lost += crossing.lost_energy(self.scene.mass);
        self.sums.rebounds += u64::from(matches!(crossing.kind, CrossingKind::Rebound { .. }));
        if let Some(velocity) = crossing.impact_velocity() {
            let drive = self.scene.clock().drive(crossing.instant);
            self.sums.impacts += 1;
            self.sums.velocity += velocity;
            self.sums.cosine += drive.cos;
            self.sums.sine += drive.sin;
        }
    }
}
