//! Catalogues: from the values that were found, those beside them are tried, each with everything else sought
//! anew, until none is better.

use std::collections::HashSet;

use rayon::prelude::*;
use softstop_console::interrupt;

use super::ascent::{ascend, ascend_from};
use super::coordinates::{Candidate, best_by};
use super::problem::Problem;
use super::robustify::{Robust, enforce};

/// How far along one catalogue values are tried; of two, both neighbours at once.
const FAR: usize = 3;
/// Share of a score that is no gain.
const GAIN: f64 = 1e-12;

/// The best design by exchange of values of catalogues.
pub(super) fn improve_catalogue(problem: &Problem, from: &Robust) -> Robust {
    let catalogues = Catalogues::of(problem);
    let score = |it: &Robust| problem.score(&it.candidate.design);
    let mut best = from.clone();
    let mut tried = HashSet::from([catalogues.places(&best.candidate.unit)]);
    loop {
        let beside = catalogues.beside(&best.candidate.unit).into_iter();
        let new: Vec<_> = beside
            .filter(|places| tried.insert(places.clone()))
            .collect();
        let sought = new.par_iter().filter_map(|places| {
            let unit = catalogues.unit(&best.candidate.unit, places);
            let warm = ascend_from(problem, &best.known, (&unit, best.candidate.design.place));
            let start: Candidate = warm.or_else(|| ascend(problem, &unit))?;
            enforce(problem, &start, best.known.clone()).ok()
        });
        let next = best_by(sought.collect::<Vec<_>>().into_iter().rev(), score);
        let least = (1.0 + GAIN) * score(&best);
        match next.filter(|next| score(next) > least) {
            Some(next) if !interrupt::requested() => best = next,
            _ => return best,
        }
    }
}

/// The coordinates of the cube that are catalogues, and how many values each has.
struct Catalogues(Vec<(usize, usize)>);

impl Catalogues {
    fn of(problem: &Problem) -> Self {
        let free = problem.free_axes();
        let sizes = free.map(|axis| axis.catalogue.len()).enumerate();
        Self(sizes.filter(|(_, size)| *size > 0).collect())
    }

    /// Which values a point has.
    fn places(&self, unit: &[f64]) -> Vec<usize> {
        let place = |(index, size): &(usize, usize)| {
            ((unit[*index].clamp(0.0, 1.0) * *size as f64) as usize).min(size - 1)
        };
        self.0.iter().map(place).collect()
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
    fn beside(&self, unit: &[f64]) -> Vec<Vec<usize>> {
        let own = self.places(unit);
        let moved = |steps: &[(usize, isize)]| {
            let mut places = own.clone();
            for (axis, step) in steps {
                let place = places[*axis].checked_add_signed(*step)?;
                places[*axis] = (place < self.0[*axis].1).then_some(place)?;
            }
            Some(places)
        };
        let axes = 0..own.len();
        let far = FAR as isize;
        let along = axes.clone().flat_map(|axis| {
            let steps = (-far..=far).filter(|step| *step != 0);
            steps
                .filter_map(move |step| moved(&[(axis, step)]))
                .collect::<Vec<_>>()
        });
        let pairs = axes
            .clone()
            .flat_map(|one| (one + 1..own.len()).map(move |other| (one, other)));
        let both = pairs.flat_map(|(one, other)| {
            let signs = [(-1, -1), (-1, 1), (1, -1), (1, 1)];
            signs
                .into_iter()
                .filter_map(move |(a, b)| moved(&[(one, a), (other, b)]))
                .collect::<Vec<_>>()
        });
        along.chain(both).collect()
    }
}
