//! Machines within the tolerances that a search keeps within bounds: those that lose the motion, and those whose figures come
//! nearest to a bound. A search adds to them what it finds until there are no more (an exchange method of semi-infinite
//! programming, Blankenship and Falk 1976).

use std::sync::LazyLock;

use softstop::Parameter;
use softstop_dynamics::{CycleMetrics, derivatives};

use super::Design;
use super::constraint::Limit;
use super::differences::differences;
use super::exact::Linearization;
use super::figure::{Figure, Sense};
use super::judge::violation;
use super::problem::Problem;
use super::reach::{reserve, unreached};
use super::requirement::{Requirement, Scope, sign};
use super::slope::Slope;
use super::within::ParameterJacobian;
use crate::robust::{Neighbours, rates};

/// What a machine is extreme in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Criterion {
    /// In what is sought.
    Objective,
    /// In a required figure, on this side.
    Bound(Figure, Sense),
}

/// A machine within the tolerances with an extreme figure.
#[derive(Debug, Clone, PartialEq)]
pub struct ExtremeMachine {
    /// In what.
    pub target: Criterion,
    /// Its coordinates in the box.
    pub at: Vec<f64>,
}

/// Machines within the tolerances that a design has to keep within its bounds.
#[derive(Debug, Clone, Default)]
pub struct CriticalMachines {
    /// Directions of the box in which the motion is lost, to whose ends it has to go on, in coordinates of the box.
    pub losses: Vec<Vec<f64>>,
    /// Machines that come nearest to a bound.
    pub extremes: Vec<ExtremeMachine>,
    /// Machines on which trials are made beside the drawing's.
    pub tried: Vec<Vec<f64>>,
    /// Trials that better designs have failed.
    pub failed: Vec<Figure>,
    /// Those of the first cases.
    pub cases: Vec<CriticalMachines>,
}

/// No machines.
static NONE: LazyLock<CriticalMachines> = LazyLock::new(CriticalMachines::default);

/// Largest distance along each coordinate of the box at which two machines are one.
const SAME: f64 = 1e-6;

impl CriticalMachines {
    /// Takes note of an extreme machine; false if it is known.
    pub(super) fn note(&mut self, target: Criterion, at: &[f64]) -> bool {
        let is_there =
            |it: &ExtremeMachine| it.at.iter().zip(at).all(|(a, b)| (a - b).abs() < SAME);
        let mut known = self.extremes.iter();
        let is_new = known.all(|it| it.target != target || !is_there(it));
        if is_new {
            let at = at.to_vec();
            self.extremes.push(ExtremeMachine { target, at });
        }
        is_new
    }

    /// Those of an operating point.
    pub(super) fn for_case(&self, case: Option<usize>) -> &Self {
        case.map_or(self, |index| self.cases.get(index).unwrap_or(&NONE))
    }

    /// Those of an operating point, to add to.
    pub(super) fn for_case_mut(&mut self, case: Option<usize>) -> &mut Self {
        let Some(index) = case else { return self };
        if self.cases.len() <= index {
            self.cases.resize_with(index + 1, Self::default);
        }
        &mut self.cases[index]
    }

    /// Trials that better designs have failed, each with the index of the case, if it was one.
    pub(super) fn all_failed(&self) -> impl Iterator<Item = (Figure, Option<usize>)> {
        let own = self.failed.iter().map(|it| (*it, None));
        let cases = self.cases.iter().enumerate();
        let cases =
            cases.flat_map(|(index, known)| known.failed.iter().map(move |it| (*it, Some(index))));
        own.chain(cases)
    }

    /// Takes note of the trials that a better design has failed, each once.
    pub(super) fn note_failed(&mut self, better: &Self) {
        for (figure, case) in better.all_failed() {
            self.for_case_mut(case).note_failed_trial(figure);
        }
    }

    /// Takes note of a trial that a better design has failed in this operating point.
    pub(super) fn note_failed_trial(&mut self, figure: Figure) {
        if !self.failed.contains(&figure) {
            self.failed.push(figure);
        }
    }

    /// The design of a motion that is as required in the drawing's machine and in all of these, in every case; none if it is
    /// not.
    pub(super) fn design(&self, problem: &Problem, here: Design) -> Option<Design> {
        self.assess(problem, here, 0.0).map(|(design, _)| design)
    }

    /// The design of a motion, and how far it and the motions of all of these are from what is required, summed over all cases;
    /// none if that is farther than a bound in one of them, or a motion cannot be computed.
    pub(super) fn assess(
        &self,
        problem: &Problem,
        mut here: Design,
        farthest: f64,
    ) -> Option<(Design, f64)> {
        let points = problem.operating_points(&here);
        let assessed = points.iter().map(|it| {
            let known = self.for_case(it.case);
            known.assess_at_point(&it.problem, it.design, farthest)
        });
        let (values, violations): (Vec<f64>, Vec<f64>) =
            assessed.collect::<Option<Vec<_>>>()?.into_iter().unzip();
        here.set_values(values);
        Some((here, violations.iter().sum()))
    }

