//! The polish of the outer search: Nelder-Mead, restarted with a smaller simplex until nothing is gained.

use argmin::core::{Error, Executor, State};
use argmin::solver::neldermead::NelderMead;

use super::cost::{Cost, Point};

/// Edges of the first simplex of the polish, as a share of the box.
const FIRST_EDGE: f64 = 0.05;
/// By how much each restart of the polish narrows the simplex.
const NARROWING: f64 = 0.2;
const RESTARTS: usize = 8;
/// Rounds of one start of the polish: far more than it takes in two coordinates.
const MOST_ROUNDS: u64 = 200;
/// A restart that gains less than this, relative, is the last.
const GAIN: f64 = 1e-10;

/// The best point near `start`.
pub(super) fn polish(cost: &Cost<'_>, start: Point, evaluations: u64) -> Result<Point, Error> {
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
    use super::simplex;

    #[test]
    fn simplices_stay_inside_the_cube() {
        assert_eq!(
            simplex(&[1.0, 0.0], 0.25),
            [[1.0, 0.0], [0.75, 0.0], [1.0, 0.25]]
        );
    }
}
