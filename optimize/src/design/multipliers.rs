//! What holds a design back: the constraints whose multipliers are positive (Karush, Kuhn and Tucker).

use nalgebra::{DMatrix, DVector};

use super::constraint::{ActiveLimit, Limit};
use super::coordinates::{Candidate, Coordinates};
use super::critical::CriticalMachines;
use super::figure::Sense;
use super::local::{LocalModel, local};
use super::problem::Problem;
use super::slope::{Slope, unit_row};
use super::space::{Axis, End};

/// Value of a constraint, in its own unit, and distance from an end of a coordinate, at which a design stands there.
const AT_LIMIT: f64 = 1e-6;
/// Multiplier of a constraint that holds nothing back: change of the score by a change of the bound, both relative.
const IDLE: f64 = 1e-6;
/// What may be left of the gradient, relative; where it is more, multipliers tell nothing.
const RESIDUE: f64 = 1e-2;

/// What holds a design back.
#[derive(Debug, Clone)]
pub(super) struct ActiveLimits {
    /// All of it.
    pub limits: Vec<ActiveLimit>,
    /// Rate of the score, relative, by the edges of the cube, that nothing of it holds back; NaN where it is unknown.
    pub residue: f64,
}

/// What holds a design back, with what is known of the machines within its tolerances.
pub(super) fn held(problem: &Problem, it: &Candidate, known: &CriticalMachines) -> ActiveLimits {
    let coordinates = Coordinates::new(problem, &it.unit);
    let start = coordinates.start(it.design.place);
    let at = coordinates.at(&it.unit, &start);
    let ends = catalogue_ends(problem, &it.unit).into_iter();
    let mut limits: Vec<ActiveLimit> = ends.map(Limit::into).collect();
    let mut rest = f64::NAN;
    if let Some(found) = local(problem, &at, known) {
        let candidates = candidates(problem, &coordinates, &start, &found);
        let (held, residue) = held_by(problem, &found, candidates);
        limits.extend(held);
        rest = residue;
    }
    limits.extend(known.all_failed().map(|(figure, case)| ActiveLimit {
        limit: Limit::Required(figure, Sense::Least),
        case,
    }));
    let mut all: Vec<ActiveLimit> = Vec::new();
    for limit in limits {
        if !all.contains(&limit) {
            all.push(limit);
        }
    }
    ActiveLimits {
        limits: all,
        residue: rest,
    }
}

/// Ends of catalogues at which a point of the unit cube stands.
fn catalogue_ends(problem: &Problem, unit: &[f64]) -> Vec<Limit> {
    let values = problem.axis_values(unit);
    let axes = problem.axes.iter().zip(values);
    let axes = axes.filter(|(axis, _)| !axis.catalogue.is_empty());
    let end = |(axis, value): (&Axis, f64)| {
        let end = axis.end_at(value)?;
        Some(Limit::Axis(axis.parameter, end))
    };
    axes.filter_map(end).collect()
}

/// What a design stands at, each with its derivatives, inwards.
fn candidates(
    problem: &Problem,
    coordinates: &Coordinates,
    start: &[f64],
    found: &LocalModel,
) -> Vec<(ActiveLimit, Vec<f64>)> {
    let active = found.constraints.iter();
    let active = active.filter(|it| it.slope.value <= AT_LIMIT);
    let mut all: Vec<(ActiveLimit, Vec<f64>)> =
        active.map(|it| (it.limit, it.slope.by.clone())).collect();
    let bounds = coordinates.bounds(problem).into_iter();
    let parameters = coordinates.parameters(problem);
    for (index, ((low, high), at)) in bounds.zip(start).enumerate() {
        for (end, distance, inwards) in [(End::Lower, at - low, 1.0), (End::Upper, high - at, -1.0)]
        {
            if distance <= AT_LIMIT {
                let limit = match parameters.get(index) {
                    Some(parameter) => Limit::Axis(*parameter, end),
                    None => Limit::Margin(end),
                };
                let mut by = vec![0.0; start.len()];
                by[index] = inwards;
                all.push((limit.into(), by));
            }
        }
    }
    all
}

