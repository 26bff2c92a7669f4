//! Searched parameters that change nothing of what is sought and required.

use softstop::Parameter;

use super::coordinates::Coordinates;
use super::local::{LocalModel, Scores, local};
use super::problem::Problem;
use super::search::SearchResult;

/// Derivative by a whole range, in units of the value or its bound, that is none.
const ROUNDING: f64 = 1e-9;
/// Share of its range by which a parameter is moved, so that no extremum is taken for no effect.
const STEP: f64 = 0.1;

impl SearchResult {
    /// The searched parameters, but for catalogues, by which no score and nothing that is required of the motion changes at
    /// the design; none if a trial holds it back, which has no derivatives.
    pub fn without_effect(&self, problem: &Problem) -> Vec<Parameter> {
        let coordinates = Coordinates::new(problem, &self.unit);
        let start = coordinates.start(self.design.place);
        let look = |at: &[f64]| {
            let unit = coordinates.unit(at);
            local(problem, &coordinates.at(&unit, at), &self.known)
        };
        let has_failed = self.known.all_failed().next().is_some();
        let here = look(&start).filter(|_| !has_failed);
        let Some(here) = here else { return Vec::new() };
        let score_of = |it: &LocalModel| it.score(&problem.objective).value;
        let score = score_of(&here);
        let is_idle = |index: usize| {
            let mut scores = here.scores.iter().flat_map(Scores::all);
            let mut required = here.constraints.iter();
            let mut aside = start.clone();
            aside[index] += if aside[index] < 0.5 { STEP } else { -STEP };
            scores.all(|it| it.by[index].abs() <= ROUNDING * it.value.abs())
                && required.all(|it| it.slope.by[index].abs() <= ROUNDING)
                && look(&aside)
                    .is_some_and(|it| (score_of(&it) - score).abs() <= ROUNDING * score.abs())
        };
        let parameters = coordinates.parameters(problem).into_iter().enumerate();
        let idle = parameters.filter(|(index, _)| is_idle(*index));
        idle.map(|(_, parameter)| parameter).collect()
    }
}
