//! A settled motion: what a motion is seen to have come to.

use std::f64::consts::LN_10;

use crate::ensemble::Member;
use crate::motion_kind::MotionKind;
use crate::orbit::recurrence::{find_settled_period, motion_size, returns_to_rounding};
use crate::orbit::{ImpactPattern, Orbit, Regime, StroboscopicMap, smallest_period};
use crate::tolerance::SAME;
use nalgebra::Vector2;
use softstop::{CheckedScene, Instant, MotionError, Scene, Start};

/// Largest distance of an orbit from where the last change of a motion predicts it, in units of the distance of that place from
/// the motion, with which the motion is taken to settle on the orbit. Farther off lies what is halfway from a stable orbit to the
/// unstable one that it meets at a fold.
const MAX_PREDICTION_ERROR: f64 = 1.0;

/// What a followed motion has settled on: its period, impacts and states in the last drive periods, in which it was watched.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SettledMotion {
    /// Drive periods after which it returns, if it does.
    pub periods: Option<u64>,
    /// Before-impact velocities in m/s, ascending: of one period of what returns, else of all watched drive periods.
    pub velocities: Vec<f64>,
    /// State at drive angle phi, a period of what returns before the end, else where it was first watched.
    pub from: Start,
    /// State at the end, at drive angle phi.
    pub end: Start,
    /// States at drive angle phi between these two, the end among them, one for each drive period.
    pub states: Vec<Start>,
    /// Instants of the impacts of these velocities, counted from there.
    instants: Vec<Instant>,
    /// Drive periods from there to the end.
    length: u64,
    /// Drive periods that it was followed in all: what returns settled within them.
    pub followed: u64,
}

impl SettledMotion {
    /// What a motion, followed for `followed` drive periods in all, has settled on by the record of its last periods.
    pub(crate) fn of(scene: &Scene, member: &Member, tolerance: f64, followed: u64) -> Self {
        let states = &member.states;
        let found = find_settled_period(scene.excitation.frequency, states, tolerance)
            .map(|periods| smallest_period(scene, states, periods));
        Self::of_record(member, found, followed)
    }

    /// What a motion has settled on by the record of its last periods, if that is confirmed: its states return to rounding, or
    /// Newton's method leads from the last one to a stable orbit, which then takes the place of what was seen.
    pub(super) fn confirmed(scene: &Scene, member: &Member, tolerance: f64, followed: u64) -> Self {
        let seen = Self::of(scene, member, tolerance, followed);
        let states = &member.states;
        let is_open = |periods: &u64| {
            !returns_to_rounding(scene.excitation.frequency, states, *periods as usize)
        };
        match seen.periods.filter(is_open) {
            Some(periods) => seen
                .orbit_reached(scene, periods)
                .and_then(|orbit| seen.on_orbit(&orbit).ok())
                .unwrap_or_else(|| Self::of_record(member, None, followed)),
            None => seen,
        }
    }

    /// The stable orbit with the impacts of a settled motion that Newton's method finds from its last state, if the orbit lies
    /// where the last change of the state predicts it: M (1 - M)^-1 times that change away, with the orbit's monodromy matrix M.
    /// None otherwise.
    fn orbit_reached(&self, scene: &Scene, periods: u64) -> Option<Orbit> {
        let orbit = Orbit::find_periodic(scene, self.end.into(), periods).ok()?;
        let monodromy = &orbit.monodromy;
        let rounds = periods / orbit.periods;
        let has_impacts = orbit.impacts.len() as u64 * rounds == self.instants.len() as u64;
        let earlier = (periods - orbit.periods).checked_sub(1);
        let earlier = earlier.map_or(self.from, |index| self.states[index as usize]);
        let end = Vector2::from(self.end);
        let gap = orbit.state() - end;
        let predicted = monodromy.matrix * monodromy.resolvent()? * (end - Vector2::from(earlier));
        let size = |state: Vector2<f64>| orbit.scene.scales().state(&state).norm();
        let is_predicted = size(gap - predicted) <= MAX_PREDICTION_ERROR * size(predicted);
        let decays = monodromy.is_stable() && !monodromy.is_neutral();
        (has_impacts && decays && (is_predicted || size(gap) <= SAME)).then_some(orbit)
    }

    /// The settled motion with all values replaced by those of its orbit.
    fn on_orbit(&self, orbit: &Orbit) -> Result<Self, MotionError> {
        let mut states: Vec<Start> = orbit.states()?.into_iter().map(Start::from).collect();
        states.rotate_left(1);
        let mut velocities: Vec<f64> = orbit.before_impact_velocities().collect();
        velocities.sort_by(f64::total_cmp);
        Ok(Self {
            periods: Some(orbit.periods),
            velocities,
            from: orbit.state().into(),
            end: orbit.state().into(),
            states,
            instants: orbit.impacts.iter().map(|touch| touch.instant).collect(),
            length: orbit.periods,
            followed: self.followed,
        })
    }