/// Those of them that hold the score back, and what they leave of its gradient.
fn held_by(
    problem: &Problem,
    found: &LocalModel,
    candidates: Vec<(ActiveLimit, Vec<f64>)>,
) -> (Vec<ActiveLimit>, f64) {
    let Slope {
        value: whole,
        by: rates,
    } = found.score(&problem.objective);
    let points = rates.len();
    let row = |by: &[f64], factor: f64, point: Option<usize>| {
        let by = by.iter().map(|by| by * factor);
        by.chain(unit_row(points, point)).collect::<Vec<f64>>()
    };
    // One weight for each score, of sum 1 in each operating point, so that the weighted gradient is what the constraints hold.
    let mut scores: Vec<Vec<f64>> = Vec::new();
    let mut gradient = DVector::zeros(found.scores[0].own.by.len());
    for (point, (it, rate)) in found.scores.iter().zip(&rates).enumerate() {
        let least = it.least().value;
        let active = it.all();
        let active = active.filter(|it| it.value - least <= AT_LIMIT * least.abs());
        let first = scores.len();
        scores.extend(active.map(|it| row(&it.by, rate / whole, Some(point))));
        gradient += DVector::from_column_slice(&scores[first][..gradient.len()]);
    }
    let size = scores[0].len();
    let rows = candidates.iter().map(|(_, by)| row(by, 1.0, None));
    let columns: Vec<Vec<f64>> = scores.iter().cloned().chain(rows).collect();
    let matrix = DMatrix::from_fn(size, columns.len(), |row, column| columns[column][row]);
    let mut target = DVector::zeros(size);
    target.rows_mut(size - points, points).fill(1.0);
    let (multipliers, residue) = non_negative_least_squares(&matrix, &target);
    let is_told = residue <= RESIDUE * gradient.norm().max(f64::MIN_POSITIVE);
    let multipliers = multipliers.iter().skip(scores.len());
    let pairs = candidates.into_iter().zip(multipliers);
    let held = pairs.filter(|(_, multiplier)| !is_told || **multiplier > IDLE);
    (held.map(|((limit, _), _)| limit).collect(), residue)
}

/// The x >= 0 with the least |A x - b|, and that (Lawson and Hanson 1974, chapter 23).
fn non_negative_least_squares(matrix: &DMatrix<f64>, target: &DVector<f64>) -> (Vec<f64>, f64) {
    let count = matrix.ncols();
    let mut found = vec![0.0; count];
    let mut passive: Vec<usize> = Vec::new();
    for _ in 0..3 * count {
        let rest = target - matrix * DVector::from_column_slice(&found);
        let gradient = matrix.tr_mul(&rest);
        let free = (0..count).filter(|index| !passive.contains(index));
        let steepest = free.max_by(|a, b| gradient[*a].total_cmp(&gradient[*b]));
        let Some(next) = steepest.filter(|it| gradient[*it] > f64::EPSILON.sqrt() * matrix.norm())
        else {
            break;
        };
        passive.push(next);
        loop {
            let columns = matrix.select_columns(&passive);
            let Ok(solved) = columns.svd(true, true).solve(target, f64::EPSILON) else {
                return (found, rest.norm());
            };
            let shares = passive.iter().zip(solved.iter());
            let shares = shares.filter(|(_, to)| **to <= 0.0);
            let share = shares.map(|(index, to)| found[*index] / (found[*index] - to));
            let share = share.fold(1.0, f64::min);
            for (index, to) in passive.iter().zip(solved.iter()) {
                found[*index] += share * (to - found[*index]);
            }
            if share >= 1.0 {
                break;
            }
            passive.retain(|index| {
                let stays = found[*index] > f64::EPSILON;
                if !stays {
                    found[*index] = 0.0;
                }
                stays
            });
            if passive.is_empty() {
                break;
            }
        }
    }
    let rest = target - matrix * DVector::from_column_slice(&found);
    (found, rest.norm())
}

#[cfg(test)]
mod tests {
    use super::non_negative_least_squares;
    use nalgebra::{DMatrix, DVector};

    #[test]
    fn what_would_be_negative_stays_zero() {
        let matrix = DMatrix::from_row_slice(3, 3, &[1.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
        let (found, rest) =
            non_negative_least_squares(&matrix, &DVector::from_column_slice(&[2.0, 1.0, 3.0]));
        let expected = [1.0, 1.0, 3.0];
        assert!(
            found
                .iter()
                .zip(expected)
                .all(|(a, b)| (a - b).abs() < 1e-12)
        );
        assert!(rest < 1e-12);
        let (found, rest) =
            non_negative_least_squares(&matrix, &DVector::from_column_slice(&[1.0, 2.0, -3.0]));
        // The first and the last would have to be -1 and -3: without them the second is 1.5.
        assert!(
            found
                .iter()
                .zip([0.0, 1.5, 0.0])
                .all(|(a, b)| (a - b).abs() < 1e-12)
        );
        assert!((rest - 9.5_f64.sqrt()).abs() < 1e-12);
    }
}
