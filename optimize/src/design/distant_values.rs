//! Values of catalogues far from those with which every design fails its trials: the farthest from all that were tried first,
//! as they are; from one that passes on those between it and a better one that fails, and those beside it. At last a design
//! that passes is sought from those that lack least.

use softstop_console::interrupt;
use softstop_dynamics::parallel;

use super::check_trials::{Checked, Passed, check_trials};
use super::coordinates::{SearchStart, best_by};
use super::improve_catalogue::Catalogues;
use super::robustify::Robust;
use crate::order::{sort_falling, sort_rising};

/// Choices far from the others whose trials are made, at most, until a design passes.
const DISTANT: usize = 16;
/// How often the best that passes is bettered by choices beside it, of which so many are tried.
const BETTERED: usize = 16;
const TRIED_BESIDE: usize = 3;
/// Designs that fail from which one that passes is sought, at most.
const SOUGHT: usize = 2;
/// What these lack at most where another passes, in units of the bound.
const SMALL_GAP: f64 = 0.5;

/// Takes note of designs with choices from catalogues far from those that were tried.
pub(super) fn check_distant_values(checked: &mut Checked<'_>, sought_from: &mut Vec<SearchStart>) {
    let catalogues = Catalogues::of(checked.problem);
    let Some((from, _)) = checked.failed.first().cloned() else {
        return;
    };
    let tried = checked.failed.iter();
    let tried = tried.map(|(it, _)| catalogues.places(&it.candidate.unit));
    let known = checked.failed.len();
    let mut distant = DistantValues {
        tried: tried.collect(),
        catalogues,
        checked,
        from,
    };
    distant.try_farthest();
    distant.try_between();
    distant.try_beside();
    let sought = distant.checked.failed.split_off(known);
    let least = checked.least();
    let is_any = !checked.passing.is_empty();
    let (mut better, others): (Vec<_>, Vec<_>) = sought
        .into_iter()
        .partition(|(it, lack)| checked.score(it) > least && !(is_any && lack.gap > SMALL_GAP));
    sort_rising(&mut better, |(_, lack)| lack.gap);
    let rest = better.split_off(SOUGHT.min(better.len()));
    for (mut design, lack) in better {
        let is_over = interrupt::requested() || checked.score(&design) <= checked.least();
        let passed = match is_over {
            true => Err(lack),
            false => check_trials(checked.problem, &mut design, sought_from),
        };
        checked.note(design, passed);
    }
    checked.failed.extend(rest.into_iter().chain(others));
}

struct DistantValues<'a, 'b> {
    checked: &'a mut Checked<'b>,
    catalogues: Catalogues,
    /// Choices that were tried.
    tried: Vec<Vec<usize>>,
    /// The best design that fails, from which those with other choices are sought.
    from: Robust,
}

impl DistantValues<'_, '_> {
    /// Tries the choices that are farthest from those that were tried, until one passes.
    fn try_farthest(&mut self) {
        let all = self.catalogues.all();
        for _ in 0..DISTANT {
            let is_new = |it: &&Vec<usize>| !self.tried.contains(it);
            let distance = |it: &&Vec<usize>| {
                let tried = self.tried.iter();
                let each = tried.map(|other| self.catalogues.distance(it, other));
                each.fold(f64::INFINITY, f64::min)
            };
            let Some(next) = best_by(all.iter().filter(is_new).rev(), distance) else {
                return;
            };
            self.try_choice(next.clone());
            if !self.checked.passing.is_empty() || interrupt::requested() {
                return;
            }
        }
    }

    /// Tries what lies in the middle between the best design that passes and the nearest better one that fails, until nothing
    /// does.
    fn try_between(&mut self) {
        while let Some(best) = self.best_places() {
            let least = self.checked.least();
            let failed = self.checked.failed.iter().map(|(it, _)| it);
            let better = failed.filter(|it| self.checked.score(it) > least);
            let better = better.map(|it| self.catalogues.places(&it.candidate.unit));
            let distance = |it: &Vec<usize>| -self.catalogues.distance(it, &best);
            let Some(nearest) = best_by(better, distance) else {
                return;
            };
            let middle = best.iter().zip(nearest);
            let middle: Vec<usize> = middle.map(|(one, other)| one.midpoint(other)).collect();
            if self.tried.contains(&middle) || interrupt::requested() {
                return;
            }
            self.try_choice(middle);
        }
    }

    /// Tries the best of the choices beside the best design that passes, until none is better.
    fn try_beside(&mut self) {
        for _ in 0..BETTERED {
            let Some(best) = self.best_unit() else {
                return;
            };
            let beside = self.catalogues.beside(&best).into_iter();
            let new: Vec<_> = beside.filter(|it| !self.tried.contains(it)).collect();
            let (checked, least) = (&*self.checked, self.checked.least());
            let mut better = parallel::filter_map(&new, |it| {
                let design = self.catalogues.design_at(checked.problem, &self.from, it)?;
                (checked.score(&design) > least).then_some((it.clone(), design))
            });
            sort_falling(&mut better, |(_, it)| checked.score(it));
            better.truncate(TRIED_BESIDE);
            let passes = better.into_iter().any(|(places, design)| {
                self.tried.push(places);
                !interrupt::requested() && self.try_design(design)
            });
            if !passes {
                return;
            }
        }
    }

    /// The point of the best design that passes, in the unit cube.
    fn best_unit(&self) -> Option<Vec<f64>> {
        let all = self.checked.passing.iter().map(|it| &it.robust);
        let best = best_by(all, |it| self.checked.score(it))?;
        Some(best.candidate.unit.clone())
    }

    /// The choice of the best design that passes.
    fn best_places(&self) -> Option<Vec<usize>> {
        Some(self.catalogues.places(&self.best_unit()?))
    }

    /// Makes the trials of the best design with a choice, if there is one.
    fn try_choice(&mut self, places: Vec<usize>) {
        let problem = self.checked.problem;
        let design = self.catalogues.design_at(problem, &self.from, &places);
        self.tried.push(places);
        if let Some(design) = design {
            self.try_design(design);
        }
    }

    /// Makes the trials of a design: true if it passes.
    fn try_design(&mut self, mut design: Robust) -> bool {
        let problem = self.checked.problem;
        let passed = problem.pass_trials(&design.candidate.design, &mut design.known);
        let passed = passed.map(|tried| Passed::as_is(design.clone(), tried));
        let is_passed = passed.is_ok();
        self.checked.note(design, passed);
        is_passed
    }
}
