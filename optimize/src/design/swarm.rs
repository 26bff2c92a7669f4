//! The swarm of the outer search (argmin): it starts from the survey and ends when it gains little.

use argmin::core::{Error, Executor, State};
use argmin::solver::particleswarm::{Particle, ParticleSwarm};
use argmin_math::ArgminRandom;
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use super::cost::{Cost, Point, Stoppable};

/// Particles of the swarm for each coordinate.
const PARTICLES: usize = 12;
/// Rounds of the swarm between two looks at what it has gained, and the gain, relative, that is too little to go on.
const ROUNDS: u64 = 3;
const GAIN: f64 = 1e-3;
/// Greatest velocity of a particle at the start, in edges of the cube per round.
const FASTEST: f64 = 0.2;

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

/// The best point that the swarm meets.
pub(super) fn swarm_best(
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
        let rounds = left.min(ROUNDS);
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
        if feasible && gain <= GAIN * best.cost.abs() {
            break;
        }
        particles = result.state.get_population().ok_or_else(empty)?.clone();
        solver = result.solver;
        left -= rounds;
    }
    Ok(best)
}
