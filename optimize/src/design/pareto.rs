//! Designs of which none is better in all that is sought.

use serde::Serialize;

pub use super::alternative::Alternative;
use super::non_dominated::{NonDominated, non_dominated};
use super::problem::{Objective, Problem};
use super::search::Found;

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

/// The problems of a front, and what became of them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Tally {
    /// All problems.
    pub problems: usize,
    /// Those that led to a design.
    pub solved: usize,
    /// Those that a looser one solves, or that have no design because it has none.
    pub implied: usize,
    /// Those without a design that is as asked.
    pub failed: usize,
    /// Designs that another one dominates, or that are the same.
    pub dominated: usize,
}

impl Problem {
    /// All that is sought.
    pub fn objectives(&self) -> Vec<Objective> {
        let first = [self.objective].into_iter();
        first.chain(self.traded.iter().copied()).collect()
    }
}

impl Pareto {
    /// The designs of a front, without those that others dominate.
    pub(super) fn new(objectives: Vec<Objective>, points: Vec<Alternative>, tally: Tally) -> Self {
        let mut front = Self {
            objectives,
            points,
            nearest: 0,
            tally,
            machines: None,
        };
        front.filter();
        front
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
        let NonDominated { members, nearest } = undominated(&self.points, &self.objectives);
        self.points = members
            .iter()
            .map(|index| self.points[*index].clone())
            .collect();
        self.nearest = nearest;
        self.tally.dominated = self.tally.solved.saturating_sub(self.points.len());
    }
}

/// Which of some designs no other one dominates.
pub(super) fn undominated<'a>(
    all: impl IntoIterator<Item = &'a Alternative>,
    objectives: &[Objective],
) -> NonDominated {
    let all = all.into_iter().map(|it| it.graded(objectives));
    non_dominated(&all.collect::<Vec<_>>())
}
