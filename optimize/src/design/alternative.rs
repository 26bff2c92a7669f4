//! Designs with what they have of several objectives, and problems that bound these.

use softstop_console::interrupt;

use super::Design;
use super::figure::Figure;
use super::judge::Met;
use super::problem::{Objective, Problem};
use super::requirement::{Requirement, Scope, sign};
use super::search::Found;
use crate::robust::worst;

/// A design with what it has of each objective.
#[derive(Debug, Clone)]
pub struct Alternative {
    /// The design.
    pub found: Found,
    /// What is sought, in SI units; of the worst machine within the tolerances, if that counts.
    pub values: Vec<f64>,
    /// What it has of the requirements, if it was judged anew.
    pub met: Vec<Met>,
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
    pub(super) fn new(problem: &Problem, objectives: &[Objective], found: &Found) -> Option<Self> {
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
