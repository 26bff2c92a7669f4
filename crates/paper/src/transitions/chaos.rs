//! Where chaos ends: by its lifetime.

use super::explorer::{Explorer, FIRST_MOTIONS, Gathering, is_clear, most};
use serde::{Deserialize, Serialize};
use softstop::Start;
use softstop_dynamics::attractors::Arrival;
use softstop_dynamics::monitor::recall_or_compute;
use softstop_dynamics::orbit::OrbitError;

/// Largest step of the parameter on the way, as a share of it.
const STRIDE: f64 = 2e-4;

/// So many times the motions of the rules are asked at most whether they last, those that do going on: as many as tell
/// the five digits that are printed.
const MAX_REQUESTS: usize = 32;

/// An end of chaos.
pub(super) struct ChaosEnd {
    /// Within this, half of the motions on it settle in the time given.
    pub value: f64,
    /// On what most of them settle.
    pub gathering: Gathering,
    /// Where that was seen.
    pub after: f64,
    /// The last value on the way there at which chaos lasts.
    pub before: f64,
}

/// What motions on chaos do in the time given.
#[derive(Serialize, Deserialize)]
pub(super) struct Lasting {
    /// Those that go on, and those that were not asked, if no fewer than half of the others last.
    pub wandering: Option<Vec<Start>>,
    /// True if it is clear whether that is more than half.
    is_clear: bool,
}

impl Explorer<'_> {
    /// What motions on chaos do at a value in the time given: some of them go first.
    pub(super) fn lasting(&self, value: f64, states: &[Start]) -> Result<Lasting, OrbitError> {
        let of = ("lasting", self.family.scene([value])?, states);
        recall_or_compute(self.kept, &of, || {
            let (mut states, mut still, mut all) = (states.to_vec(), 0, 0);
            loop {
                let mut going = self.fill(&states);
                let first = if all == 0 { FIRST_MOTIONS } else { going.len() };
                let waiting = going.split_off(first.min(going.len()));
                let arrivals = self.settle_at(value, &going, self.rules.lifetime)?;
                all += arrivals.len();
                let wandering = arrivals.iter().filter(|it| it.orbit.is_none());
                still += wandering.clone().count();
                states = waiting;
                states.extend(wandering.map(|it| it.state));
                let is_clear = is_clear(still, all);
                if is_clear || states.is_empty() || all >= MAX_REQUESTS * self.rules.motions {
                    return Ok(Lasting {
                        wandering: (2 * still >= all && !states.is_empty()).then_some(states),
                        is_clear,
                    });
                }
            }
        })
    }

    /// Follows chaos from a value on until it ends, or the range does. Where it is not clear any more whether half of
    /// the motions last, the end is known no better.
    pub(super) fn end_of_chaos(
        &self,
        value: f64,
        states: &[Start],
        rising: bool,
    ) -> Result<(f64, Option<ChaosEnd>), OrbitError> {
        let sign = if rising { 1.0 } else { -1.0 };
        let unit = value.abs();
        let width = self.rules.width * unit;
        let (mut good, mut states) = (value, states.to_vec());
        let mut step = 16.0 * width;
        let (mut bad, mut end) = (None, None);
        while bad.is_none_or(|bad: f64| (bad - good).abs() > width) {
            let next = match bad {
                Some(bad) => 0.5 * (good + bad),
                None => good + sign * step,
            };
            if !(self.range.0..=self.range.1).contains(&next) {
                return Ok((good, None));
            }
            let lasting = self.lasting(next, &states)?;
            if !lasting.is_clear {
                (end, bad) = (Some(next), bad.or(Some(next)));
                break;
            }
            match lasting.wandering {
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
        let arrivals: Vec<Arrival> =
            self.settle_at(after, &self.fill(&states), self.rules.patience)?;
        let settled = arrivals.into_iter().filter(|it| it.orbit.is_some());
        let end = ChaosEnd {
            value: end.unwrap_or(0.5 * (good + after)),
            gathering: most(settled.collect()),
            after,
            before: good,
        };
        Ok((good, Some(end)))
    }
}
