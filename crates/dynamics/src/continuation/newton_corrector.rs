//! Newton's method for a point of a solution curve (the corrector), the curve's tangent, and the Jacobian by differences.

use nalgebra::{DMatrix, DVector};

use super::equations::{CurveNode, Equations, Evaluation};
use crate::orbit::OrbitError;
use crate::solve_linear::solve_linear;
use crate::tolerance::{DIFFERENCE_WIDTH, NEAR, ROUNDING, ROUNDING_SHARE};

/// Newton steps of a correction after which each must halve the residual.
const USUAL_CORRECTIONS: usize = 12;
/// Most Newton steps of a correction: across a corner of the motion the residual falls by a share only.
const MAX_CORRECTIONS: usize = 48;
/// Changes of the unknowns, in units of their rounding, by which the noise of the residual is measured.
const NOISE_PROBES: [f64; 4] = [-8.0, -4.0, 4.0, 8.0];
/// Share of the residual that a step with kept columns of the Jacobian may leave: beyond it, they are not used again.
const STALE_SHARE: f64 = 0.02;

/// Corrects a guess by Newton's method: in the plane across `normal` for a curve, with none for as many equations as
/// unknowns. It ends when a step no longer makes a residual smaller that is at round-off, or none could.
pub(crate) fn correct<E: Equations>(
    equations: &E,
    guess: &DVector<f64>,
    normal: Option<&DVector<f64>>,
) -> Result<CurveNode<E::Point>, OrbitError> {
    correct_with_columns(equations, guess, normal, &mut None, Accuracy::Full)
}

/// Corrects a guess to a solution where the last unknown is given: its column of the Jacobian plays no part.
pub(crate) fn correct_with_fixed_parameter<E: Equations>(
    equations: &E,
    guess: &DVector<f64>,
) -> Result<CurveNode<E::Point>, OrbitError> {
    let unknowns = guess.len();
    let normal = DVector::from_fn(unknowns, |row, _| f64::from(u8::from(row + 1 == unknowns)));
    let mut none = Some(DMatrix::zeros(unknowns - 1, unknowns - E::EXACT_COLUMNS));
    correct_with_columns(
        equations,
        guess,
        Some(&normal),
        &mut none,
        Accuracy::FixedParameter,
    )
}

/// Accuracy to which solutions are corrected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Accuracy {
    /// To the last digit.
    Full,
    /// To nine digits, and known from the place one Newton step before.
    Quick,
    /// To the last digit, with the last unknown given: its column plays no part.
    FixedParameter,
}

/// Corrects a guess by Newton's method as [`correct`], with `columns` of the Jacobian of a place nearby as long as they serve;
/// leaves in `columns` the last Jacobian used.
pub(super) fn correct_with_columns<E: Equations>(
    equations: &E,
    guess: &DVector<f64>,
    normal: Option<&DVector<f64>>,
    columns: &mut Option<DMatrix<f64>>,
    accuracy: Accuracy,
) -> Result<CurveNode<E::Point>, OrbitError> {
    let mut at = guess.clone();
    let mut last = f64::INFINITY;
    for round in 0..=MAX_CORRECTIONS {
        let here = equations.evaluate(&at)?;
        let size = here.residual.norm();
        let (fits, late) = (size <= here.tolerance, round >= USUAL_CORRECTIONS);
        let is_least = size >= 0.1 * last || size <= ROUNDING_SHARE * here.tolerance;
        if fits && (late || is_least) {
            return Ok(CurveNode { at, here });
        }
        if late && size > 0.5 * last {
            if NEAR * size < here.tolerance && size <= residual_noise(equations, &at, &here) {
                return Ok(CurveNode { at, here });
            }
            return Err(OrbitError::Diverged { residual: size });
        }
        let kept = columns
            .take()
            .filter(|_| accuracy == Accuracy::FixedParameter || size <= STALE_SHARE * last);
        let shrinks = size / std::mem::replace(&mut last, size);
        let exact = equations.exact_columns(&here);
        // Newton's method squares the residual, with columns that are none it shrinks at the same rate.
        let next = size
            * if exact.is_some() {
                shrinks * shrinks
            } else {
                shrinks
            };
        let known = match exact.or(kept) {
            Some(known) => known,
            None => jacobian_columns(equations, &at, &here)?,
        };
        let mut right = here.residual.clone();
        let mut matrix = -equations.jacobian(&here, columns.insert(known));
        if let Some(normal) = normal {
            right = right.push(normal.dot(&(guess - &at)));
            matrix = border_matrix(&matrix, normal);
        }
        match solve_linear(&matrix, &right) {
            Some(step) if step.iter().all(|part| part.is_finite()) => at += step,
            _ if fits => return Err(OrbitError::NotIsolated),
            _ => return Err(OrbitError::Diverged { residual: size }),
        }
        if accuracy == Accuracy::Quick && round > 0 && next <= ROUNDING {
            return Ok(CurveNode { at, here });
        }
    }
    Err(OrbitError::Diverged { residual: last })
}