    /// What the record of a member shows: its last `found` drive periods if the motion returns after these, else all.
    fn of_record(member: &Member, found: Option<usize>, followed: u64) -> Self {
        let Member {
            states, impacts, ..
        } = member;
        let watched = states.len() - 1;
        let length = found.unwrap_or(watched);
        let first = (watched - length) as f64;
        // They are in order of time.
        let own = impacts.partition_point(|(instant, _)| instant.cycles < first);
        let own = &impacts[own..];
        let mut velocities: Vec<f64> = own.iter().map(|(_, velocity)| *velocity).collect();
        velocities.sort_by(f64::total_cmp);
        let since = |(instant, _): &(Instant, f64)| Instant {
            cycles: instant.cycles - first,
            ..*instant
        };
        Self {
            periods: found.map(|periods| periods as u64),
            velocities,
            from: states[watched - length],
            end: states[watched],
            states: states[watched - length + 1..].to_vec(),
            instants: own.iter().map(since).collect(),
            length: length as u64,
            followed,
        }
    }

    /// The regime z = p/n of a settled motion that returns; of chatter the impacts before the summed ones count.
    pub fn regime(&self) -> Option<Regime> {
        Some(Regime {
            impacts: self.instants.len() as u64,
            periods: self.periods?,
        })
    }

    /// Mean number of impacts per drive period of a settled motion: p/n of what returns, else over the watched periods.
    pub fn impacts_per_period(&self) -> f64 {
        self.instants.len() as f64 / self.length as f64
    }

    /// Largest before-impact velocity in m/s of a settled motion; 0 without impacts.
    pub fn hardest_impact(&self) -> f64 {
        self.velocities.last().copied().unwrap_or(0.0)
    }

    /// The stroboscopic map over the drive periods in which the settled motion was watched.
    pub fn watched_map(&self, scene: &CheckedScene) -> StroboscopicMap {
        StroboscopicMap::new(scene, self.length)
    }

    /// The kind of a settled motion that returns, with the order of its impacts; none if it does not.
    ///
    /// # Errors
    /// [`MotionError`] if it cannot be computed.
    pub fn returning_kind(&self, map: &StroboscopicMap) -> Result<Option<MotionKind>, MotionError> {
        let Some(regime) = self.regime() else {
            return Ok(None);
        };
        let scene = map.scene();
        let application = || map.apply(self.from.into());
        let frequency = scene.excitation.frequency;
        let is_slow = || self.from.velocity.abs() <= SAME * motion_size(frequency, [&self.from]);
        if regime.impacts == 0 && is_slow() && application()?.is_at_rest(&self.from, frequency) {
            return Ok(Some(MotionKind::Rest));
        }
        // Nothing chatters where nothing rebounds from a surface.
        let (lowest, highest) = scene.reach();
        let rests = match lowest.is_finite() || highest.is_finite() {
            true => application()?.rests,
            false => Vec::new(),
        };
        let order = ImpactPattern::new(&self.instants, &rests, self.length, scene.period());
        Ok(Some(MotionKind::from_regime(regime, order)))
    }

    /// The kind of a settled motion: chaos if it does not return and small differences have grown more than a hundredfold; and
    /// their growth then, ln of the tangent's norm per drive period.
    ///
    /// # Errors
    /// [`MotionError`] if it cannot be computed.
    pub fn motion_kind(
        &self,
        map: &StroboscopicMap,
    ) -> Result<(MotionKind, Option<f64>), MotionError> {
        if let Some(motion) = self.returning_kind(map)? {
            return Ok((motion, None));
        }
        let (motion, growth) = classify_wandering(map, self.from)?;
        Ok((motion, Some(growth / self.length as f64)))
    }

    /// Largest position in m of a settled motion while it was watched.
    ///
    /// # Errors
    /// [`MotionError`] if it cannot be computed.
    pub fn max_position(&self, map: &StroboscopicMap) -> Result<f64, MotionError> {
        map.max_position(self.from.into())
    }
}

/// The kind of a motion that does not return, chaos or unsettled, by the growth of small differences along a map from a state on:
/// ln of the norm of the tangent without units, which is returned, too.
///
/// # Errors
/// [`MotionError`] if it cannot be computed.
pub fn classify_wandering(
    map: &StroboscopicMap,
    from: Start,
) -> Result<(MotionKind, f64), MotionError> {
    let tangent = map.apply(from.into())?.monodromy;
    let growth = map.scene().scales().jacobian(&tangent).norm().ln();
    // A hundredfold growth.
    let motion = match growth > 2.0 * LN_10 {
        true => MotionKind::Chaos,
        false => MotionKind::Unsettled,
    };
    Ok((motion, growth))
}
