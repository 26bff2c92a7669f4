//! What the search minimises, and who watches it.

use argmin::core::{CostFunction, Error};

use super::space::Space;
use super::{Design, Problem};

/// Who watches the search, from several threads at once.
pub trait Watch: Sync {
    /// One more zone has been computed; the velocity is that of its best motion, if any.
    fn evaluated(&self, velocity: Option<f64>);
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

/// What the optimisers minimise: minus the velocity, or a finite grade above every velocity.
pub(super) struct Cost<'search> {
    pub problem: &'search Problem,
    pub space: Space<'search>,
    pub watch: &'search dyn Watch,
}

impl CostFunction for &Cost<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    /// Never is NaN (the swarm would panic, Nelder-Mead stall) and never fails (Nelder-Mead
    /// would panic); once stopped, infinite.
    fn cost(&self, unit: &Vec<f64>) -> Result<f64, Error> {
        if self.watch.stop() {
            return Ok(f64::INFINITY);
        }
        let outcome = self.problem.soon(&self.space.values(unit));
        self.watch
            .evaluated(outcome.as_ref().ok().map(Design::before_impact_velocity));
        Ok(match outcome {
            Ok(design) => -design.before_impact_velocity(),
            Err(infeasible) => 1.0 + infeasible.gap,
        })
    }
}

/// The same for the swarm, which is to end at once when it is stopped.
pub(super) struct Stoppable<'search>(pub &'search Cost<'search>);

impl CostFunction for Stoppable<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, unit: &Vec<f64>) -> Result<f64, Error> {
        if self.0.watch.stop() {
            return Err(Error::msg("stopped"));
        }
        self.0.cost(unit)
    }
}
