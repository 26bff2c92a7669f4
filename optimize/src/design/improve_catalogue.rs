//! Catalogues: from the values that were found, those beside them are tried, each with everything else sought
//! anew, until none is better. Where the best design fails its trials, the next best is taken, and what stands beside that.

use std::collections::HashSet;

use softstop_console::interrupt;
use softstop_dynamics::parallel;

use super::ascent::{ascend, ascend_from};
use super::coordinates::{Candidate, best_by};
use super::problem::Problem;
use super::robustify::{RobustDesign, enforce};

/// How far along one catalogue values are tried; of two, both neighbours at once.
const FAR: isize = 3;
/// Choices from catalogues that are listed, at most.
const MAX_CHOICES: usize = 4096;
/// A prime that is larger than any catalogue: Knuth's multiplicative hash.
const STRIDE: u128 = 2_654_435_761;
/// Share of a score that is no gain.
const GAIN: f64 = 1e-12;

/// Designs that keep their box of tolerances, each the best of its values of catalogues, from the best one on.
pub(super) struct CatalogueSearch<'a> {
    problem: &'a Problem,
    catalogues: Catalogues,
    /// The values that were tried.
    tried: HashSet<Vec<usize>>,
    /// The designs of these that were not taken.
    found: Vec<RobustDesign>,
}

impl<'a> CatalogueSearch<'a> {
    pub(super) fn new(problem: &'a Problem, from: RobustDesign) -> Self {
        let catalogues = Catalogues::of(problem);
        Self {
            problem,
            tried: HashSet::from([catalogues.places(&from.candidate.unit)]),
            catalogues,
            found: vec![from],
        }
    }

    fn score(&self, it: &RobustDesign) -> f64 {
        self.problem.score(&it.candidate.design)
    }

    /// The best design that was not taken, none of those with values beside its own being better; none where its score is not
    /// above a bound.
    pub(super) fn take_best(&mut self, bound: f64) -> Option<RobustDesign> {
        loop {
            let places = 0..self.found.len();
            let best = best_by(places.rev(), |place| self.score(&self.found[*place]))?;
            let best = self.found.remove(best);
            let least = (1.0 + GAIN) * self.score(&best);
            if self.score(&best) <= bound {
                return None;
            }
            let beside = self.seek_beside(&best);
            let is_better = beside.iter().any(|it| self.score(it) > least);
            self.found.extend(beside);
            if !is_better || interrupt::requested() {
                return Some(best);
            }
            self.found.push(best);
        }
    }

    /// The best designs with the untried values beside those of a design.
    fn seek_beside(&mut self, from: &RobustDesign) -> Vec<RobustDesign> {
        let beside = self.catalogues.beside(&from.candidate.unit).into_iter();
        let new: Vec<_> = beside
            .filter(|places| self.tried.insert(places.clone()))
            .collect();
        parallel::filter_map(&new, |places| {
            self.catalogues.design_at(self.problem, from, places)
        })
    }
}

/// The coordinates of the cube that are catalogues, and how many values each has.
pub(super) struct Catalogues(Vec<(usize, usize)>);

impl Catalogues {
    pub(super) fn of(problem: &Problem) -> Self {
        let free = problem.free_axes();
        let sizes = free.map(|axis| axis.catalogue.len()).enumerate();
        Self(sizes.filter(|(_, size)| *size > 0).collect())
    }

    /// How many choices there are.
    pub(super) fn count(&self) -> usize {
        let sizes = self.0.iter().map(|(_, size)| *size);
        sizes.fold(1, usize::saturating_mul)
    }

    /// All choices of a value from each, or so many of them, spread over their order by a stride that shares no factor with their
    /// number, so that each value is in some.
    pub(super) fn all(&self) -> Vec<Vec<usize>> {
        let count = self.count();
        let listed = count.min(MAX_CHOICES);
        let choice = |index: usize| {
            let mut rest = (index as u128 * STRIDE % count as u128) as usize;
            let place = |(_, size): &(usize, usize)| {
                let place = rest % size;
                rest /= size;
                place
            };
            self.0.iter().map(place).collect()
        };
        (0..listed).map(choice).collect()
    }

