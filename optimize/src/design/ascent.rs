//! The ascent from a point of the search to the best design that derivatives lead to: a nonlinear program over the axes and
//! the place in the zone, for [`Slsqp`] or another solver of `argmin`.

use std::cell::RefCell;

use argmin::core::{CostFunction, Error, Executor, Gradient, Jacobian, Operator};

use super::coordinates::{Candidate, Coordinates};
use super::local::{Local, local};
use super::problem::Problem;
use super::reach::LossDirections;
use super::slope::Slope;
use super::slsqp::Slsqp;
use super::space::Space;

/// Designs that one iteration looks at, at most.
const MAX_EVALUATIONS: usize = 60;
/// Changes of cost and coordinates, relative and in edges of the cube, that are too small to go on.
const COST_TOLERANCE: f64 = 1e-12;
const STEP_TOLERANCE: f64 = 1e-11;
/// Coordinates for each of which there may be one more iteration, and the relative gain of one that is too small for another.
const COORDINATES_PER_ITERATION: usize = 3;
const LEAST_GAIN: f64 = 1e-10;
/// By how much each constraint is to be met, in its own unit: more than the solver leaves open.
const SLACK: f64 = 1e-10;
/// Cost, and value of every constraint, where there is no motion: far above every cost, which is about -1.
const NOWHERE: f64 = 1e3;

/// The best design that is met on the way from a point of the unit cube and its best place; none if there is none.
pub(super) fn ascend(problem: &Problem, unit: &[f64]) -> Option<Candidate> {
    let values = Space(&problem.axes).values(unit);
    let start = problem.at_batch(&[values]).remove(0);
    let place = start.map_or(0.5, |design| design.place);
    ascend_from(problem, &LossDirections::default(), (unit, place))
}

/// The best design that is met on the way from a point of the unit cube and a place of its zone, with what is known of the
/// machines within the tolerances.
pub(super) fn ascend_from(
    problem: &Problem,
    known: &LossDirections,
    (unit, place): (&[f64], f64),
) -> Option<Candidate> {
    let (program, start) = Program::new(problem, known, unit, place)?;
    if start.is_empty() {
        return program.best.into_inner();
    }
    let solver = Slsqp {
        bounds: program.coordinates.bounds(problem),
        constraints: program.constraints,
        max_evaluations: MAX_EVALUATIONS,
        cost_tolerance: COST_TOLERANCE,
        step_tolerance: STEP_TOLERANCE,
        least_gain: LEAST_GAIN,
    };
    let iterations = (start.len() / COORDINATES_PER_ITERATION).max(1) as u64;
    let executor = Executor::new(program, solver);
    let executor = executor.configure(|state| state.param(start).max_iters(iterations));
    let found = executor.timer(false).run().ok()?;
    found.problem.get_problem()?.best.into_inner()
}

/// A nonlinear program: minus the score of the motion at a place of the zone of a machine, in units of the score at the
/// start, and constraints that hold where they are not positive.
struct Program<'a> {
    problem: &'a Problem,
    known: &'a LossDirections,
    coordinates: Coordinates,
    score: f64,
    constraints: usize,
    /// The last point, for all that a solver asks of it.
    last: RefCell<(Vec<f64>, Option<Local>)>,
    best: RefCell<Option<Candidate>>,
}

impl<'a> Program<'a> {
    /// The program about a point of the unit cube and its start; none if there is no motion.
    fn new(
        problem: &'a Problem,
        known: &'a LossDirections,
        unit: &[f64],
        place: f64,
    ) -> Option<(Self, Vec<f64>)> {
        let coordinates = Coordinates::new(problem, unit);
        let start = coordinates.start(place);
        let mut program = Self {
            problem,
            known,
            coordinates,
            score: 1.0,
            constraints: 0,
            last: RefCell::default(),
            best: RefCell::default(),
        };
        let first = program.compute(&start);
        let (score, constraints) = first.as_ref().map(|first| {
            let score = first.objective.value.abs().max(f64::MIN_POSITIVE);
            (score, first.constraints.len())
        })?;
        program.last = RefCell::new((start.clone(), first));
        (program.score, program.constraints) = (score, constraints);
        Some((program, start))
    }

    /// Computes what is sought and required at a point, and takes note of its design.
    fn compute(&self, at: &[f64]) -> Option<Local> {
        let unit = self.coordinates.unit(at);
        let mut found = local(self.problem, &self.coordinates.at(&unit, at), self.known)?;
        if let Some(design) = found.design.take() {
            let mut best = self.best.borrow_mut();
            if best
                .as_ref()
                .is_none_or(|best| self.problem.score(&design) > self.problem.score(&best.design))
            {
                *best = Some(Candidate { unit, design });
            }
        }
        Some(found)
    }

    /// Computes a point once for all that a solver asks of it.
    fn with<T>(&self, at: &[f64], take: impl FnOnce(Option<&Local>) -> T) -> T {
        let is_last = self.last.borrow().0 == at;
        if !is_last {
            self.last.replace((at.to_vec(), self.compute(at)));
        }
        take(self.last.borrow().1.as_ref())
    }
}

fn scaled(slope: &Slope, factor: f64) -> Vec<f64> {
    slope.by.iter().map(|by| factor * by).collect()
}

impl CostFunction for Program<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, at: &Vec<f64>) -> Result<f64, Error> {
        let cost = |it: &Local| -it.objective.value / self.score;
        Ok(self.with(at, |found| found.map_or(NOWHERE, cost)))
    }
}

impl Gradient for Program<'_> {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;

    fn gradient(&self, at: &Vec<f64>) -> Result<Vec<f64>, Error> {
        let gradient = |it: &Local| scaled(&it.objective, -1.0 / self.score);
        Ok(self.with(at, |found| found.map_or(vec![0.0; at.len()], gradient)))
    }
}

impl Operator for Program<'_> {
    type Param = Vec<f64>;
    type Output = Vec<f64>;

    fn apply(&self, at: &Vec<f64>) -> Result<Vec<f64>, Error> {
        let values =
            |it: &Local| Vec::from_iter(it.constraints.iter().map(|one| SLACK - one.value));
        Ok(self.with(at, |found| {
            found.map_or(vec![NOWHERE; self.constraints], values)
        }))
    }
}

impl Jacobian for Program<'_> {
    type Param = Vec<f64>;
    type Jacobian = Vec<Vec<f64>>;

    fn jacobian(&self, at: &Vec<f64>) -> Result<Vec<Vec<f64>>, Error> {
        let rows = |it: &Local| Vec::from_iter(it.constraints.iter().map(|one| scaled(one, -1.0)));
        let nowhere = || vec![vec![0.0; at.len()]; self.constraints];
        Ok(self.with(at, |found| found.map_or_else(nowhere, rows)))
    }
}
