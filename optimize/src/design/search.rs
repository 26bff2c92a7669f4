//! The outer search over stiffness and clearance: a survey on a lattice, a particle swarm that
//! starts from it until it gains little, then Nelder-Mead from the best particle, restarted with a
//! fresh, smaller simplex until nothing is gained. The survey is there because the best velocity can
//! stand on a narrow ridge that a random swarm misses: where a zone gains a second fold inside it,
//! the velocity jumps.
//!
//! All see the unit cube. The swarm keeps to it by itself; Nelder-Mead does not, so points
//! outside are pulled in, and an optimum on the boundary (common here) is met exactly.

use argmin::core::{CostFunction, Error, Executor, State};
use argmin::solver::neldermead::NelderMead;
use argmin::solver::particleswarm::{Particle, ParticleSwarm};
use argmin_math::ArgminRandom;
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use super::space::Space;
use super::{Design, Problem};

/// Fewest zones a search makes sense with.
pub const LEAST_EVALUATIONS: u64 = 100;
/// Particles of the swarm for each coordinate.
const PARTICLES: usize = 12;
/// Share of the evaluations that the survey takes for each coordinate, as 1 / share; most points along an axis.
const SURVEY: u64 = 15;
const LONGEST_EDGE: usize = 64;
/// Rounds of the swarm between two looks at what it has gained, and the gain, relative, that is too little to go on.
const SWARM_ROUNDS: u64 = 3;
const SWARM_GAIN: f64 = 1e-3;
/// Greatest velocity of a particle at the start, in edges of the cube per round.
const FASTEST: f64 = 0.2;
/// Edges of the first simplex of the polish, as a share of the box.
const FIRST_EDGE: f64 = 0.05;
/// By how much each restart of the polish narrows the simplex.
const NARROWING: f64 = 0.2;
const RESTARTS: usize = 8;
/// Rounds of one start of the polish: far more than it takes in two coordinates.
const MOST_ROUNDS: u64 = 200;
/// A restart that gains less than this, relative, is the last.
const GAIN: f64 = 1e-10;

/// How to search.
#[derive(Debug, Clone, Copy)]
pub struct Settings {
    /// The same seed gives the same result, on any number of cores.
    pub seed: u64,
    /// Zones to compute at most, at least [`LEAST_EVALUATIONS`].
    pub evaluations: u64,
}

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

/// The feasible design with the highest before-impact velocity.
///
/// # Errors
/// [`SearchError`] if nothing feasible was met or the watcher stopped the search.
pub fn search(
    problem: &Problem,
    settings: Settings,
    watch: &dyn Watch,
) -> Result<Design, SearchError> {
    let space = Space(&problem.axes);
    let cost = Cost {
        problem,
        space,
        watch,
    };
    let best = match outer(&cost, settings) {
        Err(error) if !watch.stop() => return Err(SearchError::Optimizer(error)),
        outcome => outcome.unwrap_or_default(),
    };
    if watch.stop() {
        return Err(SearchError::Stopped);
    }
    let values = space.values(&best);
    problem
        .at(&values)
        .map_err(|infeasible| SearchError::NoDesign {
            place: place(problem, &values),
            reason: infeasible.reason,
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

/// A point of the unit cube and what it costs.
#[derive(Debug, Clone)]
struct Point {
    unit: Vec<f64>,
    cost: f64,
}

/// What the optimisers minimise: minus the velocity, or a finite grade above every velocity.
struct Cost<'search> {
    problem: &'search Problem,
    space: Space<'search>,
    watch: &'search dyn Watch,
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
        let outcome = self.problem.at(&self.space.values(unit));
        self.watch
            .evaluated(outcome.as_ref().ok().map(Design::before_impact_velocity));
        Ok(match outcome {
            Ok(design) => -design.before_impact_velocity(),
            Err(infeasible) => 1.0 + infeasible.gap,
        })
    }
}

/// The same for the swarm, which is to end at once when it is stopped.
struct Stoppable<'search>(&'search Cost<'search>);

impl CostFunction for Stoppable<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, unit: &Vec<f64>) -> Result<f64, Error> {
        if self.0.watch.stop() {
            return Err(SearchError::Stopped.into());
        }
        self.0.cost(unit)
    }
}