    /// How far two choices are apart, in units of the lengths of the catalogues.
    pub(super) fn distance(&self, one: &[usize], other: &[usize]) -> f64 {
        let all = self.0.iter().zip(one).zip(other);
        let parts = all.map(|(((_, size), one), other)| one.abs_diff(*other) as f64 / *size as f64);
        parts.map(|part| part * part).sum::<f64>().sqrt()
    }

    /// The best design with a choice that keeps its box of tolerances, sought from one with another; none if none is met.
    pub(super) fn design_at(
        &self,
        problem: &Problem,
        RobustDesign { candidate, known }: &RobustDesign,
        places: &[usize],
    ) -> Option<RobustDesign> {
        let unit = self.unit(&candidate.unit, places);
        let warm = ascend_from(problem, known, (&unit, candidate.design.place));
        let start: Candidate = warm.or_else(|| ascend(problem, &unit))?;
        enforce(problem, &start, known.clone()).ok()
    }

    /// Which values a point has.
    pub(super) fn places(&self, unit: &[f64]) -> Vec<usize> {
        let place = |(index, size): &(usize, usize)| {
            ((unit[*index].clamp(0.0, 1.0) * *size as f64) as usize).min(size - 1)
        };
        self.0.iter().map(place).collect()
    }

    /// The points with every choice, as far as they are listed, that have the other coordinates of one.
    pub(super) fn units(&self, unit: &[f64]) -> Vec<Vec<f64>> {
        let all = self.all().into_iter();
        all.map(|places| self.unit(unit, &places)).collect()
    }

    /// A point with other values.
    fn unit(&self, unit: &[f64], places: &[usize]) -> Vec<f64> {
        let mut unit = unit.to_vec();
        for ((index, size), place) in self.0.iter().zip(places) {
            unit[*index] = (*place as f64 + 0.5) / *size as f64;
        }
        unit
    }

    /// The values beside those of a point.
    pub(super) fn beside(&self, unit: &[f64]) -> Vec<Vec<usize>> {
        let own = self.places(unit);
        let moved = |steps: Vec<(usize, isize)>| {
            let mut places = own.clone();
            for (axis, step) in steps {
                let place = places[axis].checked_add_signed(step)?;
                places[axis] = (place < self.0[axis].1).then_some(place)?;
            }
            Some(places)
        };
        let axes = 0..own.len();
        let along = axes
            .clone()
            .flat_map(|axis| (-FAR..=FAR).map(move |step| vec![(axis, step)]));
        let signs = [(-1, -1), (-1, 1), (1, -1), (1, 1)];
        let pairs = axes.flat_map(|one| (one + 1..own.len()).map(move |other| (one, other)));
        let both = pairs.flat_map(|(one, other)| signs.map(|(a, b)| vec![(one, a), (other, b)]));
        let all = along.chain(both).filter_map(moved);
        all.filter(|it| *it != own).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::{Catalogues, MAX_CHOICES};

    #[test]
    fn each_value_is_in_some_of_the_choices() {
        for sizes in [
            vec![3, 5],
            vec![16; 4],
            vec![128; 2],
            vec![2; 13],
            vec![32; 3],
        ] {
            let choices = Catalogues(sizes.iter().copied().enumerate().collect()).all();
            let count = sizes.iter().product::<usize>().min(MAX_CHOICES);
            let mut different = choices.clone();
            different.sort();
            different.dedup();
            assert_eq!(different.len(), count);
            for (axis, size) in sizes.into_iter().enumerate() {
                let has = |value: &usize| choices.iter().any(|it| it[axis] == *value);
                assert!((0..size).all(|value| has(&value)), "{axis} of {size}");
            }
        }
    }
}
