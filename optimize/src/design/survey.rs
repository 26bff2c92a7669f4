//! The survey of a search: the best motions of the zones at points all over the unit cube.

use std::convert::Infallible;
use std::slice::from_ref;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use argmin::core::{CostFunction, Error};
use softstop::internals::budget;
use softstop_dynamics::monitor::{OptionalMemory, recall_or_compute};
use softstop_dynamics::parallel;
use softstop_dynamics::spread_points::sobol_point;

use super::coordinates::Candidate;
use super::incumbent::{CheckLevel, Incumbent};
use super::problem::Problem;
use super::space::digits;
use super::zoned::ZonedMachine;
use super::{Design, Infeasible, line_search};
use crate::order::sort_rising;

/// Who watches a search, from several threads at once.
pub trait SearchMonitor: Sync {
    /// One more zone is computed; the value is what its best motion, if any, has of what is sought.
    fn evaluated(&self, _value: Option<f64>) {}
    /// Whether to give up.
    fn stop(&self) -> bool {
        false
    }
    /// So many problems of a front are done, of so many.
    fn posed(&self, _done: u64, _all: u64) {}
    /// Work that the survey and the ascents from it may cost, in scan windows.
    fn budget(&self) -> u64 {
        u64::MAX
    }
}

/// Watches one of many searches: it can be stopped and has a budget, and tells nothing.
pub struct QuietMonitor<'a>(pub &'a dyn SearchMonitor);

impl SearchMonitor for QuietMonitor<'_> {
    fn stop(&self) -> bool {
        self.0.stop()
    }

    fn budget(&self) -> u64 {
        self.0.budget()
    }
}

/// Watches nothing.
#[derive(Debug, Clone, Copy)]
pub struct Unmonitored;

impl SearchMonitor for Unmonitored {}

/// A point of the unit cube and its cost.
#[derive(Debug, Clone)]
pub(super) struct SurveyPoint {
    pub unit: Vec<f64>,
    pub cost: f64,
    /// Ranges of the zone, which are several where its branch folds back; 0 without a zone.
    pub ranges: usize,
}

/// Longest edge of the lattice, in points, and the shortest: below that it has nothing but corners.
const LONGEST_EDGE: usize = 64;
const SHORTEST_EDGE: usize = 3;
/// Points that are computed and kept together.
const PIECE: usize = 16;

/// Of a point: its cost, what its best motion has of what is sought, and the ranges of its zone.
type Computed = (f64, Option<f64>, usize);

/// Cost of an infeasible point: above that of every feasible one.
fn cost(problem: &Problem, outcome: &Result<Design, Infeasible>) -> f64 {
    match outcome {
        Ok(design) => -problem.score(design),
        Err(infeasible) => 1.0 + infeasible.gap,
    }
}

/// Minus the score of the best motion in the zone at a point of the unit cube; where there is none, a positive grade that
/// falls towards feasible points. Every optimiser of `argmin` that takes costs alone can minimise it.
impl CostFunction for &Problem {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, unit: &Vec<f64>) -> Result<f64, Error> {
        let values = self.axis_values(unit);
        Ok(cost(self, &self.at_batch(&[values])[0]))
    }
}

/// Computes points within a budget.
pub(super) struct Survey<'a> {
    pub problem: &'a Problem,
    pub watch: &'a dyn SearchMonitor,
    pub incumbent: &'a Incumbent<'a>,
    kept: OptionalMemory<'a>,
    /// Scan windows of the budget that are left, of all surveys about the same points.
    left: Arc<AtomicU64>,
}

impl<'a> Survey<'a> {
    pub(super) fn new(
        problem: &'a Problem,
        watch: &'a dyn SearchMonitor,
        incumbent: &'a Incumbent<'a>,
        kept: OptionalMemory<'a>,
    ) -> Self {
        Self {
            problem,
            watch,
            incumbent,
            kept,
            left: Arc::new(AtomicU64::new(watch.budget())),
        }
    }

    /// One of another problem about the same points, with the same budget.
    pub(super) fn of_problem<'b>(&'b self, problem: &'b Problem) -> Survey<'b> {
        Survey {
            problem,
            watch: self.watch,
            incumbent: self.incumbent,
            kept: None,
            left: Arc::clone(&self.left),
        }
    }

    /// True if the budget is spent.
    pub(super) fn is_over_budget(&self) -> bool {
        self.left.load(Ordering::Relaxed) == 0
    }

    /// Does work within the budget. Each part may cost what is left: whether the sum is over it does not depend on threads.
    pub(super) fn charged<T>(&self, work: impl FnOnce() -> T) -> T {
        let (done, spent) = budget::run_within(self.left.load(Ordering::Relaxed), work);
        let less = |left: u64| Some(left.saturating_sub(spent));
        let _ = self
            .left
            .fetch_update(Ordering::Relaxed, Ordering::Relaxed, less);
        done
    }

