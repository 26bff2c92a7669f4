//! Values of catalogues far from those with which every design fails its trials: the farthest from all that were tried first,
//! as they are; from one that passes on those between it and a better one that fails, and those beside it. At last a design
//! that passes is sought from those that lack least.

use softstop_console::interrupt;
use softstop_dynamics::parallel;

use super::check_trials::TriedDesigns;
use super::coordinates::best_by;
use super::improve_catalogue::Catalogues;
use super::robustify::RobustDesign;
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

/// Tries designs with choices from catalogues far from those that were tried.
pub(super) fn try_distant_values(tried: &mut TriedDesigns<'_>) {
    let catalogues = Catalogues::of(tried.problem);
    let Some(first) = tried.failed.first() else {
        return;
    };
    let known = tried.failed.len();
    let choices = tried.failed.iter();
    let choices = choices.map(|it| catalogues.places(&it.robust.candidate.unit));
    let mut distant = DistantValues {
        from: first.robust.clone(),
        choices: choices.collect(),
        catalogues,
        tried,
    };
    distant.try_farthest();
    distant.try_between();
    distant.try_beside();
    let (least, is_any) = (tried.least(), !tried.passing.is_empty());
    let is_near = |index: &usize| {
        let failed = &tried.failed[*index];
        tried.score(&failed.robust) > least && !(is_any && failed.lack.gap > SMALL_GAP)
    };
    let mut near: Vec<usize> = (known..tried.failed.len()).filter(is_near).collect();
    sort_rising(&mut near, |index| tried.failed[*index].lack.gap);
    for index in near.into_iter().take(SOUGHT) {
        let score = tried.score(&tried.failed[index].robust);
        if !interrupt::requested() && score > tried.least() {
            tried.seek_from(index);
        }
    }
}

struct DistantValues<'a, 'b> {
    tried: &'a mut TriedDesigns<'b>,
    catalogues: Catalogues,
    /// Choices that were tried.
    choices: Vec<Vec<usize>>,
    /// The best design that fails, from which those with other choices are sought.
    from: RobustDesign,
}

impl DistantValues<'_, '_> {
    /// Tries the choices that are farthest from those that were tried, until one passes.
    fn try_farthest(&mut self) {
        let all = self.catalogues.all();
        for _ in 0..DISTANT {
            let is_new = |it: &&Vec<usize>| !self.choices.contains(it);
            let distance = |it: &&Vec<usize>| {
                let choices = self.choices.iter();
                let each = choices.map(|other| self.catalogues.distance(it, other));
                each.fold(f64::INFINITY, f64::min)
            };
            let Some(next) = best_by(all.iter().filter(is_new).rev(), distance) else {
                return;
            };
            self.try_choice(next.clone());
            if !self.tried.passing.is_empty() || interrupt::requested() {
                return;
            }
        }
    }

    /// Tries what lies in the middle between the best design that passes and the nearest better one that fails, until nothing
    /// does.
    fn try_between(&mut self) {
        while let Some(best) = self.tried.best() {
            let (least, best) = (self.tried.least(), self.choice_of(best));
            let failed = self.tried.failed.iter().map(|it| &it.robust);
            let better = failed.filter(|it| self.tried.score(it) > least);
            let better = better.map(|it| self.choice_of(it));
            let nearest = best_by(better, |it| -self.catalogues.distance(it, &best));
            let Some(nearest) = nearest else { return };
            let pairs = best.iter().zip(nearest);
            let middle: Vec<usize> = pairs.map(|(one, other)| one.midpoint(other)).collect();
            if self.choices.contains(&middle) || interrupt::requested() {
                return;
            }
            self.try_choice(middle);
        }
    }

    /// Tries the best of the choices beside the best design that passes, until none is better.
    fn try_beside(&mut self) {
        for _ in 0..BETTERED {
            let Some(best) = self.tried.best() else {
                return;
            };
            let (tried, least) = (&*self.tried, self.tried.least());
            let beside = self.catalogues.beside(&best.candidate.unit).into_iter();
            let new: Vec<_> = beside.filter(|it| !self.choices.contains(it)).collect();
            let mut better = parallel::filter_map(&new, |it| {
                let design = self.catalogues.design_at(tried.problem, &self.from, it)?;
                (tried.score(&design) > least).then_some((it.clone(), design))
            });
            sort_falling(&mut better, |(_, it)| tried.score(it));
            better.truncate(TRIED_BESIDE);
            let passes = better.into_iter().any(|(choice, design)| {
                self.choices.push(choice);
                !interrupt::requested() && self.tried.try_as_is(design)
            });
            if !passes {
                return;
            }
        }
    }

    /// The choice of a design.
    fn choice_of(&self, it: &RobustDesign) -> Vec<usize> {
        self.catalogues.places(&it.candidate.unit)
    }

    /// Makes the trials of the best design with a choice, if there is one.
    fn try_choice(&mut self, choice: Vec<usize>) {
        let problem = self.tried.problem;
        let design = self.catalogues.design_at(problem, &self.from, &choice);
        self.choices.push(choice);
        if let Some(design) = design {
            self.tried.try_as_is(design);
        }
    }
}
