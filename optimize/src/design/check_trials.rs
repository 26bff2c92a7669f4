//! Designs that a search has found, and which of them pass their trials; from one that fails, one that passes is sought
//! (`trial_search`).

use super::Infeasible;
use super::coordinates::{SearchStart, best_by};
use super::judge::RequirementValue;
use super::problem::Problem;
use super::robustify::{RobustDesign, look};
use super::trial_search::{RESOLUTION, Resolution, TrialSearch};
use crate::order::sort_falling;

/// How often what is lost within the tolerances of what was found, or fails there, is taken note of.
const ROUNDS: usize = 8;

/// A design that passes its trials.
pub(super) struct PassedDesign {
    pub robust: RobustDesign,
    /// What it has of what is tried.
    pub tried: Vec<RequirementValue>,
    /// How fine it was looked for, if it was sought.
    pub resolution: Option<Resolution>,
}

/// A design that fails its trials.
pub(super) struct FailedDesign {
    pub robust: RobustDesign,
    pub lack: Infeasible,
    /// Whether one that passes was sought from it.
    pub is_sought: bool,
}

/// Designs whose trials were made.
pub(super) struct TriedDesigns<'a> {
    pub problem: &'a Problem,
    /// The score that a design must exceed.
    pub bound: f64,
    pub passing: Vec<PassedDesign>,
    pub failed: Vec<FailedDesign>,
    /// Places of designs that fail, from which one that passes was sought.
    pub sought_from: &'a mut Vec<SearchStart>,
}

impl TriedDesigns<'_> {
    pub fn score(&self, it: &RobustDesign) -> f64 {
        self.problem.score(&it.candidate.design)
    }

    /// The best design that passes.
    pub fn best(&self) -> Option<&RobustDesign> {
        let passing = self.passing.iter().map(|it| &it.robust);
        best_by(passing, |it| self.score(it))
    }

    /// The score that another design must exceed.
    pub fn least(&self) -> f64 {
        let best = self.best().map_or(self.bound, |it| self.score(it));
        best.max(self.bound)
    }

    /// Makes the trials of a design: true if it passes.
    pub fn try_as_is(&mut self, mut robust: RobustDesign) -> bool {
        let design = &robust.candidate.design;
        let passed = self.problem.pass_trials(design, &mut robust.known);
        let is_passed = passed.is_ok();
        match passed {
            Ok(tried) => self.passing.push(PassedDesign {
                robust,
                tried,
                resolution: None,
            }),
            Err(lack) => self.failed.push(FailedDesign {
                lack: lack.at(&robust.candidate.unit),
                robust,
                is_sought: false,
            }),
        }
        is_passed
    }

    /// Seeks one that passes from a design that fails, unless that was done from its place before. Adds its place to those from
    /// which one was sought, unless that ended with machines to take note of: with others known it may end elsewhere.
    pub fn seek_from(&mut self, index: usize) {
        let FailedDesign {
            robust, is_sought, ..
        } = &mut self.failed[index];
        *is_sought = true;
        let mut from = robust.candidate.clone();
        let mut before = self.sought_from.iter();
        if before.any(|(unit, place)| from.is_at((unit, *place))) {
            return;
        }
        let start = from.start();
        for round in 0..ROUNDS {
            let trials = TrialSearch::new(self.problem, &robust.known);
            let found = match round {
                0 => trials.best(&from),
                _ => trials.best_near(&from),
            };
            let Some(mut candidate) = found else {
                self.sought_from.push(start);
                return;
            };
            from = candidate.clone();
            let seen = look(self.problem, &mut candidate.design, &mut robust.known);
            if seen.lack.is_some() {
                continue;
            }
            let passed = self
                .problem
                .pass_trials(&candidate.design, &mut robust.known);
            if let Ok(tried) = passed {
                let known = robust.known.clone();
                self.sought_from.push(start);
                self.passing.push(PassedDesign {
                    robust: RobustDesign { candidate, known },
                    tried,
                    resolution: Some(RESOLUTION),
                });
                return;
            }
        }
    }

    /// The best design that passes, and the others, each with the trials that better ones fail, and with the fineness of the search from
    /// these, if there was one from each.
    ///
    /// # Errors
    /// What each design lacks if none passes.
    pub fn into_passing(mut self) -> Result<(PassedDesign, Vec<PassedDesign>), Vec<Infeasible>> {
        if self.passing.is_empty() {
            return Err(self.failed.into_iter().map(|it| it.lack).collect());
        }
        let problem = self.problem;
        let score = |it: &RobustDesign| problem.score(&it.candidate.design);
        for PassedDesign {
            robust, resolution, ..
        } in &mut self.passing
        {
            let own = score(robust);
            let better = self.failed.iter().filter(|it| score(&it.robust) > own);
            for it in better.clone() {
                robust.known.note_failed(&it.robust.known);
            }
            let sought = better.map(|it| it.is_sought);
            if sought.reduce(|all, it| all && it) == Some(true) {
                *resolution = Some(RESOLUTION);
            }
        }
        sort_falling(&mut self.passing, |it| score(&it.robust));
        Ok((self.passing.remove(0), self.passing))
    }
}
