//! Intermittent chaos beside the end of a motion: long stretches of the motion as it was, between bursts.

use std::collections::VecDeque;

use super::TransitionError;
use super::stage::Explorer;
use crate::continuation::Family;
use crate::motion::MotionKind;
use crate::orbit::{Exponents, Orbit, StroboscopicMap};
use softstop::Start;

/// Drive periods for which a motion is followed.
const ENDURANCE: u64 = 400_000;
/// Bursts after which it counts as chaos.
const BURSTS: usize = 3;
/// Least difference of a motion from the orbit, in units of its size.
const NEAR: f64 = 1e-9;
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
    ) -> Result<bool, TransitionError> {
        let (Some(periods), Some(start)) = (motion.periods(), states.first()) else {
            return Ok(false);
        };
        let scene = self.family.scene([value])?;
        let mut state = (*start).into();
        let leaves_in_time = Orbit::periodic(&scene, state, periods)
            .is_ok_and(|orbit| BURSTS as f64 * leaving(&orbit) < ENDURANCE as f64);
        if !leaves_in_time {
            return Ok(false);
        }
        let map = StroboscopicMap::new(&scene, 1)?;
        let mut calm = Calm {
            periods: periods as usize,
            ..Calm::default()
        };
        for _ in 0..ENDURANCE {
            let passage = map.apply(state)?;
            state = passage.end;
            calm.enter(passage.impacts.len());
            if calm.bursts >= BURSTS {
                return Ok(true);
            }
            if calm.is_elsewhere {
                return Ok(false);
            }
        }
        Ok(false)
    }
}

/// Drive periods that a difference takes to grow to the size of the motion, from [`NEAR`] of it.
fn leaving(orbit: &Orbit) -> f64 {
    let growth = Exponents::of(orbit).per_period[0];
    match growth > 0.0 {
        true => -NEAR.ln() / growth,
        false => f64::INFINITY,
    }
}

/// Counts how often the order of impacts ceases to be that of the first period.
#[derive(Default)]
struct Calm {
    /// Impacts in each of the last drive periods.
    last: VecDeque<usize>,
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

impl Calm {
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
