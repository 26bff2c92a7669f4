//! What the search minimises, and who watches it.

use std::borrow::Borrow;
use std::convert::Infallible;
use std::slice::from_ref;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use argmin::core::{CostFunction, Error};
use rayon::prelude::*;
use softstop::internals::budget;
use softstop_dynamics::watch::{Kept, piece};

use super::Problem;
use super::coordinates::Summit;
use super::space::Space;

/// Who watches the search, from several threads at once.
pub trait Watch: Sync {
    /// One more zone has been computed; the value is what its best motion, if any, has of what is sought.
    fn evaluated(&self, value: Option<f64>);
    /// Whether to give up.
    fn stop(&self) -> bool;
    /// Work that survey, swarm and polish may cost together, in scan windows.
    fn budget(&self) -> u64 {
        u64::MAX
    }
}

/// Watches nothing.
#[derive(Debug, Clone, Copy)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn evaluated(&self, _: Option<f64>) {}
    fn stop(&self) -> bool {
        false
    }
}

/// A point of the unit cube and what it costs.
#[derive(Debug, Clone)]
pub(super) struct Point {
    pub unit: Vec<f64>,
    pub cost: f64,
}

/// What the optimisers minimise: minus the score of what is sought, or a finite grade above every score.
pub(super) struct Cost<'search> {
    pub problem: &'search Problem,
    pub space: Space<'search>,
    pub watch: &'search dyn Watch,
    pub kept: Kept<'search>,
    /// Calls so far.
    calls: AtomicU64,
    /// Scan windows of the budget that are left.
    left: AtomicU64,
    best: Mutex<Option<Best>>,
}

/// How much of a design was looked at.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub(super) enum Rank {
    /// The motion alone.
    Seen,
    /// All machines within the tolerances.
    Held,
    /// And its trials.
    Passed,
}

/// The best design so far.
struct Best {
    rank: Rank,
    score: f64,
    summit: Summit,
}

/// Points computed between two looks at whether to stop.
const BLOCK: usize = 512;
/// Those of them that are kept together: groups of zones that are computed together.
const PIECE: usize = 16;
/// What a point costs, and what its best motion has of what is sought, if there is one.
type Found = (f64, Option<f64>);

impl<'search> Cost<'search> {
    /// That of a problem, with nothing computed.
    pub(super) fn new(
        problem: &'search Problem,
        watch: &'search dyn Watch,
        kept: Kept<'search>,
    ) -> Self {
        Self {
            problem,
            space: Space(&problem.axes),
            watch,
            kept,
            calls: AtomicU64::new(0),
            left: AtomicU64::new(watch.budget()),
            best: Mutex::new(None),
        }
    }

    /// True if the budget is spent.
    pub(super) fn is_over_budget(&self) -> bool {
        self.left.load(Ordering::Relaxed) == 0
    }

    fn stops(&self) -> bool {
        self.watch.stop() || self.is_over_budget()
    }

    /// Does work within the budget. Each part may cost what is left: whether the sum is over it does not depend on threads.
    fn charged<T>(&self, work: impl FnOnce() -> T) -> T {
        let (done, spent) = budget::within(self.left.load(Ordering::Relaxed), work);
        let less = |left: u64| Some(left.saturating_sub(spent));
        let _ = self
            .left
            .fetch_update(Ordering::Relaxed, Ordering::Relaxed, less);
        done
    }

    /// The best design so far.
    pub(super) fn best(&self) -> Option<Summit> {
        let best = self.best.lock().unwrap_or_else(PoisonError::into_inner);
        best.as_ref().map(|it| it.summit.clone())
    }

    /// Takes note of a design; one of which more was looked at counts more than others.
    pub(super) fn note(&self, summit: &Summit, rank: Rank) {
        let score = self.problem.objective.score(summit.design.value);
        let mut best = self.best.lock().unwrap_or_else(PoisonError::into_inner);
        if best
            .as_ref()
            .is_none_or(|it| (it.rank, it.score) < (rank, score))
        {
            *best = Some(Best {
                rank,
                score,
                summit: summit.clone(),
            });
        }
    }

    /// Whether a score is the best so far.
    fn is_best(&self, score: f64) -> bool {
        let best = self.best.lock().unwrap_or_else(PoisonError::into_inner);
        best.as_ref()
            .is_none_or(|it| it.rank == Rank::Seen && it.score < score)
    }

    /// What points cost. Never is NaN (the swarm would panic, Nelder-Mead stall); once stopped, infinite.
    fn costs(&self, units: &[Vec<f64>]) -> Vec<f64> {
        if self.stops() {
            return vec![f64::INFINITY; units.len()];
        }
        let call = self.calls.fetch_add(1, Ordering::Relaxed);
        let pieces = units.par_chunks(PIECE).enumerate();
        let found = pieces.flat_map_iter(|(index, units)| {
            let Ok(found) = self.charged(|| {
                piece(self.kept, &(call, index), || {
                    Ok::<_, Infallible>(self.found(units))
                })
            });
            for ((cost, value), unit) in found.iter().zip(units) {
                self.watch.evaluated(*value);
                // One that was recalled.
                if value.is_some() && self.is_best(-cost) {
                    budget::within(u64::MAX, || self.found(from_ref(unit)));
                }
            }
            found.into_iter().map(|(cost, _)| cost)
        });
        found.collect()
    }

    fn found(&self, units: &[Vec<f64>]) -> Vec<Found> {
        let points: Vec<_> = units.iter().map(|unit| self.space.values(unit)).collect();
        let outcomes = self.problem.soon(&points).into_iter();
        let found = outcomes.zip(units).map(|(outcome, unit)| match outcome {
            Ok(design) => {
                let (value, score) = (design.value, self.problem.objective.score(design.value));
                if self.is_best(score) {
                    let unit = unit.clone();
                    self.note(&Summit { unit, design }, Rank::Seen);
                }
                (-score, Some(value))
            }
            Err(infeasible) => (1.0 + infeasible.gap, None),
        });
        found.collect()
    }
}

impl CostFunction for &Cost<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    /// Never fails (Nelder-Mead would panic).
    fn cost(&self, unit: &Vec<f64>) -> Result<f64, Error> {
        Ok(self.costs(from_ref(unit))[0])
    }
}

/// The same for the survey and the swarm, many points at once: both are to end at once when they are stopped.
pub(super) struct Stoppable<'search>(pub &'search Cost<'search>);

impl CostFunction for Stoppable<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, unit: &Vec<f64>) -> Result<f64, Error> {
        Ok(self.bulk_cost(from_ref(unit))?[0])
    }

    fn bulk_cost<P: Borrow<Vec<f64>>>(&self, units: &[P]) -> Result<Vec<f64>, Error> {
        let mut costs = Vec::with_capacity(units.len());
        for block in units.chunks(BLOCK) {
            if self.0.stops() {
                return Err(Error::msg("stopped"));
            }
            let block: Vec<_> = block.iter().map(|unit| unit.borrow().clone()).collect();
            costs.extend(self.0.costs(&block));
        }
        Ok(costs)
    }
}