/// Points of a lattice over the cube, its boundary included, the best ones first.
fn survey(cost: &Cost<'_>, evaluations: u64) -> Result<Vec<Point>, Error> {
    let dimension = cost.space.dimension();
    let root = (evaluations as f64).powf(1.0 / dimension as f64) + 1e-9;
    let edge = (root as usize).clamp(2, LONGEST_EDGE);
    let units: Vec<Vec<f64>> = (0..edge.pow(dimension as u32))
        .map(|index| lattice_point(index, edge, dimension))
        .collect();
    let costs = Stoppable(cost).bulk_cost(&units)?;
    let points = units.into_iter().zip(costs);
    let mut points: Vec<Point> = points.map(|(unit, cost)| Point { unit, cost }).collect();
    points.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    Ok(points)
}

/// The point of this number in a lattice with `edge` points along each axis.
fn lattice_point(index: usize, edge: usize, dimension: usize) -> Vec<f64> {
    let digit = |axis: usize| index / edge.pow(axis as u32) % edge;
    (0..dimension)
        .map(|axis| digit(axis) as f64 / (edge - 1) as f64)
        .collect()
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

fn polish(cost: &Cost<'_>, start: Point, evaluations: u64) -> Result<Point, Error> {
    let mut best = start;
    let mut edge = FIRST_EDGE;
    // A Nelder-Mead step takes one or two evaluations, a shrinking one more than that.
    let rounds = (evaluations / (2 * RESTARTS as u64)).clamp(10, MOST_ROUNDS);
    for _ in 0..RESTARTS {
        let found = nelder_mead(cost, &best, edge, rounds)?;
        let gain = best.cost - found.cost;
        let enough = gain > GAIN * best.cost.abs();
        if gain > 0.0 {
            best = found;
        }
        if !enough && edge < FIRST_EDGE {
            break;
        }
        edge *= NARROWING;
    }
    Ok(best)
}

fn nelder_mead(cost: &Cost<'_>, from: &Point, edge: f64, rounds: u64) -> Result<Point, Error> {
    let tolerance = 1e-13 * from.cost.abs().max(1.0);
    let solver = NelderMead::new(simplex(&from.unit, edge)).with_sd_tolerance(tolerance)?;
    let result = Executor::new(cost, solver)
        .configure(|state| state.max_iters(rounds))
        .timer(false)
        .run()?;
    let unit = result
        .state
        .get_best_param()
        .ok_or_else(|| Error::msg("the simplex is empty"))?;
    Ok(Point {
        unit: unit
            .iter()
            .map(|coordinate| coordinate.clamp(0.0, 1.0))
            .collect(),
        cost: result.state.get_best_cost(),
    })
}

/// A simplex with one corner here and its edges pointing into the cube.
fn simplex(unit: &[f64], edge: f64) -> Vec<Vec<f64>> {
    let mut corners = vec![unit.to_vec()];
    for axis in 0..unit.len() {
        let mut corner = unit.to_vec();
        corner[axis] += if corner[axis] + edge > 1.0 {
            -edge
        } else {
            edge
        };
        corners.push(corner);
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::{lattice_point, simplex};

    #[test]
    fn the_survey_reaches_the_corners() {
        assert_eq!(lattice_point(0, 3, 2), [0.0, 0.0]);
        assert_eq!(lattice_point(5, 3, 2), [1.0, 0.5]);
        assert_eq!(lattice_point(8, 3, 2), [1.0, 1.0]);
    }

    #[test]
    fn simplices_stay_inside_the_cube() {
        assert_eq!(
            simplex(&[1.0, 0.0], 0.25),
            [[1.0, 0.0], [0.75, 0.0], [1.0, 0.25]]
        );
    }
}
