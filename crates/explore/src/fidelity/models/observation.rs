//! What a motion gives: impacts, forces, contacts, energies.

use std::f64::consts::TAU;

use softstop::internals::work;
use softstop::{Clock, Crossing, CrossingKind, ImpactEvent, MotionError, PhaseKind, Scene, Start};
use softstop_dynamics::internals::peak_contact_force;
use softstop_dynamics::orbit::{Orbit, OrbitError, Regime, StroboscopicMap, find};
use softstop_dynamics::zone::StabilityBounds;

use super::Quantity;

/// What the settled motion of a machine gives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ObservedFigures {
    /// Position in m and velocity in m/s at drive angle phi with which it was observed from.
    pub start: Start,
    /// Its regime; none if it does not repeat.
    pub regime: Option<Regime>,
    /// By quantity; none without impacts, but for position, power and regime.
    pub values: [Option<f64>; Quantity::ALL.len()],
}

/// Drive periods after which a motion that is not z = 1 counts as settled.
const TRANSIENT: u64 = 400;
/// Drive periods over which a motion is observed that does not repeat.
const LONG: u64 = 200;

impl ObservedFigures {
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
        let impacts: Vec<ImpactEvent> = motion.impacts().collect();
        let clock = motion.clock;
        let mean = |sum: f64| (!impacts.is_empty()).then(|| sum / impacts.len() as f64);
        let drives = impacts.iter().map(|impact| clock.drive(impact.instant));
        let (sine, cosine) = drives.fold((0.0, 0.0), |(sine, cosine), drive| {
            (sine + drive.sin, cosine + drive.cos)
        });
        let phase = f64::atan2(sine, cosine).rem_euclid(TAU);
        let velocity = impacts.iter().map(|it| it.before_impact_velocity).sum();
        let value = |quantity| match quantity {
            Quantity::BeforeImpactVelocity => mean(velocity),
            Quantity::ImpactPhase => mean(0.0).map(|_| phase),
            Quantity::MaxPosition => Some(motion.max_position()),
            Quantity::PeakForce => peak.filter(|_| !motion.crossings().any(rebounds)),
            Quantity::ContactTime => mean(contact_time),
            Quantity::EnergyPerImpact => mean(lost),
            Quantity::MeanPower => Some(supplied / clock.time(Clock::at_cycle(periods))),
            Quantity::Regime => regime.map(|it| it.impacts as f64 / it.periods as f64),
            Quantity::GrazingFrequency | Quantity::FlipFrequency | Quantity::FoldFrequency => None,
        };
        Ok(Self {
            start,
            regime,
            values: Quantity::ALL.map(value),
        })
    }

    /// These answers with the bounds of a scene, those of its z = 1 motion only if this is one.
    ///
    /// # Errors
    /// [`OrbitError`] if a bound cannot be followed.
    pub fn with_bounds(mut self, scene: &Scene) -> Result<Self, OrbitError> {
        let near = (self.regime == Some(Regime::ONE)).then_some(self.start);
        let bounds = StabilityBounds::of_scene(scene, near)?;
        self.values[Quantity::GrazingFrequency as usize] = bounds.grazing;
        self.values[Quantity::FlipFrequency as usize] = bounds.flip;
        self.values[Quantity::FoldFrequency as usize] = bounds.fold;
        Ok(self)
    }

    /// A quantity; none if the motion has none, or its bounds were not asked for.
    pub fn value(&self, quantity: Quantity) -> Option<f64> {
        self.values[quantity as usize]
    }

    /// How far a model's are from these: relative to these, for a drive angle as a share of a turn, for a regime 0 or
    /// infinite. None if one of the two has no value.
    pub fn error(&self, model: &Self, quantity: Quantity) -> Option<f64> {
        let (own, value) = (self.value(quantity)?, model.value(quantity)?);
        let gap = (value - own).abs();
        Some(match quantity {
            Quantity::ImpactPhase => gap.min(TAU - gap) / TAU,
            Quantity::Regime if self.regime != model.regime => f64::INFINITY,
            _ if gap == 0.0 => 0.0,
            _ => gap / own.abs(),
        })
    }
}
