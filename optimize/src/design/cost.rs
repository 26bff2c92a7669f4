//! What the search minimises, and who watches it.

use std::borrow::Borrow;
use std::convert::Infallible;
use std::slice::from_ref;
use std::sync::atomic::{AtomicU64, Ordering};

use argmin::core::{CostFunction, Error};
use rayon::prelude::*;
use softstop_dynamics::watch::{Kept, piece};

use super::Problem;
use super::space::Space;

/// Who watches the search, from several threads at once.
pub trait Watch: Sync {
    /// One more zone has been computed; the value is what its best motion, if any, has of what is sought.
    fn evaluated(&self, value: Option<f64>);
    /// Whether to give up.
    fn stop(&self) -> bool;
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
    pub calls: AtomicU64,
}

/// Points computed between two looks at whether to stop.
const BLOCK: usize = 512;
/// Those of them that are kept together: groups of zones that are computed together.
const PIECE: usize = 16;
/// What a point costs, and what its best motion has of what is sought, if there is one.
type Found = (f64, Option<f64>);

impl Cost<'_> {
    /// What points cost. Never is NaN (the swarm would panic, Nelder-Mead stall); once stopped, infinite.
    fn costs(&self, units: &[Vec<f64>]) -> Vec<f64> {
        if self.watch.stop() {
            return vec![f64::INFINITY; units.len()];
        }
        let call = self.calls.fetch_add(1, Ordering::Relaxed);
        let pieces = units.par_chunks(PIECE).enumerate();
        let found = pieces.flat_map_iter(|(index, units)| {
            let Ok(found) = piece(self.kept, &(call, index), || {
                Ok::<_, Infallible>(self.found(units))
            });
            for (_, value) in &found {
                self.watch.evaluated(*value);
            }
            found.into_iter().map(|(cost, _)| cost)
        });
        found.collect()
    }

    fn found(&self, units: &[Vec<f64>]) -> Vec<Found> {
        let points: Vec<_> = units.iter().map(|unit| self.space.values(unit)).collect();
        let outcomes = self.problem.soon(&points).into_iter();
        let found = outcomes.map(|outcome| match outcome {
            Ok(design) => {
                let score = self.problem.objective.score(design.value);
                (-score, Some(design.value))
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
            if self.0.watch.stop() {
                return Err(Error::msg("stopped"));
            }
            let block: Vec<_> = block.iter().map(|unit| unit.borrow().clone()).collect();
            costs.extend(self.0.costs(&block));
        }
        Ok(costs)
    }
}
