//! Where chaos ends: by its lifetime.

use super::TransitionError;
use super::stage::{Explorer, Gathering, most};
use crate::attractors::Arrival;
use crate::continuation::Family;
use crate::motion::MotionKind;
use crate::orbit::Orbit;
use crate::watch::piece;
use softstop::Start;

/// Largest step of the parameter on the way, as a share of it.
const STRIDE: f64 = 2e-4;

/// Standard deviations by which more or fewer than half of the motions last, or else more are asked, those that last
/// going on; and so many times the motions of one look at most.
const SURE: f64 = 4.0;
const MOST: usize = 64;

/// An end of chaos.
pub(super) struct ChaosEnd {
    /// Within this, half of the motions on it settle in the time given.
    pub value: f64,
    /// On what most of them settle.
    pub gathering: Gathering,
    /// Where that was seen.
    pub after: f64,
}

impl<F: Family + Sync> Explorer<'_, F> {
    /// Motions that still wander at a value after the time given; none if half of them do not.
    pub(super) fn lasting(
        &self,
        value: f64,
        states: &[Start],
    ) -> Result<Option<Vec<Start>>, TransitionError> {
        let of = ("lasting", self.family.scene([value])?, states);
        piece(self.kept, &of, || {
            let (mut states, mut still, mut all) = (states.to_vec(), 0, 0);
            loop {
                let arrivals = self.hold(value, &self.fill(&states), self.rules.lifetime)?;
                all += arrivals.len();
                let wandering = arrivals.iter().filter(|it| it.orbit.is_none());
                states = wandering.map(|it| it.state).collect();
                still += states.len();
                let lead = 2.0 * still as f64 - all as f64;
                let is_clear = lead.abs() > SURE * (all as f64).sqrt();
                if is_clear || states.is_empty() || all >= MOST * self.rules.motions {
                    return Ok((lead >= 0.0 && !states.is_empty()).then_some(states));
                }
            }
        })
    }

    /// Follows chaos from a value on until it ends, or the range does.
    pub(super) fn end_of_chaos(
        &self,
        value: f64,
        states: &[Start],
        rising: bool,
    ) -> Result<(f64, Option<ChaosEnd>), TransitionError> {
        let sign = if rising { 1.0 } else { -1.0 };
        let unit = value.abs();
        let width = self.rules.width * unit;
        let (mut good, mut states) = (value, states.to_vec());
        let mut step = 16.0 * width;
        let mut bad = None;
        while bad.is_none_or(|bad: f64| (bad - good).abs() > width) {
            let next = match bad {
                Some(bad) => 0.5 * (good + bad),
                None => good + sign * step,
            };
            if !(self.range.0..=self.range.1).contains(&next) {
                return Ok((good, None));
            }
            match self.lasting(next, &states)? {
                Some(wandering) => {
                    (good, states) = (next, wandering);
                    step = (2.0 * step).min(STRIDE * unit);
                }
                None => bad = Some(next),
            }
        }
        let Some(after) = bad else {
            return Ok((good, None));
        };
        let arrivals: Vec<Arrival> = self.hold(after, &self.fill(&states), self.rules.patience)?;
        let settled = arrivals.into_iter().filter(|it| it.orbit.is_some());
        let end = ChaosEnd {
            value: 0.5 * (good + after),
            gathering: most(settled.collect()),
            after,
        };
        Ok((good, Some(end)))
    }
}

impl ChaosEnd {
    /// The orbit on which most settle.
    pub fn target(&self) -> Option<(&MotionKind, &Orbit)> {
        let Gathering { motion, orbit, .. } = &self.gathering;
        motion.as_ref().zip(orbit.as_ref())
    }
}
