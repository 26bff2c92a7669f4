//! The ascent from a point of the search to the best design that derivatives lead to: a nonlinear program over the axes and
//! the place in the zone, for [`Slsqp`] or another solver of `argmin`. Where the worst machine within the tolerances counts,
//! one more coordinate of each operating point is a level below the scores of all its machines that are known.

use std::cell::RefCell;

use argmin::core::{CostFunction, Error, Executor, Gradient, Jacobian, Operator};

use super::Design;
use super::coordinates::{Candidate, Coordinates, keep_best};
use super::critical::CriticalMachines;
use super::local::{LocalModel, local};
use super::problem::Problem;
use super::requirement::Scope;
use super::slope::{Slope, unit_row};
use super::slsqp::Slsqp;

/// Designs that one run looks at, at most.
const MAX_EVALUATIONS: usize = 60;
/// Changes of cost and coordinates, relative and in edges of the cube, that are too small to go on.
const COST_TOLERANCE: f64 = 1e-12;
const STEP_TOLERANCE: f64 = 1e-11;
/// Runs of the solver at most, and the relative gain of one that is too small for another.
const MAX_RUNS: usize = 8;
const LEAST_GAIN: f64 = 1e-8;
/// By how much each constraint is to be met, in its own unit: more than the solver leaves open.
const SLACK: f64 = 1e-10;
/// The lowest and the highest level, in units of the score at the start.
const LOWEST_LEVEL: f64 = 1e-6;
const HIGHEST_LEVEL: f64 = 1e6;
/// Cost, and value of every constraint, where there is no motion: far above every cost, which is about -1.
const NOWHERE: f64 = 1e3;

/// The best design that is met on the way from a point of the unit cube and its best place; none if there is none.
pub(super) fn ascend(problem: &Problem, unit: &[f64]) -> Option<Candidate> {
    let values = problem.axis_values(unit);
    let start = problem.at_batch(&[values]).remove(0);
    let place = start.map_or(0.5, |design| design.place);
    ascend_from(problem, &CriticalMachines::default(), (unit, place))
}

/// The best design that is met on the way from a point of the unit cube and a place of its zone, with what is known of the
/// machines within the tolerances.
pub(super) fn ascend_from(
    problem: &Problem,
    known: &CriticalMachines,
    (unit, place): (&[f64], f64),
) -> Option<Candidate> {
    let (mut program, mut start) = NonlinearProgram::new(problem, known, unit, place)?;
    if start.is_empty() {
        return program.best.into_inner();
    }
    // A run may end where rounding or a border of the motions stops its line search: another goes on from the best design.
    for _ in 0..MAX_RUNS {
        let before = program.best_score();
        let solver = Slsqp {
            bounds: program.bounds(),
            constraints: program.constraints,
            max_evaluations: MAX_EVALUATIONS,
            cost_tolerance: COST_TOLERANCE,
            step_tolerance: STEP_TOLERANCE,
        };
        let executor = Executor::new(program, solver);
        let executor = executor.configure(|state| state.param(start).max_iters(1));
        let found = executor.timer(false).run().ok()?;
        program = found.problem.problem?;
        let best = program.best_score();
        if best <= before * (1.0 + LEAST_GAIN) {
            break;
        }
        start = program.best_start()?;
    }
    program.best.into_inner()
}

/// A nonlinear program: minus the score of the motion at a place of the zone of a machine, in units of the score at the
/// start, or minus the mean of the levels, and constraints that hold where they are not positive.
struct NonlinearProgram<'a> {
    problem: &'a Problem,
    known: &'a CriticalMachines,
    coordinates: Coordinates,
    /// The weights of the operating points, each of which has a level; none if the own machines count.
    weights: Vec<f64>,
    score: f64,
    constraints: usize,
    /// The last point, for all that a solver asks of it.
    last: RefCell<(Vec<f64>, Option<LocalModel>)>,
    best: RefCell<Option<Candidate>>,
}

impl<'a> NonlinearProgram<'a> {
    /// The program about a point of the unit cube and its start; none if there is no motion.
    fn new(
        problem: &'a Problem,
        known: &'a CriticalMachines,
        unit: &[f64],
        place: f64,
    ) -> Option<(Self, Vec<f64>)> {
        let coordinates = Coordinates::new(problem, unit);
        let mut start = coordinates.start(place);
        let has_levels = problem.objective.scope == Scope::Tolerances && !start.is_empty();
        let weights = problem.weights().filter(|it| has_levels && *it > 0.0);
        let weights: Vec<f64> = weights.collect();
        let own = start.len();
        start.resize(own + weights.len(), 1.0);
        let mut program = Self {
            problem,
            known,
            coordinates,
            weights,
            score: 1.0,
            constraints: 0,
            last: RefCell::default(),
            best: RefCell::default(),
        };
        let first = program.compute(&start[..own]);
        let (score, constraints) = first.as_ref().map(|first| {
            let score = first.score(&problem.objective).value;
            let score = score.abs().max(f64::MIN_POSITIVE);
            let levels = program.scores(first).count();
            (score, first.constraints.len() + levels)
        })?;
        program.last = RefCell::new((start[..own].to_vec(), first));
        (program.score, program.constraints) = (score, constraints);
        Some((program, start))
    }

    /// The score of the best design that was met; 0 if there is none.
    fn best_score(&self) -> f64 {
        let best = self.best.borrow();
        best.as_ref()
            .map_or(0.0, |best| self.problem.score(&best.design))
    }

