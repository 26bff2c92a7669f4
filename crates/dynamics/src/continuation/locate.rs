//! Special points between two solutions of a curve.

use nalgebra::DVector;

use super::arclength::{Care, Equations, Node, correct_with};
use crate::orbit::OrbitError;
use softstop::internals::narrow;

/// The first two nodes known are those that a special point lies between.
const ENDS: usize = 2;

/// The node between two neighbours at which `test` changes its sign, and its share of the way: trials
/// on the curve through the nearest nodes known, each corrected across the chord, until they are `width` apart on
/// it.
pub(crate) fn locate<E: Equations>(
    equations: &E,
    (from, to): (&Node<E::Point>, &Node<E::Point>),
    width: f64,
    test: impl Fn(&Node<E::Point>) -> f64,
) -> Result<(Node<E::Point>, f64), OrbitError> {
    let way = &to.at - &from.at;
    let chord = way.normalize();
    let mut slopes = None;
    let mut known = vec![(0.0, test(from), from.clone()), (1.0, test(to), to.clone())];
    let ends = ((0.0, known[0].1), (1.0, known[1].1));
    narrow(ends.0, ends.1, width / way.norm(), |share| {
        let guess = interpolated(&known, share);
        let node = correct_with(equations, &guess, Some(&chord), &mut slopes, Care::Full)?;
        let value = test(&node);
        known.push((share, value, node));
        Ok::<f64, OrbitError>(value)
    })?;
    let tried = known.split_off(ENDS);
    let candidates = if tried.is_empty() { known } else { tried };
    let best = candidates
        .into_iter()
        .rev()
        .min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    best.map(|(share, _, node)| (node, share))
        .ok_or(OrbitError::Diverged { residual: f64::NAN })
}

/// Nodes that a guess between nodes is drawn through, and the shares of the way that they are apart at least.
const SUPPORT: usize = 4;
const APART: f64 = 1e-6;

/// The point at this share of the way on the polynomial (Lagrange) through the nodes nearest to it.
fn interpolated<P>(known: &[(f64, f64, Node<P>)], share: f64) -> DVector<f64> {
    let mut near: Vec<(f64, &DVector<f64>)> =
        known.iter().map(|(at, _, node)| (*at, &node.at)).collect();
    near.sort_by(|a, b| (a.0 - share).abs().total_cmp(&(b.0 - share).abs()));
    near.dedup_by(|a, b| (a.0 - b.0).abs() < APART);
    near.truncate(SUPPORT);
    let weight = |index: usize| -> f64 {
        let others = near.iter().enumerate().filter(|(other, _)| *other != index);
        let factors = others.map(|(_, (at, _))| (share - at) / (near[index].0 - at));
        factors.product()
    };
    let parts = near
        .iter()
        .enumerate()
        .map(|(index, (_, at))| *at * weight(index));
    parts.fold(DVector::zeros(known[0].2.at.len()), |sum, part| sum + part)
}
