//! Designs of which none is better in all that is sought, with what they have of each objective, and problems that bound these.

use serde::Serialize;
use softstop_console::interrupt;

use super::Design;
use super::figure::Figure;
use super::judge::RequirementValue;
use super::non_dominated::{NonDominated, non_dominated};
use super::problem::{Objective, Problem};
use super::requirement::{Requirement, Scope, sign};
use super::search::SearchResult;
use crate::robust::worst;

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
    pub tally: FrontTally,
    /// Machines within the tolerances that were looked at about each design; none if all is exact or they were not looked at.
    pub machines: Option<usize>,
}

/// The problems of a front, and what became of them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct FrontTally {
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

/// A design with what it has of each objective.
#[derive(Debug, Clone)]
pub struct Alternative {
    /// The design.
    pub found: SearchResult,
    /// What is sought, in SI units; of the worst machine within the tolerances, if that counts.
    pub values: Vec<f64>,
    /// What it has of the requirements, if it was judged anew.
    pub met: Vec<RequirementValue>,
    /// Share of the machines within its tolerances that lose the motion or violate a requirement, if they were looked at.
    pub violating: Option<f64>,
}

impl Objective {
    /// A value by its good side: the more the better.
    pub(super) fn graded(&self, value: f64) -> f64 {
        sign(self.sense) * value
    }

    /// What a design has of it, in SI units; none if it has no such figure.
    fn value(&self, problem: &Problem, design: &Design) -> Option<f64> {
        let whole = || {
            let spread = problem.spread(&design.machine)?;
            let figures = [(self.figure, self.sense)];
            let found = worst(&spread, &design.orbit, &figures, &interrupt::watch);
            Some(found.ok()?.pop()?.value)
        };
        let value = match self.scope == Scope::Tolerances && self.figure.is_of_motion() {
            true => whole()?,
            false => problem.value(&design.judged().ok()?, self.figure),
        };
        value.is_finite().then_some(value)
    }
}

impl Problem {
    /// All that is sought.
    pub fn objectives(&self) -> Vec<Objective> {
        let first = [self.objective].into_iter();
        first.chain(self.traded.iter().copied()).collect()
    }

    /// The problem with another bound of an objective beside its own.
    pub(super) fn bounded(mut self, objective: &Objective, bound: f64) -> Self {
        let (figure, scope) = (objective.figure, objective.scope);
        if figure == Figure::Share {
            self.margin = self.margin.max(bound);
            return self;
        }
        let added = Requirement::on_side(figure, objective.sense, bound);
        let mut all = self.requirements.iter_mut();
        match all.find(|it| it.figure == figure && it.scope == scope) {
            Some(own) => {
                own.least = added.least.into_iter().chain(own.least).reduce(f64::max);
                own.most = added.most.into_iter().chain(own.most).reduce(f64::min);
            }
            None => self.requirements.push(Requirement { scope, ..added }),
        }
        self
    }
}

impl Alternative {
    /// What it has of each objective, by its good side.
    pub(super) fn graded(&self, objectives: &[Objective]) -> Vec<f64> {
        let pairs = objectives.iter().zip(&self.values);
        pairs
            .map(|(objective, value)| objective.graded(*value))
            .collect()
    }

    /// None if the design has no value of some objective.
    pub(super) fn new(
        problem: &Problem,
        objectives: &[Objective],
        found: &SearchResult,
    ) -> Option<Self> {
        let values = objectives.iter().map(|it| it.value(problem, &found.design));
        let values: Vec<f64> = values.collect::<Option<_>>()?;
        let mut found = found.clone();
        found.design.value = values[0];
        Some(Self {
            found,
            values,
            met: Vec::new(),
            violating: None,
        })
    }
}

impl Pareto {
    /// The designs of a front, without those that others dominate.
    pub(super) fn new(
        objectives: Vec<Objective>,
        points: Vec<Alternative>,
        tally: FrontTally,
    ) -> Self {
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
    pub(super) fn with(mut self, problem: &Problem, found: &SearchResult) -> Self {
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
