//! Locating special points between two nodes of a solution curve.

use nalgebra::DVector;

use super::chord_and_cubic::{CurveCubic, is_beside};
use super::equations::{CurveNode, Equations, StepEnds};
use super::newton_corrector::{Accuracy, border_matrix, correct_with_columns, jacobian_columns};
use crate::orbit::OrbitError;
use crate::solve_linear::solve_linear;
use crate::tolerance::{DIFFERENCE_WIDTH, TEST_ROUNDING};
use softstop::internals::narrow_root;

/// Nodes known first: the two that a special point lies between.
const END_NODES: usize = 2;

/// Locates the node between two neighbours at which `test` changes its sign, and its share of the way: trials on the
/// curve through the nearest nodes known, each corrected across the chord, until rounding alone tells them apart on it.
pub(crate) fn locate_zero<E: Equations>(
    equations: &E,
    (from, to): StepEnds<'_, E::Point>,
    test: impl Fn(&CurveNode<E::Point>) -> f64,
) -> Result<(CurveNode<E::Point>, f64), OrbitError> {
    let way = &to.at - &from.at;
    let chord = way.normalize();
    let mut columns = None;
    let mut known = vec![(0.0, test(from), from.clone()), (1.0, test(to), to.clone())];
    let ends = ((0.0, known[0].1), (1.0, known[1].1));
    narrow_root(ends.0, ends.1, TEST_ROUNDING / way.norm(), |share| {
        let straight = known.len() == END_NODES && equations.needs_close_guess(&from.here.point);
        let bent = straight.then(|| CurveCubic::between(equations, (from, to)));
        let guess = match bent {
            Some(Ok(bent)) => bent.guess_at(share),
            _ => interpolate_nodes(&known, share),
        };
        let node = correct_with_columns(
            equations,
            &guess,
            Some(&chord),
            &mut columns,
            Accuracy::Full,
        )?;
        if !is_beside((&from.at, &way), &node.at) {
            return Err(OrbitError::LOST);
        }
        let value = test(&node);
        known.push((share, value, node));
        Ok::<f64, OrbitError>(value)
    })?;
    let tried = known.split_off(END_NODES);
    let candidates = if tried.is_empty() { known } else { tried };
    let best = candidates
        .into_iter()
        .rev()
        .min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    best.map(|(share, _, node)| (node, share))
        .ok_or(OrbitError::LOST)
}

/// Most rounds of solving for the zero of a test.
const MAX_ZERO_ROUNDS: usize = 12;
/// Last values of a test that its zero is interpolated from.
const SUPPORT_VALUES: usize = 4;

/// Solves for the node near the curve between two neighbours at which `test` vanishes. Each round is one evaluation: a
/// step of Newton's method to the curve, and along the chord to where the last values of the test say that it vanishes.
pub(crate) fn solve_zero<E: Equations>(
    equations: &E,
    (from, to): StepEnds<'_, E::Point>,
    test: impl Fn(&E::Point) -> f64,
) -> Result<CurveNode<E::Point>, OrbitError> {
    let lost = |residual| OrbitError::Diverged { residual };
    let way = &to.at - &from.at;
    let chord = way.normalize();
    let along = |at: &DVector<f64>| chord.dot(&(at - &from.at));
    let mut values = vec![
        (0.0, test(&from.here.point)),
        (along(&to.at), test(&to.here.point)),
    ];
    let cubic = CurveCubic::between(equations, (from, to))?;
    let mut at = cubic.guess_at(interpolated_zero(&values) / along(&to.at));
    for _ in 0..MAX_ZERO_ROUNDS {
        let here = equations.evaluate(&at)?;
        let (place, size) = (along(&at), here.residual.norm());
        values.push((place, test(&here.point)));
        values.drain(..values.len().saturating_sub(SUPPORT_VALUES));
        let onward = interpolated_zero(&values) - place;
        if size <= here.tolerance && onward.abs() <= TEST_ROUNDING {
            let is_between =
                (0.0..=along(&to.at)).contains(&place) && is_beside((&from.at, &way), &at);
            return is_between
                .then_some(CurveNode { at, here })
                .ok_or(lost(size));
        }
        let columns = jacobian_columns(equations, &at, &here)?;
        let matrix = border_matrix(&equations.jacobian(&here, &columns), &chord);
        let step = solve_linear(&matrix, &(-here.residual).push(onward));
        at += step.ok_or(lost(size))?;
    }
    Err(lost(f64::NAN))
}

/// Weights of the values at some places in their interpolation (Lagrange) at another one.
fn lagrange_weights(places: &[f64], at: f64) -> impl Iterator<Item = f64> {
    places.iter().enumerate().map(move |(index, own)| {
        let others = places.iter().enumerate();
        let others = others.filter(move |(other, _)| *other != index);
        others
            .map(|(_, place)| (at - place) / (own - place))
            .product()
    })
}

/// Where a function with these values vanishes, by inverse interpolation.
fn interpolated_zero(values: &[(f64, f64)]) -> f64 {
    let (places, heights): (Vec<f64>, Vec<f64>) = values.iter().copied().unzip();
    let parts = places.iter().zip(lagrange_weights(&heights, 0.0));
    parts.map(|(place, weight)| place * weight).sum()
}

/// Nodes that a guess between nodes is interpolated from.
const SUPPORT_NODES: usize = 4;

/// The point at this share of the way on the polynomial (Lagrange) through the nodes nearest to it.
fn interpolate_nodes<P>(known: &[(f64, f64, CurveNode<P>)], share: f64) -> DVector<f64> {
    let mut near: Vec<(f64, &DVector<f64>)> =
        known.iter().map(|(at, _, node)| (*at, &node.at)).collect();
    near.sort_by(|a, b| (a.0 - share).abs().total_cmp(&(b.0 - share).abs()));
    near.dedup_by(|a, b| (a.0 - b.0).abs() < DIFFERENCE_WIDTH);
    near.truncate(SUPPORT_NODES);
    let (places, nodes): (Vec<f64>, Vec<&DVector<f64>>) = near.into_iter().unzip();
    let parts = nodes.into_iter().zip(lagrange_weights(&places, share));
    parts.fold(DVector::zeros(known[0].2.at.len()), |sum, (at, weight)| {
        sum + at * weight
    })
}
