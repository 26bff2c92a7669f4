//! Which of the designs that a search has found pass their trials; from one that fails, one that passes is sought
//! (`trial_search`).

use std::collections::HashSet;

use super::Infeasible;
use super::coordinates::SearchStart;
use super::improve_catalogue::Catalogues;
use super::judge::Met;
use super::problem::Problem;
use super::robustify::{Robust, look};
use super::trial_search::{RESOLUTION, Resolution, Trials};
use crate::order::sort_falling;

/// How often what is lost within the tolerances of what was found, or fails there, is taken note of.
const ROUNDS: usize = 8;

/// A design that passes its trials.
pub(super) struct Passed {
    pub robust: Robust,
    /// What it has of what is tried.
    pub tried: Vec<Met>,
    /// How fine it was looked for, if it was sought.
    pub resolution: Option<Resolution>,
}

impl Passed {
    /// A design that passes as it is.
    pub(super) const fn as_is(robust: Robust, tried: Vec<Met>) -> Self {
        Self {
            robust,
            tried,
            resolution: None,
        }
    }
}

/// Why no design passes its trials.
pub(super) struct Refusal {
    /// What the one that lacks least lacks.
    pub lack: Infeasible,
    /// Its point of the unit cube, if it was looked at.
    pub unit: Option<Vec<f64>>,
    /// Choices from catalogues with which trials were made, and all; none if nothing is chosen, or no trials were made.
    pub choices: Option<[usize; 2]>,
}

impl From<Infeasible> for Refusal {
    fn from(lack: Infeasible) -> Self {
        Self {
            lack,
            unit: None,
            choices: None,
        }
    }
}

/// The best design that passes its trials: this one if it does, otherwise one that is sought from it, unless that was done from
/// its place before. Adds its place to those from which one was sought, unless that ended with machines to take note of: with
/// others known it may end elsewhere.
///
/// # Errors
/// [`Infeasible`] if none was met: what this design fails.
pub(super) fn check_trials(
    problem: &Problem,
    held: &mut Robust,
    sought_from: &mut Vec<SearchStart>,
) -> Result<Passed, Infeasible> {
    let passed = problem.pass_trials(&held.candidate.design, &mut held.known);
    let lack = match passed {
        Ok(tried) => return Ok(Passed::as_is(held.clone(), tried)),
        Err(lack) => lack,
    };
    let mut from = held.candidate.clone();
    if sought_from
        .iter()
        .any(|(unit, place)| from.is_at((unit, *place)))
    {
        return Err(lack);
    }
    let start = from.start();
    for round in 0..ROUNDS {
        let trials = Trials::new(problem, &held.known);
        let found = match round {
            0 => trials.best(&from),
            _ => trials.best_near(&from),
        };
        let Some(mut candidate) = found else {
            sought_from.push(start);
            return Err(lack);
        };
        from = candidate.clone();
        let seen = look(problem, &mut candidate.design, &mut held.known);
        if seen.lack.is_some() {
            continue;
        }
        if let Ok(tried) = problem.pass_trials(&candidate.design, &mut held.known) {
            let known = held.known.clone();
            sought_from.push(start);
            return Ok(Passed {
                robust: Robust { candidate, known },
                tried,
                resolution: Some(RESOLUTION),
            });
        }
    }
    Err(lack)
}

/// Designs whose trials were made.
pub(super) struct Checked<'a> {
    pub problem: &'a Problem,
    pub bound: f64,
    pub passing: Vec<Passed>,
    pub failed: Vec<(Robust, Infeasible)>,
}

impl Checked<'_> {
    pub fn score(&self, it: &Robust) -> f64 {
        self.problem.score(&it.candidate.design)
    }

    /// The score that another design must exceed.
    pub fn least(&self) -> f64 {
        let passing = self.passing.iter().map(|it| self.score(&it.robust));
        passing.fold(self.bound, f64::max)
    }

    /// Takes note of a design's trials; true if it passes as it is.
    pub fn note(&mut self, design: Robust, passed: Result<Passed, Infeasible>) -> bool {
        let mut passed = match passed {
            Ok(passed) => passed,
            Err(lack) => {
                self.failed.push((design, lack));
                return false;
            }
        };
        let is_unmoved = passed.resolution.is_none();
        let own = self.score(&passed.robust);
        for (better, _) in self.failed.iter().filter(|(it, _)| self.score(it) > own) {
            passed.robust.known.note_failed(&better.known);
            passed.resolution = Some(RESOLUTION);
        }
        self.passing.push(passed);
        is_unmoved
    }

    /// The designs that pass, in falling order.
    pub fn into_passing(mut self) -> Result<Vec<Passed>, Refusal> {
        let problem = self.problem;
        sort_falling(&mut self.passing, |it| {
            problem.score(&it.robust.candidate.design)
        });
        match self.passing.is_empty() {
            true => Err(self.into_refusal()),
            false => Ok(self.passing),
        }
    }

    /// Why none passes: what the first lacks, or, of several choices from catalogues, the one that lacks least.
    fn into_refusal(self) -> Refusal {
        let catalogues = Catalogues::of(self.problem);
        let failed = self.failed.iter();
        let choices: HashSet<_> = failed
            .map(|(it, _)| catalogues.places(&it.candidate.unit))
            .collect();
        let choices = [choices.len(), catalogues.count()];
        let least = self.failed.into_iter();
        let least = least.reduce(
            |one, other| match choices[1] > 1 && other.1.gap < one.1.gap {
                true => other,
                false => one,
            },
        );
        let Some((design, lack)) = least else {
            return Infeasible::unknown("stopped").into();
        };
        Refusal {
            lack,
            unit: Some(design.candidate.unit),
            choices: Some(choices).filter(|[_, all]| *all > 1),
        }
    }
}
