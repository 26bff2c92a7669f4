//! Newton's method for the fixed points of a stroboscopic map.

use nalgebra::{Matrix2, Vector2};

use super::{MapApplication, OrbitError, StroboscopicMap};
use crate::tolerance::ROUNDING_SHARE;
use softstop::MotionError;

/// Newton steps for a fixed point before giving up.
const MAX_NEWTON_STEPS: usize = 30;
/// Newton steps in a row that may fail to halve the least residual so far; those that lead to an orbit take fewer.
const MAX_IDLE_STEPS: usize = 12;
/// Halvings of a Newton step that leads beyond a rigid stop.
const MAX_HALVINGS: i32 = 40;

/// The fixed point P(s) = s of a stroboscopic map, by Newton's method with the exact Jacobian. It ends when a step no
/// longer makes the residual smaller, or none could, and the residual is at round-off.
///
/// # Errors
/// [`OrbitError::Diverged`] if it does not settle, [`OrbitError::Motion`] if a motion on the way cannot be computed.
pub fn find_fixed_point(
    map: &StroboscopicMap,
    start: Vector2<f64>,
) -> Result<(Vector2<f64>, MapApplication), OrbitError> {
    let found = find_new_fixed_point(map, start, |_| false)?;
    found.ok_or(OrbitError::LOST)
}

/// The fixed point that Newton's method finds; none as soon as a whole step leads to a state that is known.
pub(super) fn find_new_fixed_point(
    map: &StroboscopicMap,
    start: Vector2<f64>,
    known: impl Fn(Vector2<f64>) -> bool,
) -> Result<Option<(Vector2<f64>, MapApplication)>, OrbitError> {
    let mut state = start;
    let mut passage = map.apply(state)?;
    let scales = map.scene().scales();
    let size = |residual: &Vector2<f64>| scales.state(residual).norm();
    let mut residual = passage.end - state;
    let (mut least, mut idle) = (f64::INFINITY, 0);
    for _ in 0..MAX_NEWTON_STEPS {
        (least, idle) = match size(&residual) < 0.5 * least {
            true => (size(&residual), 0),
            false => (least, idle + 1),
        };
        if idle > MAX_IDLE_STEPS {
            break;
        }
        let matrix = Matrix2::identity() - passage.monodromy.matrix;
        let Some(step) = matrix.lu().solve(&residual) else {
            break;
        };
        if known(state + step) {
            return Ok(None);
        }
        let (next, next_passage) = step_within_walls(map, state, step)?;
        let next_residual = next_passage.end - next;
        let shrinks = size(&next_residual) < size(&residual);
        if !shrinks && size(&residual) <= scales.map_rounding(&state, &passage.monodromy) {
            return Ok(Some((state, passage)));
        }
        (state, passage, residual) = (next, next_passage, next_residual);
        if size(&residual) <= ROUNDING_SHARE * scales.map_rounding(&state, &passage.monodromy) {
            return Ok(Some((state, passage)));
        }
    }
    if size(&residual) <= scales.map_rounding(&state, &passage.monodromy) {
        return Ok(Some((state, passage)));
    }
    Err(OrbitError::Diverged {
        residual: size(&residual),
    })
}

/// The state after a Newton step and its image; the step is shortened where it leads beyond a rigid stop.
fn step_within_walls(
    map: &StroboscopicMap,
    state: Vector2<f64>,
    step: Vector2<f64>,
) -> Result<(Vector2<f64>, MapApplication), MotionError> {
    let mut last = None;
    for halvings in 0..MAX_HALVINGS {
        let next = state + step * 0.5f64.powi(halvings);
        match map.apply(next) {
            Err(error @ MotionError::BeyondStop { .. }) => last = Some(error),
            passage => return Ok((next, passage?)),
        }
    }
    Err(last.unwrap_or(MotionError::NotFinite {
        name: "Newton step",
        value: step.norm(),
    }))
}
