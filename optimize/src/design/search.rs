//! The outer search over stiffness and clearance: a survey on a lattice, a particle swarm that
//! starts from it until it gains little, then Nelder-Mead from the best particle, restarted with a
//! fresh, smaller simplex until nothing is gained. The survey is there because the best velocity can
//! stand on a narrow ridge that a random swarm misses: where a zone gains a second fold inside it,
//! the velocity jumps.
//!
//! All see the unit cube. The swarm keeps to it by itself; Nelder-Mead does not, so points
//! outside are pulled in, and an optimum on the boundary (common here) is met exactly.

use std::sync::atomic::AtomicU64;

use argmin::core::{Error, Executor, State};
use argmin::solver::particleswarm::{Particle, ParticleSwarm};
use argmin_math::ArgminRandom;
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;
use softstop_dynamics::watch::Kept;

use super::cost::{Cost, Point, Stoppable};
pub use super::cost::{Unwatched, Watch};
use super::polish::polish;
use super::space::Space;
use super::survey::survey;
use super::{Design, Problem};

/// Fewest zones a search makes sense with.
pub const LEAST_EVALUATIONS: u64 = 100;
/// Particles of the swarm for each coordinate.
const PARTICLES: usize = 12;
/// Share of the evaluations that the survey takes for each coordinate, as 1 / share.
const SURVEY: u64 = 15;
/// Rounds of the swarm between two looks at what it has gained, and the gain, relative, that is too little to go on.
const SWARM_ROUNDS: u64 = 3;
const SWARM_GAIN: f64 = 1e-3;
/// Greatest velocity of a particle at the start, in edges of the cube per round.
const FASTEST: f64 = 0.2;

/// How to search.
#[derive(Debug, Clone, Copy)]
pub struct Settings {
    /// The same seed gives the same result, on any number of cores.
    pub seed: u64,
    /// Zones to compute at most, at least [`LEAST_EVALUATIONS`].
    pub evaluations: u64,
}

/// Why a search has no design to show.
#[derive(Debug, thiserror::Error)]
pub enum SearchError {
    /// Nothing within the bounds is feasible.
    #[error(
        "no stable z = 1 motion in a hysteresis zone was met within the bounds; nearest try, at {place}: {reason}"
    )]
    NoDesign {
        /// The least infeasible point: names and values.
        place: String,
        /// What is wrong there.
        reason: String,
    },
    /// The watcher said stop.
    #[error("stopped")]
    Stopped,
    /// The optimiser failed.
    #[error("the optimiser failed: {0}")]
    Optimizer(Error),
}

/// The feasible design with the highest before-impact velocity. What is known of the search is recalled.
///
/// # Errors
/// [`SearchError`] if nothing feasible was met or the watcher stopped the search.
pub fn search(
    problem: &Problem,
    settings: Settings,
    watch: &dyn Watch,
    kept: Kept<'_>,
) -> Result<Design, SearchError> {
    let space = Space(&problem.axes);
    let cost = Cost {
        problem,
        space,
        watch,
        kept,
        calls: AtomicU64::new(0),
    };
    let best = match outer(&cost, settings) {
        Err(error) if !watch.stop() => return Err(SearchError::Optimizer(error)),
        outcome => outcome.unwrap_or_default(),
    };
    if watch.stop() {
        return Err(SearchError::Stopped);
    }
    let values = space.values(&best);
    let design = problem
        .at(&values)
        .or_else(|_| problem.soon(std::slice::from_ref(&values)).remove(0));
    design.map_err(|infeasible| match watch.stop() {
        true => SearchError::Stopped,
        false => SearchError::NoDesign {
            place: place(problem, &values),
            reason: infeasible.reason,
        },
    })
}

/// Values in words.
fn place(problem: &Problem, values: &[f64]) -> String {
    let said = problem.axes.iter().zip(values);
    let said = said.map(|(axis, value)| format!("{} = {value}", axis.parameter.name()));
    said.collect::<Vec<_>>().join(", ")
}

/// The best point of the unit cube.
fn outer(cost: &Cost<'_>, settings: Settings) -> Result<Vec<f64>, Error> {
    if cost.space.dimension() == 0 {
        cost.watch.evaluated(None);
        return Ok(Vec::new());
    }
    let share = (cost.space.dimension() as u64 * settings.evaluations) / SURVEY;
    let survey = survey(cost, share.min(settings.evaluations / 3))?;
    let left = settings.evaluations - survey.len() as u64;
    let swarm = left * 2 / 3;
    let start = swarm_best(cost, &survey, settings.seed, swarm)?;
    Ok(polish(cost, start, left - swarm)?.unit)
}

/// The swarm: one half the best of the survey, the other spread over the rest of it.
fn particles(survey: &[Point], seed: u64) -> (Vec<Particle<Vec<f64>, f64>>, Xoshiro256PlusPlus) {
    let mut generator = Xoshiro256PlusPlus::seed_from_u64(seed);
    let dimension = survey.first().map_or(0, |point| point.unit.len());
    let count = (PARTICLES * dimension).min(survey.len());
    let (best, rest) = survey.split_at(count / 2);
    let stride = (rest.len() / (count - count / 2)).max(1);
    let chosen = best.iter().chain(rest.iter().step_by(stride)).take(count);
    let reach = vec![FASTEST; dimension];
    let back = vec![-FASTEST; dimension];
    let particles = chosen
        .map(|point| {
            let velocity = Vec::rand_from_range(&back, &reach, &mut generator);
            Particle::new(point.unit.clone(), point.cost, velocity)
        })
        .collect();
    (particles, generator)
}

fn swarm_best(
    cost: &Cost<'_>,
    survey: &[Point],
    seed: u64,
    evaluations: u64,
) -> Result<Point, Error> {
    let dimension = cost.space.dimension();
    let (mut particles, generator) = particles(survey, seed);
    let cube = (vec![0.0; dimension], vec![1.0; dimension]);
    let mut solver = ParticleSwarm::new(cube, particles.len()).with_rng_generator(generator);
    let mut left = evaluations / particles.len() as u64;
    let mut best = survey[0].clone();
    while left > 0 {
        let rounds = left.min(SWARM_ROUNDS);
        let result = Executor::new(Stoppable(cost), solver)
            .configure(|state| state.population(particles).max_iters(rounds))
            .timer(false)
            .run()?;
        let empty = || Error::msg("the swarm is empty");
        let found = result.state.get_best_param().ok_or_else(empty)?;
        let gain = best.cost - found.cost;
        if gain > 0.0 {
            best = Point {
                unit: found.position.clone(),
                cost: found.cost,
            };
        }
        let feasible = best.cost < 0.0;
        if feasible && gain <= SWARM_GAIN * best.cost.abs() {
            break;
        }
        particles = result.state.get_population().ok_or_else(empty)?.clone();
        solver = result.solver;
        left -= rounds;
    }
    Ok(best)
}
