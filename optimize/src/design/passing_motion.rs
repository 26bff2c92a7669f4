//! The best motion along one zone that passes its trials.

use super::Design;
use super::problem::Objective;
use super::trial_search::{FEW_TRIES, HALVINGS, PLACES, TrialSearch};
use super::zoned::ZonedMachine;
use crate::order::sort_rising;

/// Relative distance from a score at which another is just above it, and steps to find that.
const JUST: f64 = 1e-4;
const SECANTS: usize = 4;
/// Places of a zone that are tried to find one that passes, if none is known elsewhere.
const TRIES: usize = 8;

impl TrialSearch<'_> {
    /// The best motion along the zone of a point of the unit cube that passes and is better than that.
    pub(super) fn along(&self, unit: &[f64], least: f64) -> Option<Design> {
        let problem = self.problem;
        let cases = problem.in_cases();
        let zoned = ZonedMachine::find(problem, &cases, &problem.axis_values(unit))?;
        let window = zoned.window().ok()?;
        let design = |place: f64| self.known.design(problem, zoned.at(place)?);
        let places = (0..=PLACES).map(|index| window.at(index as f64 / PLACES as f64));
        let motions: Vec<Option<Design>> = places.map(|place| zoned.at(place)).collect();
        let sampled = self.designs_above(least, motions);
        let pairs = sampled.windows(2);
        let pairs = pairs.filter_map(|pair| pair[0].as_ref().zip(pair[1].as_ref()));
        let crossings = pairs.filter_map(|pair| self.just_above(least, pair, design));
        let mut all: Vec<Design> = crossings.collect();
        let better = sampled.into_iter().flatten();
        all.extend(better.filter(|it| self.score(it) > least));
        sort_rising(&mut all, |it| self.score(it));
        let last = all.len().checked_sub(1)?;
        // The least of them pass most easily, but what is counted scatters; the best ends the search.
        let spread: Vec<usize> = match least > 0.0 {
            true => (0..=last).take(FEW_TRIES).collect(),
            false => (0..TRIES).map(|index| index * last / (TRIES - 1)).collect(),
        };
        let mut ascending = spread.into_iter();
        let mut low = ascending.rfind(|index| self.is_passed(&all[*index]))?;
        let mut high = all.len();
        while high - low > 1 {
            let middle = low.midpoint(high);
            match self.is_passed(&all[middle]) {
                true => low = middle,
                false => high = middle,
            }
        }
        // What is counted scatters: some of the next may pass again.
        let beyond = |low: usize| {
            let mut next = (low + 2..all.len()).take(FEW_TRIES);
            next.find(|index| self.is_passed(&all[*index]))
        };
        while let Some(next) = beyond(low) {
            (low, high) = (next, next + 1);
        }
        let next = all.get(high).cloned();
        let mut best = all.swap_remove(low);
        let Some(mut failing) = next else {
            return Some(best);
        };
        for _ in 0..HALVINGS {
            match design(0.5 * (best.place + failing.place)) {
                Some(middle) if self.score(&middle) <= self.score(&best) => break,
                Some(middle) if self.is_passed(&middle) => best = middle,
                Some(middle) => failing = middle,
                None => break,
            }
        }
        Some(best)
    }

    /// The designs of the motions along a zone whose own machine scores above `least`, and of those beside them, between which
    /// the zone crosses `least`. No other one can: a tolerance never raises a score.
    fn designs_above(&self, least: f64, motions: Vec<Option<Design>>) -> Vec<Option<Design>> {
        let Objective { figure, .. } = self.problem.objective;
        let is_above = |motion: &Option<Design>| {
            let motion = motion.as_ref();
            motion.is_some_and(|motion| {
                let own = self.problem.nominal_of(figure, motion);
                own.is_none_or(|own| self.problem.objective.score(own) > least)
            })
        };
        let above: Vec<bool> = motions.iter().map(is_above).collect();
        let is_beside = |index: usize| above[index.saturating_sub(1)..].iter().take(3);
        let all = motions.into_iter().enumerate();
        let designs = all.map(|(index, motion)| match is_beside(index).any(|it| *it) {
            true => self.known.design(self.problem, motion?),
            false => None,
        });
        designs.collect()
    }

    /// Between two motions of a zone, one whose score is above a bound by very little; none if both are on one side of it.
    fn just_above(
        &self,
        bound: f64,
        (one, other): (&Design, &Design),
        design: impl Fn(f64) -> Option<Design>,
    ) -> Option<Design> {
        let above = |it: &Design| self.score(it) - bound;
        let [mut low, mut high] = [one, other].map(|it| (it.place, above(it)));
        let mut found = None;
        for _ in 0..SECANTS {
            if low.1 > high.1 {
                (low, high) = (high, low);
            }
            if low.1 > 0.0 || high.1 <= JUST * bound {
                break;
            }
            let aim = 0.5 * JUST * bound;
            let share = (aim - low.1) / (high.1 - low.1);
            let middle = design(low.0 + share * (high.0 - low.0))?;
            let end = (middle.place, above(&middle));
            if end.1 > 0.0 {
                (high, found) = (end, Some(middle));
            } else {
                low = end;
            }
        }
        found
    }
}