    /// The best design that was met, to start from.
    fn best_start(&self) -> Option<Vec<f64>> {
        let best = self.best.borrow();
        let Candidate { unit, design } = best.as_ref()?;
        let mut start = Coordinates::new(self.problem, unit).start(design.place);
        let levels = design.points().zip(self.problem.weights());
        let levels = levels.filter(|(_, weight)| *weight > 0.0);
        let level = |it: &Design| self.problem.objective.score(it.value) / self.score;
        let levels = levels.map(|(design, _)| level(design));
        start.extend(levels.take(self.weights.len()));
        Some(start)
    }

    fn bounds(&self) -> Vec<(f64, f64)> {
        let mut bounds = self.coordinates.bounds(self.problem);
        bounds.resize(
            bounds.len() + self.weights.len(),
            (LOWEST_LEVEL, HIGHEST_LEVEL),
        );
        bounds
    }

    /// The scores that each level lies below, with its index.
    fn scores<'b>(&self, of: &'b LocalModel) -> impl Iterator<Item = (usize, &'b Slope)> {
        let points = of.scores.iter().take(self.weights.len()).enumerate();
        points.flat_map(|(index, it)| it.all().map(move |score| (index, score)))
    }

    /// Where the levels begin among the coordinates.
    fn levels_at(&self, at: &[f64]) -> usize {
        at.len() - self.weights.len()
    }

    /// The score of the mean of the levels, with its derivatives by them.
    fn mean_level(&self, at: &[f64]) -> Slope {
        let levels = self.weights.iter().zip(&at[self.levels_at(at)..]);
        let levels: Vec<_> = levels.map(|(weight, level)| (*weight, *level)).collect();
        self.problem.objective.mean_of(&levels)
    }

    /// Computes what is sought and required at a point, and takes note of its design.
    fn compute(&self, at: &[f64]) -> Option<LocalModel> {
        let unit = self.coordinates.unit(at);
        let mut found = local(self.problem, &self.coordinates.at(&unit, at), self.known)?;
        if let Some(design) = found.design.take() {
            let candidate = Candidate { unit, design };
            let score = |it: &Candidate| self.problem.score(&it.design);
            keep_best(&mut self.best.borrow_mut(), candidate, score);
        }
        Some(found)
    }

    /// Computes a point once for all that a solver asks of it.
    fn with<T>(&self, at: &[f64], take: impl FnOnce(Option<&LocalModel>) -> T) -> T {
        let at = &at[..self.levels_at(at)];
        let is_last = self.last.borrow().0 == at;
        if !is_last {
            self.last.replace((at.to_vec(), self.compute(at)));
        }
        take(self.last.borrow().1.as_ref())
    }
}

impl CostFunction for NonlinearProgram<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, at: &Vec<f64>) -> Result<f64, Error> {
        let cost = |it: &LocalModel| match self.weights.is_empty() {
            true => -it.objective(&self.problem.objective).value / self.score,
            false => -self.mean_level(at).value,
        };
        Ok(self.with(at, |found| found.map_or(NOWHERE, cost)))
    }
}

impl Gradient for NonlinearProgram<'_> {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;

    fn gradient(&self, at: &Vec<f64>) -> Result<Vec<f64>, Error> {
        let nowhere = || vec![0.0; at.len()];
        let gradient = |it: &LocalModel| match self.weights.is_empty() {
            true => scaled(&it.objective(&self.problem.objective), -1.0 / self.score),
            false => {
                let mut gradient = vec![0.0; self.levels_at(at)];
                gradient.extend(scaled(&self.mean_level(at), -1.0));
                gradient
            }
        };
        Ok(self.with(at, |found| found.map_or_else(nowhere, gradient)))
    }
}

impl Operator for NonlinearProgram<'_> {
    type Param = Vec<f64>;
    type Output = Vec<f64>;

    fn apply(&self, at: &Vec<f64>) -> Result<Vec<f64>, Error> {
        let values = |it: &LocalModel| {
            let constraints = it.constraints.iter().map(|one| SLACK - one.slope.value);
            let first = self.levels_at(at);
            let above =
                |(index, score): (usize, &Slope)| at[first + index] - score.value / self.score;
            constraints.chain(self.scores(it).map(above)).collect()
        };
        Ok(self.with(at, |found| {
            found.map_or_else(|| vec![NOWHERE; self.constraints], values)
        }))
    }
}

impl Jacobian for NonlinearProgram<'_> {
    type Param = Vec<f64>;
    type Jacobian = Vec<Vec<f64>>;

    fn jacobian(&self, at: &Vec<f64>) -> Result<Vec<Vec<f64>>, Error> {
        let by_levels = |row: Vec<f64>, own: Option<usize>| {
            let levels = unit_row(self.weights.len(), own);
            row.into_iter().chain(levels).collect()
        };
        let rows = |it: &LocalModel| {
            let constraints = it.constraints.iter();
            let constraints = constraints.map(|one| by_levels(scaled(&one.slope, -1.0), None));
            let scores = self.scores(it);
            let scores =
                scores.map(|(index, one)| by_levels(scaled(one, -1.0 / self.score), Some(index)));
            constraints.chain(scores).collect()
        };
        let nowhere = || vec![vec![0.0; at.len()]; self.constraints];
        Ok(self.with(at, |found| found.map_or_else(nowhere, rows)))
    }
}

/// Derivatives times a factor.
fn scaled(slope: &Slope, factor: f64) -> Vec<f64> {
    slope.by.iter().map(|by| factor * by).collect()
}
