//! The ascent from a point of the search to the best design that derivatives lead to: a nonlinear program over the axes and
//! the place in the zone, for sequential quadratic programming (Kraft 1988, the crate `slsqp`). Where the worst machine within the
//! tolerances counts, one more coordinate of each operating point is a level below the scores of all its machines that are known.

use std::cell::RefCell;

use slsqp::{Func, StopTols, minimize};

use super::Design;
use super::coordinates::{Candidate, Coordinates, keep_best};
use super::critical::CriticalMachines;
use super::local::{Local, local};
use super::problem::Problem;
use super::requirement::Scope;
use super::slope::{Slope, unit_row};

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
    let (program, mut start) = Program::new(problem, known, unit, place)?;
    if start.is_empty() {
        return program.best.into_inner();
    }
    // A run may end where rounding or a border of the motions stops its line search: another goes on from the best design.
    for _ in 0..MAX_RUNS {
        let before = program.best_score();
        program.minimize(&start);
        let best = program.best_score();
        if best <= before * (1.0 + LEAST_GAIN) {
            break;
        }
        start = program.best_start()?;
    }
    program.best.into_inner()
}

/// A nonlinear program: minus the score of the motion at a place of the zone of a machine, in units of the score at the
/// start, or minus the mean of the levels, and constraints that hold where they are at most 0.
struct Program<'a> {
    problem: &'a Problem,
    known: &'a CriticalMachines,
    coordinates: Coordinates,
    /// The weights of the operating points, each of which has a level; none if the own machines count.
    weights: Vec<f64>,
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
    fn scores<'b>(&self, of: &'b Local) -> impl Iterator<Item = (usize, &'b Slope)> + use<'b> {
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
    fn compute(&self, at: &[f64]) -> Option<Local> {
        let unit = self.coordinates.unit(at);
        let mut found = local(self.problem, &self.coordinates.at(&unit, at), self.known)?;
        if let Some(design) = found.design.take() {
            let candidate = Candidate { unit, design };
            let score = |it: &Candidate| self.problem.score(&it.design);
            keep_best(&mut self.best.borrow_mut(), candidate, score);
        }
        Some(found)
    }

    /// A value at a point, which is computed once for all that the solver asks of it, with its derivatives.
    fn with(&self, at: &[f64], take: impl FnOnce(&Local) -> Option<Slope>) -> Slope {
        let own = &at[..self.levels_at(at)];
        let is_last = self.last.borrow().0 == own;
        if !is_last {
            self.last.replace((own.to_vec(), self.compute(own)));
        }
        let found = self.last.borrow().1.as_ref().and_then(take);
        found.unwrap_or_else(|| Slope {
            value: NOWHERE,
            by: vec![0.0; at.len()],
        })
    }

    /// A run of quadratic programs from a point, whose best design is kept: also of a run that fails, by rounding mostly.
    fn minimize(&self, start: &[f64]) {
        let told = |found: Slope, gradient: Option<&mut [f64]>| {
            if let Some(gradient) = gradient {
                gradient.copy_from_slice(&found.by);
            }
            found.value
        };
        let objective = |at: &[f64], gradient: Option<&mut [f64]>, (): &mut ()| {
            told(self.with(at, |it| Some(self.cost(it, at))), gradient)
        };
        let constraint = |index: usize| {
            move |at: &[f64], gradient: Option<&mut [f64]>, (): &mut ()| {
                let of = |it: &Local| self.constraints_at(it, at).nth(index);
                told(self.with(at, of), gradient)
            }
        };
        let constraints: Vec<_> = (0..self.constraints).map(constraint).collect();
        let constraints: Vec<&dyn Func<()>> = constraints.iter().map(|it| it as _).collect();
        let tolerances = StopTols {
            ftol_rel: COST_TOLERANCE,
            xtol_abs: vec![STEP_TOLERANCE; start.len()],
            ..StopTols::default()
        };
        let (bounds, tolerances) = (self.bounds(), Some(tolerances));
        let _ = minimize(
            objective,
            start,
            &bounds,
            &constraints,
            (),
            MAX_EVALUATIONS,
            tolerances,
        );
    }

    fn cost(&self, found: &Local, at: &[f64]) -> Slope {
        match self.weights.is_empty() {
            true => {
                let objective = found.objective(&self.problem.objective);
                Slope {
                    value: -objective.value / self.score,
                    by: scaled(&objective, -1.0 / self.score).collect(),
                }
            }
            false => {
                let mean = self.mean_level(at);
                let own = (0..self.levels_at(at)).map(|_| 0.0);
                Slope {
                    value: -mean.value,
                    by: own.chain(scaled(&mean, -1.0)).collect(),
                }
            }
        }
    }

    /// What must be at most 0: how far short of its bound each constraint is, and how far above a score the level is that lies
    /// below it.
    fn constraints_at<'b>(
        &'b self,
        found: &'b Local,
        at: &'b [f64],
    ) -> impl Iterator<Item = Slope> + 'b {
        let levels = |own| unit_row(self.weights.len(), own);
        let constraints = found.constraints.iter().map(move |it| Slope {
            value: SLACK - it.slope.value,
            by: scaled(&it.slope, -1.0).chain(levels(None)).collect(),
        });
        let scores = self.scores(found).map(move |(index, score)| {
            let by = scaled(score, -1.0 / self.score);
            Slope {
                value: at[self.levels_at(at) + index] - score.value / self.score,
                by: by.chain(levels(Some(index))).collect(),
            }
        });
        constraints.chain(scores)
    }
}

/// Derivatives times a factor.
fn scaled(slope: &Slope, factor: f64) -> impl Iterator<Item = f64> {
    slope.by.iter().map(move |by| factor * by)
}