    /// What is sought of the worst of the own machine of an operating point and all of these, and how far they are from what is
    /// required.
    fn assess_at_point(
        &self,
        problem: &Problem,
        here: &Design,
        farthest: f64,
    ) -> Option<(f64, f64)> {
        let motion = here.judged().ok()?;
        let is_near = |violation: &f64| *violation <= farthest;
        let mut violation = Some(violation(&problem.met(&motion))).filter(is_near)?;
        let mut value = problem.sought(&motion)?;
        let Some(spread) = problem.spread(&here.machine) else {
            return Some((value, violation));
        };
        let neighbours = Neighbours::new(&spread, &here.orbit);
        violation += unreached(&self.losses, &spread, here, farthest - violation)?;
        for ExtremeMachine { target, at } in &self.extremes {
            let Some((figure, requirement)) = problem.asked(*target) else {
                continue;
            };
            violation = Some(violation).filter(is_near)?;
            let own = neighbours.value(at, figure)?;
            match requirement {
                Some(requirement) => violation += requirement.violation(own),
                None => value = problem.objective.worse(value, own),
            }
        }
        Some((value, violation)).filter(|(_, violation)| is_near(violation))
    }

    /// How far inside its bound each extreme machine is, in units of the bound, and the scores of those that are extreme in
    /// what is sought; none if one cannot be computed.
    pub(super) fn slopes(&self, about: Option<&Linearization<'_>>) -> Option<CriticalSlopes> {
        let mut found = CriticalSlopes::default();
        if self.losses.is_empty() && self.extremes.is_empty() {
            return Some(found);
        }
        let about = about?;
        let problem = about.problem;
        let spread = problem.spread(&about.point.machine)?;
        for direction in &self.losses {
            let reserve = reserve(about, &spread, direction)?;
            found.bounds.push((Limit::Loss, reserve));
        }
        let neighbours = Neighbours::new(&spread, &about.point.orbit);
        for ExtremeMachine { target, at } in &self.extremes {
            let Some((figure, requirement)) = problem.asked(*target) else {
                continue;
            };
            let of = slope_at(about, &neighbours, at, figure);
            match (requirement, target) {
                (Some(requirement), Criterion::Bound(_, side)) => {
                    let bound = Limit::Required(figure, *side);
                    let mut sides = requirement.sides().filter(|(own, _)| own == side);
                    let (limit, slope) = match of {
                        Some(of) => {
                            let own = sides.next();
                            (bound, own.map(|(_, it)| of.beyond(it, sign(*side))))
                        }
                        // The motion is lost on the way there.
                        None => (Limit::Loss, Some(reserve(about, &spread, at)?)),
                    };
                    found.bounds.extend(slope.map(|it| (limit, it)));
                }
                _ => found.scores.push(problem.objective.slope(of?)),
            }
        }
        Some(found)
    }
}

/// What extreme machines have, with derivatives.
#[derive(Debug, Default)]
pub(super) struct CriticalSlopes {
    /// How far beyond the tolerances or a machine the motion goes on; how far inside its bound a figure is, in units of that.
    pub bounds: Vec<(Limit, Slope)>,
    /// Scores.
    pub scores: Vec<Slope>,
}

impl Problem {
    /// The figure of a target, and the requirement if it is one; none if the problem does not ask for it.
    pub(super) fn asked(&self, target: Criterion) -> Option<(Figure, Option<&Requirement>)> {
        match target {
            Criterion::Objective => {
                let is_asked = self.objective.scope == Scope::Tolerances;
                is_asked.then_some((self.objective.figure, None))
            }
            Criterion::Bound(figure, _) => {
                let mut all = self.requirements.iter();
                let found = all.find(|it| it.figure == figure && it.is_of_each_motion())?;
                Some((figure, Some(found)))
            }
        }
    }

    /// What is asked of every machine within the tolerances.
    pub(super) fn targets(&self) -> Vec<Criterion> {
        let required = self.requirements.iter().filter(|it| it.is_of_each_motion());
        let sides = required.flat_map(|it| it.sides().map(|(side, _)| (it.figure, side)));
        let bounds = sides.map(|(figure, side)| Criterion::Bound(figure, side));
        let is_worst_sought = self.objective.scope == Scope::Tolerances;
        bounds
            .chain(is_worst_sought.then_some(Criterion::Objective))
            .collect()
    }

    /// The figure of a target, and its good side.
    pub(super) fn figure_of(&self, target: Criterion) -> (Figure, Sense) {
        match target {
            Criterion::Objective => (self.objective.figure, self.objective.sense),
            Criterion::Bound(figure, side) => (figure, side),
        }
    }
}

/// The value of a figure of the machine at a place of the box, with its derivatives by the coordinates of the search.
fn slope_at(
    about: &Linearization<'_>,
    neighbours: &Neighbours<'_>,
    at: &[f64],
    figure: Figure,
) -> Option<Slope> {
    let orbit = neighbours.motion(at)?;
    let spread = neighbours.spread;
    let value = spread.value(figure, &orbit)?;
    let exact = || {
        let rows = ParameterJacobian::at(about, at)?;
        let mut parameters = rows.parameters().to_vec();
        parameters.push(Parameter::Frequency);
        let slopes = derivatives::differentiate_orbit(&orbit, &parameters).ok()?;
        let stroke = CycleMetrics::of(&orbit).ok()?;
        let by = rates((figure, spread.cost()), &slopes, (&orbit, &stroke))?;
        Some(rows.chain(&parameters, &by))
    };
    let differenced = || {
        let value = |point: &Design| {
            let spread = about.problem.spread(&point.machine)?;
            Some(vec![
                Neighbours::new(&spread, &point.orbit).value(at, figure)?,
            ])
        };
        Some(differences(about.problem, about.at, &value)?.concat())
    };
    let by = exact().or_else(differenced)?;
    Some(Slope { value, by })
}
