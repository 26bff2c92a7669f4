//! The outer search over the axes: a survey on a lattice, a particle swarm that starts from it until it gains little,
//! gradients from the best particle and from the best points far from it, then
//! Nelder-Mead from the best of them, restarted with a fresh, smaller simplex until nothing is gained. The survey is
//! there because the best design can stand on a narrow ridge that a random swarm misses; Nelder-Mead is, because it can
//! stand where gradients end: where a zone gains a second fold inside it, the velocity jumps.
//!
//! All see the unit cube. The swarm keeps to it by itself; Nelder-Mead does not, so points
//! outside are pulled in, and an optimum on the boundary (common here) is met exactly.

use std::slice;
use std::sync::atomic::AtomicU64;

use argmin::core::{Error, Executor, State};
use argmin::solver::particleswarm::{Particle, ParticleSwarm};
use argmin_math::ArgminRandom;
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;
use rayon::prelude::*;
use softstop_dynamics::watch::Kept;

use super::coordinates::Summit;
use super::cost::{Cost, Point, Stoppable};
pub use super::cost::{Unwatched, Watch};
use super::gradient::ascend;
use super::polish::polish;
use super::space::Space;
use super::survey::survey;
use super::trial::pass;
use super::{Design, Infeasible, Problem};

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

/// Points from which gradients are followed, how far apart along an axis they are at least, and the gap of a point that
/// has no motion to begin with.
const STARTS: usize = 4;
const APART: f64 = 0.12;
const DISTANT: f64 = 10.0;
/// Share of the best score from which another design is a rival.
const RIVAL: f64 = 0.97;

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
        "no stable z = 1 motion in a hysteresis zone is as the task asks within the bounds; nearest try{place}: {reason}"
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

/// What a search has found.
#[derive(Debug, Clone)]
pub struct Found {
    /// The best design.
    pub design: Design,
    /// Its point of the unit cube.
    pub unit: Vec<f64>,
    /// Others, far from it and nearly as good: a small change of the task can make one of them the best.
    pub rivals: Vec<Design>,
}

/// The feasible design that is best by the problem's objective. What is known of the search is recalled.
///
/// # Errors
/// [`SearchError`] if nothing feasible was met or the watcher stopped the search.
pub fn search(
    problem: &Problem,
    settings: Settings,
    watch: &dyn Watch,
    kept: Kept<'_>,
) -> Result<Found, SearchError> {
    let space = Space(&problem.axes);
    let cost = Cost {
        problem,
        space,
        watch,
        kept,
        calls: AtomicU64::new(0),
    };
    let (best, summits) = match outer(&cost, settings) {
        Err(error) if !watch.stop() => return Err(SearchError::Optimizer(error)),
        outcome => outcome.unwrap_or_default(),
    };
    if watch.stop() {
        return Err(SearchError::Stopped);
    }
    let values = space.values(&best);
    let polished = problem
        .at(&values)
        .or_else(|_| problem.soon(slice::from_ref(&values)).remove(0));
    let lost = |infeasible: Infeasible| match watch.stop() {
        true => SearchError::Stopped,
        false => SearchError::NoDesign {
            place: place(problem, &values),
            reason: infeasible.reason,
        },
    };
    let score = |it: &Summit| problem.objective.score(it.design.value);
    let polished = polished.map(|design| Summit { unit: best, design });
    let best = match (polished, summits.first()) {
        (Ok(polished), Some(summit)) if score(&polished) < score(summit) => summit.clone(),
        (Ok(polished), _) => polished,
        (Err(_), Some(summit)) => summit.clone(),
        (Err(infeasible), None) => return Err(lost(infeasible)),
    };
    let best = pass(problem, &best).map_err(lost)?;
    let mut apart = vec![best.clone()];
    for summit in summits {
        let is_new = apart
            .iter()
            .all(|known| is_another(problem, &known.design, &summit.design));
        if is_new && score(&summit) > RIVAL * score(&best) {
            apart.push(summit);
        }
    }
    Ok(Found {
        rivals: apart.drain(1..).map(|it| it.design).collect(),
        design: best.design,
        unit: best.unit,
    })
}

/// True if two designs differ by more than a small part of the range of some axis.
fn is_another(problem: &Problem, one: &Design, other: &Design) -> bool {
    problem.axes.iter().any(|axis| {
        let [one, other] = [one, other].map(|it| it.machine.value(axis.parameter).unwrap_or(0.0));
        (one - other).abs() > APART * (axis.range.high - axis.range.low)
    })
}

/// True if two points of the cube are not one hill's.
fn is_apart(one: &[f64], other: &[f64]) -> bool {
    let far = |(a, b): (&f64, &f64)| (a - b).abs() > APART;
    one.iter().zip(other).any(far)
}

/// Values in words, after "nearest try".
fn place(problem: &Problem, values: &[f64]) -> String {
    if values.is_empty() {
        return String::new();
    }
    let said = problem.axes.iter().zip(values);
    let said = said.map(|(axis, value)| format!("{} = {value}", axis.parameter.name()));
    format!(", at {}", said.collect::<Vec<_>>().join(", "))
}

/// The best point of the unit cube, and what gradients have found, the best first.
fn outer(cost: &Cost<'_>, settings: Settings) -> Result<(Vec<f64>, Vec<Summit>), Error> {
    let dimension = cost.space.dimension();
    if dimension == 0 {
        cost.watch.evaluated(None);
        return Ok((Vec::new(), Vec::from_iter(ascend(cost.problem, &[]))));
    }
    let share = (dimension as u64 * settings.evaluations) / SURVEY;
    let survey = survey(cost, share.min(settings.evaluations / 3))?;
    let left = settings.evaluations.saturating_sub(survey.len() as u64);
    let swarm = left * 2 / 3;
    let best = swarm_best(cost, &survey, settings.seed, swarm)?;
    let mut starts = vec![best.clone()];
    for point in &survey {
        let is_new = starts
            .iter()
            .all(|start| is_apart(&start.unit, &point.unit));
        if starts.len() < STARTS && is_new && point.cost < DISTANT {
            starts.push(point.clone());
        }
    }
    let ascents = starts
        .par_iter()
        .map(|start| ascend(cost.problem, &start.unit));
    let mut summits: Vec<Summit> = ascents.collect::<Vec<_>>().into_iter().flatten().collect();
    let score = |it: &Summit| cost.problem.objective.score(it.design.value);
    summits.sort_by(|a, b| score(b).total_cmp(&score(a)));
    let summit = summits.first().map(|it| Point {
        unit: it.unit.clone(),
        cost: -score(it),
    });
    let start = [Some(best), summit].into_iter().flatten();
    let start = start.min_by(|a, b| a.cost.total_cmp(&b.cost));
    let start = start.ok_or_else(|| Error::msg("the swarm is empty"))?;
    Ok((polish(cost, start, left - swarm)?.unit, summits))
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