    /// At most so many points of the unit cube, the best ones first; none if the survey is stopped.
    pub(super) fn points(&self, evaluations: usize) -> Option<Vec<SurveyPoint>> {
        let units = units(self.problem.free_axes().count(), evaluations);
        let pieces: Vec<_> = units.chunks(PIECE).enumerate().collect();
        let pieces = parallel::map(&pieces, |(index, units)| self.piece(*index, units));
        let mut points = pieces.into_iter().collect::<Option<Vec<_>>>()?.concat();
        sort_rising(&mut points, |it| it.cost);
        Some(points)
    }

    /// Points that are recalled, or computed and kept; none if the survey is stopped.
    fn piece(&self, index: usize, units: &[Vec<f64>]) -> Option<Vec<SurveyPoint>> {
        if self.watch.stop() || self.is_over_budget() {
            return None;
        }
        let Ok(found) = self.charged(|| {
            recall_or_compute(self.kept, &index, || {
                Ok::<_, Infallible>(self.compute(units))
            })
        });
        let pairs = units.iter().zip(found);
        let point = |(unit, (cost, value, ranges)): (&Vec<f64>, Computed)| {
            self.watch.evaluated(value);
            // A recalled point has no design.
            if value.is_some() && self.incumbent.is_beaten_by(-cost) {
                budget::run_within(u64::MAX, || self.compute(from_ref(unit)));
            }
            let unit = unit.clone();
            SurveyPoint { unit, cost, ranges }
        };
        Some(pairs.map(point).collect())
    }

    /// What is computed of each point.
    fn compute(&self, units: &[Vec<f64>]) -> Vec<Computed> {
        let values = units.iter().map(|unit| self.problem.axis_values(unit));
        let values: Vec<_> = values.collect();
        let on_zone = |it: &ZonedMachine<'_>| Ok((line_search::best(it), it.zone.ranges().len()));
        let outcomes = self.problem.on_zones(&values, on_zone).into_iter();
        let outcomes = outcomes.map(|it| it.unwrap_or_else(|lack| (Err(lack), 0)));
        let found = outcomes.zip(units).map(|((outcome, ranges), unit)| {
            let cost = cost(self.problem, &outcome);
            let value = outcome.as_ref().ok();
            let value = value.map(|design| self.problem.sought_of(design));
            if let Ok(design) = outcome {
                let unit = unit.clone();
                self.incumbent
                    .update(&Candidate { unit, design }, CheckLevel::Motion);
            }
            (cost, value, ranges)
        });
        found.collect()
    }
}

/// Points of the unit cube: a lattice with its boundary. Where that would have nothing but corners, evenly many of these and
/// points of a low-discrepancy sequence.
fn units(dimension: usize, evaluations: usize) -> Vec<Vec<f64>> {
    if dimension == 0 {
        return vec![Vec::new()];
    }
    let root = (evaluations as f64).powf(1.0 / dimension as f64) + 1e-9;
    let edge = (root as usize).clamp(2, LONGEST_EDGE);
    let whole = edge.checked_pow(dimension as u32).unwrap_or(usize::MAX);
    let inside = match edge < SHORTEST_EDGE {
        true => evaluations.saturating_sub(whole).max(evaluations / 2),
        false => 0,
    };
    let count = whole.min((evaluations - inside).max(2));
    let lattice = (0..count)
        .map(|index| (index as u128 * whole as u128 / count as u128) as usize)
        .map(|index| lattice_point(index, edge, dimension));
    let inside = (0..inside).map(|index| {
        let place = sobol_point(index, dimension).into_iter();
        place.map(|at| 0.5 * (1.0 + at)).collect()
    });
    lattice.chain(inside).collect()
}

/// The point of this number in a lattice with `edge` points along each axis.
fn lattice_point(index: usize, edge: usize, dimension: usize) -> Vec<f64> {
    let digits = digits(index, edge, dimension);
    digits.map(|it| it as f64 / (edge - 1) as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::{lattice_point, units};

    #[test]
    fn the_survey_reaches_the_corners() {
        assert_eq!(lattice_point(0, 3, 2), [0.0, 0.0]);
        assert_eq!(lattice_point(5, 3, 2), [1.0, 0.5]);
        assert_eq!(lattice_point(8, 3, 2), [1.0, 1.0]);
    }

    #[test]
    fn of_many_axes_the_inside_is_surveyed_too() {
        for (dimension, evaluations) in [(1, 20), (2, 144), (5, 400), (7, 400), (10, 400)] {
            let units = units(dimension, evaluations);
            assert!(units.len() <= evaluations);
            let is_inside = |unit: &&Vec<f64>| unit.iter().all(|at| *at > 0.0 && *at < 1.0);
            assert!(units.iter().any(|unit| is_inside(&unit)), "{dimension}");
        }
    }
}
