//! Intermittent chaos beside the end of a motion (Pomeau and Manneville 1980): long stretches of drive periods in which a
//! motion has the order of impacts that another one has, between bursts.

use std::collections::VecDeque;

use super::explorer::Explorer;
use softstop::{CheckedScene, Instant, MotionError, Start};
use softstop_dynamics::StroboscopicMap;
use softstop_dynamics::internals::{Ensemble, HasMember, Member};
use softstop_dynamics::motion_kind::MotionKind;
use softstop_dynamics::orbit::{LyapunovExponents, Orbit, OrbitError};
use softstop_lanes::LoweredMachine;

/// Drive periods for which a motion is followed, and those between two looks at whether it has settled.
const ENDURANCE: u64 = 400_000;
const PERIODS_BETWEEN_LOOKS: u64 = 10_000;
/// Bursts after which it counts as chaos.
const BURSTS: usize = 3;
/// Least difference of a motion from the orbit, in units of its size.
const LEAST_DIFFERENCE: f64 = 1e-9;

impl Explorer<'_> {
    /// True if a motion near an orbit that has lost stability leaves it, is thrown back to it and leaves it
    /// again, several times over: Pomeau and Manneville's intermittency (1980), which the paper's ISN names.
    pub(super) fn is_intermittent(
        &self,
        value: f64,
        states: &[Start],
        motion: &MotionKind,
    ) -> Result<bool, OrbitError> {
        let (Some(periods), Some(&start)) = (motion.periods(), states.first()) else {
            return Ok(false);
        };
        let scene = self.family.scene([value])?;
        let leaves_in_time = Orbit::find_periodic(&scene, start.into(), periods)
            .is_ok_and(|orbit| BURSTS as f64 * leaving(&orbit) < ENDURANCE as f64);
        if !leaves_in_time {
            return Ok(false);
        }
        let ensemble = Ensemble::new(vec![LoweredMachine::new(&scene)], self.monitor);
        let member = Member::new(0, start);
        let mut calm = Stretches::new(member, &scene, start, periods, |it| {
            has_bursts(it) || it.since > it.longest.max(it.calm)
        })?;
        for _ in 0..ENDURANCE / PERIODS_BETWEEN_LOOKS {
            ensemble.advance_batch::<true, true, _>(&mut [&mut calm], PERIODS_BETWEEN_LOOKS)?;
            if let Some(error) = calm.member.error {
                return Err(error.into());
            }
            // It may not have come back for longer than it ever stayed, too.
            if (calm.is_known)(&calm) {
                return Ok(has_bursts(&calm));
            }
            let arrivals = self.settle_at(value, &[calm.member.state], 0)?;
            if arrivals.iter().any(|arrival| arrival.orbit.is_some()) {
                return Ok(false);
            }
        }
        Ok(false)
    }
}

/// True if stretches have ended over and over.
fn has_bursts(stretches: &Stretches) -> bool {
    stretches.lengths.len() >= BURSTS
}

/// Drive periods that a difference takes to grow to the size of the motion, from [`LEAST_DIFFERENCE`] of it.
fn leaving(orbit: &Orbit) -> f64 {
    let growth = LyapunovExponents::of(orbit).per_period[0];
    match growth > 0.0 {
        true => -LEAST_DIFFERENCE.ln() / growth,
        false => f64::INFINITY,
    }
}

/// Shortest stretch, in periods of the other motion, that is not chance.
const CALM: u64 = 5;

/// A motion and its stretches with the order of impacts of another one, from wherever that begins.
pub(crate) struct Stretches {
    pub member: Member,
    /// Those that are not chance, in drive periods; the first one begins where the motion was started, not where chaos
    /// throws it.
    pub lengths: Vec<u64>,
    /// Shortest one that counts.
    pub calm: u64,
    /// The longest one, the present one included.
    pub longest: u64,
    /// Drive periods since the last one.
    pub since: u64,
    /// Whether enough is known.
    pub is_known: fn(&Self) -> bool,
    /// Drive periods of the present one.
    length: u64,
    /// Impacts in each drive period of the other motion, twice in a row.
    twice: Vec<usize>,
    /// Those in the last drive periods of this one, and in the present.
    last: VecDeque<usize>,
    impacts: usize,
}

impl Stretches {
    /// None yet of a motion beside that of a scene from a state, which repeats after so many drive periods.
    pub fn new(
        member: Member,
        scene: &CheckedScene,
        mut start: Start,
        periods: u64,
        is_known: fn(&Self) -> bool,
    ) -> Result<Self, MotionError> {
        let map = StroboscopicMap::new(scene, 1);
        let mut order = Vec::new();
        for _ in 0..periods {
            let passage = map.apply(start.into())?;
            start = passage.end.into();
            order.push(passage.impacts.len());
        }
        Ok(Self {
            member,
            lengths: Vec::new(),
            calm: CALM * periods,
            longest: 0,
            since: 0,
            is_known,
            length: 0,
            twice: order.repeat(2),
            last: VecDeque::new(),
            impacts: 0,
        })
    }
}

impl HasMember for Stretches {
    fn member_mut(&mut self) -> &mut Member {
        &mut self.member
    }

    fn record_impact(&mut self, _: Instant, _: f64) {
        self.impacts += 1;
    }

    fn record_state(&mut self, _: Start) {
        let impacts = std::mem::take(&mut self.impacts);
        if (self.is_known)(self) {
            return;
        }
        self.last.push_back(impacts);
        let periods = self.twice.len() / 2;
        if self.last.len() > periods {
            self.last.pop_front();
        }
        let mut orders = self.twice.windows(periods);
        if orders.any(|order| self.last.iter().eq(order)) {
            self.length += 1;
            self.longest = self.longest.max(self.length);
            self.since = 0;
            return;
        }
        self.since += 1;
        let length = std::mem::take(&mut self.length);
        let is_calm = |length: &u64| *length >= self.calm;
        self.lengths.extend(Some(length).filter(is_calm));
    }
}
