//! Designs of which none is better in all that is sought.

pub use super::alternative::Alternative;
use super::non_dominated::{NonDominated, non_dominated};
pub use super::pareto_search::Tally;
use super::pareto_search::search_pareto;
use super::problem::{Objective, Problem};
use super::search::{Found, SearchError, Settings, Watch};

/// Designs of which none is better in all that is sought.
#[derive(Debug, Clone)]
pub struct Pareto {
    /// What is sought.
    pub objectives: Vec<Objective>,
    /// The designs, the best by the first objective first.
    pub points: Vec<Alternative>,
    /// The one that is nearest to the best of each objective, in units of their ranges.
    pub nearest: usize,
    /// What became of the problems.
    pub tally: Tally,
    /// Machines within the tolerances that were looked at about each design; none if all is exact or they were not looked at.
    pub machines: Option<usize>,
}

impl Problem {
    /// All that is sought.
    pub fn objectives(&self) -> Vec<Objective> {
        let first = [self.objective].into_iter();
        first.chain(self.traded.iter().copied()).collect()
    }
}

impl Pareto {
    /// Searches the designs of a front from the best one by the first objective on; an interrupted one has those that are
    /// found by then.
    ///
    /// # Errors
    /// [`SearchError`] if no design has one of the objectives.
    pub fn search(
        problem: &Problem,
        first: &Found,
        (settings, watch): (Settings, &dyn Watch),
    ) -> Result<Self, SearchError> {
        let objectives = problem.objectives();
        let (points, tally) = search_pareto(problem, &objectives, first, (settings, watch))?;
        let mut found = Self {
            objectives,
            points,
            nearest: 0,
            tally,
            machines: None,
        };
        found.filter();
        Ok(found)
    }

    /// With another best design by the first objective.
    #[must_use]
    pub(super) fn with(mut self, problem: &Problem, found: &Found) -> Self {
        let point = Alternative::new(problem, &self.objectives, found);
        if let (Some(point), Some(first)) = (point, self.points.first_mut()) {
            *first = point;
        }
        self.filter();
        self
    }

    /// Without the designs that are not as asked.
    pub fn keep(&mut self, is_kept: &[bool]) {
        let mut is_kept = is_kept.iter();
        let count = self.points.len();
        self.points.retain(|_| is_kept.next() == Some(&true));
        let failed = count - self.points.len();
        self.tally.failed += failed;
        self.tally.solved -= failed;
        self.filter();
    }

    /// Without those that others dominate.
    fn filter(&mut self) {
        let all = self.points.iter().map(|it| it.graded(&self.objectives));
        let all: Vec<Vec<f64>> = all.collect();
        let NonDominated { members, nearest } = non_dominated(&all);
        self.points = members
            .iter()
            .map(|index| self.points[*index].clone())
            .collect();
        self.nearest = nearest;
        self.tally.dominated = self.tally.solved.saturating_sub(self.points.len());
    }
}
