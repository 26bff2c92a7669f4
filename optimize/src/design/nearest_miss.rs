//! The point that comes nearest to a task which no design is known to meet: the method of Nelder and Mead (1965), restarted
//! with a smaller simplex until nothing is gained.

use argmin::core::{Error, Executor, State};
use argmin::solver::neldermead::NelderMead;

use super::problem::Problem;
use super::survey::{Survey, SurveyPoint};

/// Edges of the first simplex, in edges of the cube, and of each next one in units of the one before.
const FIRST_EDGE: f64 = 0.05;
const NARROWING: f64 = 0.2;
/// Simplexes at most, and iterations of each.
const RESTARTS: i32 = 8;
const MAX_ITERATIONS: u64 = 50;
/// Relative gain of a simplex that is too small for another one.
const LEAST_GAIN: f64 = 1e-10;
/// Relative scatter of the costs of a simplex that ends it.
const TOLERANCE: f64 = 1e-13;

/// The best point that is met from a point of the survey, within what that has left of its budget.
pub(super) fn nearest_miss(survey: &Survey<'_>, start: SurveyPoint) -> SurveyPoint {
    let mut best = start;
    if best.unit.is_empty() {
        return best;
    }
    for edge in (0..RESTARTS).map(|restart| FIRST_EDGE * NARROWING.powi(restart)) {
        let found = survey.charged(|| minimize(survey.problem, &best, edge));
        let Ok(found) = found else { break };
        let gain = best.cost - found.cost;
        if gain > 0.0 {
            best = found;
        }
        if gain <= LEAST_GAIN * best.cost.abs() && edge < FIRST_EDGE {
            break;
        }
    }
    best
}

fn minimize(problem: &Problem, from: &SurveyPoint, edge: f64) -> Result<SurveyPoint, Error> {
    let tolerance = TOLERANCE * from.cost.abs().max(1.0);
    let solver = NelderMead::new(simplex(&from.unit, edge)).with_sd_tolerance(tolerance)?;
    let found = Executor::new(problem, solver)
        .configure(|state| state.max_iters(MAX_ITERATIONS))
        .timer(false)
        .run()?;
    let unit = found.state.get_best_param().unwrap_or(&from.unit);
    Ok(SurveyPoint {
        unit: unit.iter().map(|at| at.clamp(0.0, 1.0)).collect(),
        cost: found.state.get_best_cost(),
        ranges: from.ranges,
    })
}

/// A simplex with one corner here and its edges pointing into the cube.
fn simplex(unit: &[f64], edge: f64) -> Vec<Vec<f64>> {
    let corner = |axis: usize| {
        let mut corner = unit.to_vec();
        corner[axis] += if corner[axis] + edge > 1.0 {
            -edge
        } else {
            edge
        };
        corner
    };
    let corners = (0..unit.len()).map(corner);
    [unit.to_vec()].into_iter().chain(corners).collect()
}

#[cfg(test)]
mod tests {
    use super::simplex;

    #[test]
    fn simplices_stay_inside_the_cube() {
        assert_eq!(
            simplex(&[1.0, 0.0], 0.25),
            [[1.0, 0.0], [0.75, 0.0], [1.0, 0.25]]
        );
    }
}
