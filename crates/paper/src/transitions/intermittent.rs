//! Intermittent chaos beside the end of a motion: long stretches of the motion as it was, between bursts.

use std::collections::VecDeque;

use super::explorer::Explorer;
use softstop::Start;
use softstop_dynamics::continuation::Family;
use softstop_dynamics::internals::follow_batch;
use softstop_dynamics::motion::MotionKind;
use softstop_dynamics::orbit::{Exponents, Orbit, OrbitError};
use softstop_lanes::{BatchObserver, Machine};

/// Drive periods for which a motion is followed, and those between two looks at whether it has settled.
const ENDURANCE: u64 = 400_000;
const PERIODS_BETWEEN_LOOKS: u64 = 10_000;
/// Bursts after which it counts as chaos.
const BURSTS: usize = 3;
/// Least difference of a motion from the orbit, in units of its size.
const LEAST_DIFFERENCE: f64 = 1e-9;
/// Periods of the old motion in a row that tell it from chance.
const CALM: u64 = 5;

impl<F: Family + Sync> Explorer<'_, F> {
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
        let leaves_in_time = Orbit::periodic(&scene, (*start).into(), periods)
            .is_ok_and(|orbit| BURSTS as f64 * leaving(&orbit) < ENDURANCE as f64);
        if !leaves_in_time {
            return Ok(false);
        }
        let machine = [Machine::new(&scene)?];
        let mut calm = BurstCounter {
            periods: periods as usize,
            ..BurstCounter::default()
        };
        let mut state = *start;
        for _ in 0..ENDURANCE / PERIODS_BETWEEN_LOOKS {
            let ask = || (self.monitor)(0, 0);
            let motion = std::iter::once((0, state, PERIODS_BETWEEN_LOOKS));
            let outcomes =
                follow_batch(&machine, motion, &mut calm, ask).ok_or(OrbitError::Stopped)?;
            for outcome in outcomes {
                outcome.error.map_or(Ok(()), Err)?;
                state = outcome.end;
            }
            if let Some(is_intermittent) = calm.verdict() {
                return Ok(is_intermittent);
            }
            let arrivals = self.settle_at(value, &[state], 0)?;
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

/// Counts how often the order of impacts ceases to be that of the first period.
#[derive(Default)]
struct BurstCounter {
    /// Impacts in each of the last drive periods.
    last: VecDeque<usize>,
    /// Impacts in the present one.
    impacts: usize,
    /// Drive periods of the motion.
    periods: usize,
    /// The first of its periods.
    pattern: Vec<usize>,
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

impl BatchObserver for BurstCounter {
    const IMPACTS: bool = true;
    const PERIODS: bool = true;

    fn impact(&mut self, _: usize, _: u64, _: f64, _: f64) {
        self.impacts += 1;
    }

    fn period(&mut self, _: usize, _: u64, _: Start) {
        let impacts = std::mem::take(&mut self.impacts);
        if self.verdict().is_none() {
            self.enter(impacts);
        }
    }
}

impl BurstCounter {
    /// Whether there are bursts over and over, once that is known.
    fn verdict(&self) -> Option<bool> {
        let is_known = self.bursts >= BURSTS || self.is_elsewhere;
        is_known.then_some(self.bursts >= BURSTS)
    }

    fn enter(&mut self, impacts: usize) {
        self.last.push_back(impacts);
        if self.last.len() < self.periods {
            return;
        }
        if self.last.len() > self.periods {
            self.last.pop_front();
        }
        if self.pattern.is_empty() {
            self.pattern = self.last.iter().copied().collect();
        }
        if self.is_old() {
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

    /// True if the last periods show the motion's order of impacts, from wherever it begins.
    fn is_old(&self) -> bool {
        let orders = [&self.pattern[..]; 2].concat();
        let mut orders = orders.windows(self.periods);
        orders.any(|order| self.last.iter().eq(order))
    }
}
