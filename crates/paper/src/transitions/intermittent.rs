//! Intermittent chaos beside the end of a motion: long stretches of the motion as it was, between bursts.

use super::ImpactOrder;
use super::explorer::Explorer;
use softstop::{Instant, Start};
use softstop_dynamics::internals::{Ensemble, HasMember, Member};
use softstop_dynamics::motion::MotionKind;
use softstop_dynamics::orbit::{Exponents, Orbit, OrbitError};
use softstop_lanes::Machine;

/// Drive periods for which a motion is followed, and those between two looks at whether it has settled.
const ENDURANCE: u64 = 400_000;
const PERIODS_BETWEEN_LOOKS: u64 = 10_000;
/// Bursts after which it counts as chaos.
const BURSTS: usize = 3;
/// Least difference of a motion from the orbit, in units of its size.
const LEAST_DIFFERENCE: f64 = 1e-9;
/// Periods of the old motion in a row that tell it from chance.
const CALM: u64 = 5;

impl Explorer<'_> {
    /// True if a motion near an orbit that has lost stability leaves it, is thrown back to it and leaves it
    /// again, several times over: Pomeau and Manneville's intermittency (1980), which the paper's ISN names.
    pub(super) fn is_intermittent(
        &self,
        value: f64,
        states: &[Start],
        motion: &MotionKind,
    ) -> Result<bool, OrbitError> {
        let (Some(periods), Some(start)) = (motion.periods(), states.first()) else {
            return Ok(false);
        };
        let scene = self.family.scene([value])?;
        let leaves_in_time = Orbit::find_periodic(&scene, (*start).into(), periods)
            .is_ok_and(|orbit| BURSTS as f64 * leaving(&orbit) < ENDURANCE as f64);
        if !leaves_in_time {
            return Ok(false);
        }
        let ensemble = Ensemble::new(vec![Machine::new(&scene)], self.monitor);
        let mut calm = BurstCounter::new(*start, periods as usize);
        for _ in 0..ENDURANCE / PERIODS_BETWEEN_LOOKS {
            ensemble.advance_batch::<true, true, _>(&mut [&mut calm], PERIODS_BETWEEN_LOOKS)?;
            if let Some(error) = calm.member.error {
                return Err(error.into());
            }
            if let Some(is_intermittent) = calm.verdict() {
                return Ok(is_intermittent);
            }
            let arrivals = self.settle_at(value, &[calm.member.state], 0)?;
            if arrivals.iter().any(|arrival| arrival.orbit.is_some()) {
                return Ok(false);
            }
        }
        Ok(false)
    }
}

/// Drive periods that a difference takes to grow to the size of the motion, from [`LEAST_DIFFERENCE`] of it.
fn leaving(orbit: &Orbit) -> f64 {
    let growth = Exponents::of(orbit).per_period[0];
    match growth > 0.0 {
        true => -LEAST_DIFFERENCE.ln() / growth,
        false => f64::INFINITY,
    }
}

/// Counts how often the order of impacts of a motion ceases to be that of its first period.
struct BurstCounter {
    member: Member,
    /// Impacts in the present drive period.
    impacts: usize,
    /// Drive periods of the motion, and the impacts in each of the first of them.
    periods: usize,
    first: Vec<usize>,
    /// Their order, once they are all there.
    order: Option<ImpactOrder>,
    /// Drive periods for which the order has been that of the motion.
    length: u64,
    /// The longest such stretch.
    longest: u64,
    /// Drive periods since the last one.
    since: u64,
    bursts: usize,
    /// True if the motion has not come back for longer than it ever stayed.
    is_elsewhere: bool,
}

impl HasMember for BurstCounter {
    fn member_mut(&mut self) -> &mut Member {
        &mut self.member
    }

    fn record_impact(&mut self, _: Instant, _: f64) {
        self.impacts += 1;
    }

    fn record_state(&mut self, _: Start) {
        let impacts = std::mem::take(&mut self.impacts);
        if self.verdict().is_none() {
            self.enter(impacts);
        }
    }
}

impl BurstCounter {
    fn new(start: Start, periods: usize) -> Self {
        Self {
            member: Member::new(0, start),
            impacts: 0,
            periods,
            first: Vec::new(),
            order: None,
            length: 0,
            longest: 0,
            since: 0,
            bursts: 0,
            is_elsewhere: false,
        }
    }

    /// Whether there are bursts over and over, once that is known.
    fn verdict(&self) -> Option<bool> {
        let is_known = self.bursts >= BURSTS || self.is_elsewhere;
        is_known.then_some(self.bursts >= BURSTS)
    }

    fn enter(&mut self, impacts: usize) {
        if self.first.len() < self.periods {
            self.first.push(impacts);
        }
        if self.first.len() < self.periods {
            return;
        }
        let goes_on = match &mut self.order {
            Some(order) => order.goes_on(impacts),
            none => {
                let order = none.insert(ImpactOrder::new(&self.first));
                self.first.iter().fold(false, |_, it| order.goes_on(*it))
            }
        };
        if goes_on {
            self.length += 1;
            self.longest = self.longest.max(self.length);
            self.since = 0;
            return;
        }
        if self.length >= CALM * self.periods as u64 {
            self.bursts += 1;
        }
        self.length = 0;
        self.since += 1;
        self.is_elsewhere = self.since > self.longest.max(CALM * self.periods as u64);
    }
}