/// Noise of the residual: how much it changes within the last digits of the unknowns, which an orbit may magnify.
fn residual_noise<E: Equations>(
    equations: &E,
    at: &DVector<f64>,
    here: &Evaluation<E::Point>,
) -> f64 {
    let change = |digits: &f64| {
        let there = equations.residual(&(at * (1.0 + digits * f64::EPSILON)));
        there.map_or(0.0, |there| (there - &here.residual).norm())
    };
    NOISE_PROBES.iter().map(change).fold(0.0, f64::max)
}

/// A matrix with a normal as one row more.
pub(super) fn border_matrix(matrix: &DMatrix<f64>, normal: &DVector<f64>) -> DMatrix<f64> {
    let rows = matrix.nrows();
    DMatrix::from_fn(rows + 1, rows + 1, |row, column| {
        if row < rows {
            matrix[(row, column)]
        } else {
            normal[column]
        }
    })
}

/// Unit tangent of a solution curve at a node, on the side of `along`, and the columns of the Jacobian there.
pub(crate) fn curve_tangent<E: Equations>(
    equations: &E,
    node: &CurveNode<E::Point>,
    along: &DVector<f64>,
) -> Result<(DVector<f64>, DMatrix<f64>), OrbitError> {
    let columns = jacobian_columns(equations, &node.at, &node.here)?;
    let matrix = border_matrix(&equations.jacobian(&node.here, &columns), along);
    let mut right = DVector::zeros(node.at.len());
    right[node.at.len() - 1] = 1.0;
    match solve_linear(&matrix, &right).map(|found| found.normalize()) {
        Some(direction) if direction.iter().all(|part| part.is_finite()) => {
            Ok((direction, columns))
        }
        _ => Err(OrbitError::NotIsolated),
    }
}

/// Columns of the Jacobian at a place, by the unknowns beyond the [`Equations::EXACT_COLUMNS`] first ones: exact where the system
/// knows them, otherwise differences, one-sided where the other side is another piece or has no machine.
pub(super) fn jacobian_columns<E: Equations>(
    equations: &E,
    at: &DVector<f64>,
    here: &Evaluation<E::Point>,
) -> Result<DMatrix<f64>, OrbitError> {
    let exact = equations.exact_columns(here);
    if let Some(exact) = exact.or_else(|| equations.variational_columns(here)) {
        return Ok(exact);
    }
    let column = |unknown: usize| {
        let beside = |shift: f64| {
            let mut at = at.clone();
            at[unknown] += shift;
            equations.residual_of_neighbour(&here.point, &at)
        };
        match (beside(DIFFERENCE_WIDTH), beside(-DIFFERENCE_WIDTH)) {
            (Ok((ahead, a)), Ok((behind, b))) if a == b => {
                Ok((ahead - behind) / (2.0 * DIFFERENCE_WIDTH))
            }
            (Ok((ahead, _)), Err(_) | Ok((_, false))) => {
                Ok((ahead - &here.residual) / DIFFERENCE_WIDTH)
            }
            (_, Ok((behind, _))) => Ok((&here.residual - behind) / DIFFERENCE_WIDTH),
            (Err(error), Err(_)) => Err(error),
        }
    };
    let columns = (E::EXACT_COLUMNS..at.len()).map(column);
    Ok(DMatrix::from_columns(
        &columns.collect::<Result<Vec<_>, _>>()?,
    ))
}
