//! Locating special points between two nodes of a solution curve.

use std::cell::RefCell;

use nalgebra::{DMatrix, DVector};

use super::arclength::{
    Accuracy, Ends, Equations, Node, border_matrix, correct_with_slopes, curve_tangent, slopes_at,
};
use crate::linear::solve_linear;
use crate::orbit::OrbitError;
use crate::tolerance::{DIFFERENCE_WIDTH, NEAR, TEST_ROUNDING};
use softstop::internals::narrow_root;

/// Nodes known first: the two that a special point lies between.
const END_NODES: usize = 2;

/// Locates the node between two neighbours at which `test` changes its sign, and its share of the way: trials on the
/// curve through the nearest nodes known, each corrected across the chord, until rounding alone tells them apart on it.
pub(crate) fn locate_zero<E: Equations>(
    equations: &E,
    (from, to): Ends<'_, E::Point>,
    test: impl Fn(&Node<E::Point>) -> f64,
) -> Result<(Node<E::Point>, f64), OrbitError> {
    let way = &to.at - &from.at;
    let chord = way.normalize();
    let mut slopes = None;
    let mut known = vec![(0.0, test(from), from.clone()), (1.0, test(to), to.clone())];
    let ends = ((0.0, known[0].1), (1.0, known[1].1));
    narrow_root(ends.0, ends.1, TEST_ROUNDING / way.norm(), |share| {
        let straight = known.len() == END_NODES && equations.is_steep(&from.here.point);
        let bent = straight.then(|| CurveCubic::between(equations, (from, to)));
        let guess = match bent {
            Some(Ok(bent)) => bent.guess_at(share),
            _ => interpolate_nodes(&known, share),
        };
        let node =
            correct_with_slopes(equations, &guess, Some(&chord), &mut slopes, Accuracy::Full)?;
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
    (from, to): Ends<'_, E::Point>,
    test: impl Fn(&E::Point) -> f64,
) -> Result<Node<E::Point>, OrbitError> {
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
            return is_between.then_some(Node { at, here }).ok_or(lost(size));
        }
        let slopes = slopes_at(equations, &at, &here)?;
        let matrix = border_matrix(&equations.jacobian(&here, &slopes), &chord);
        let step = solve_linear(&matrix, &(-here.residual).push(onward));
        at += step.ok_or(lost(size))?;
    }
    Err(lost(f64::NAN))
}

/// True if a place is no farther from the line between two neighbours than they are apart: else it is on another curve.
pub(super) fn is_beside((from, way): (&DVector<f64>, &DVector<f64>), at: &DVector<f64>) -> bool {
    along_chord((from, way), at).1 <= way.norm()
}

/// The share of the way along the chord between two neighbours at which a place lies, and its distance from it.
pub(super) fn along_chord(
    (from, way): (&DVector<f64>, &DVector<f64>),
    at: &DVector<f64>,
) -> (f64, f64) {
    let gone = at - from;
    let share = gone.dot(way) / way.norm_squared();
    (share, (gone - share * way).norm())
}

/// Distance of a point from the chord between its neighbours, as a share of it, up to which it is between them.
pub(crate) const MAX_CHORD_DISTANCE: f64 = 0.2;

/// True if a step of a curve passes a place: near enough, and no other piece that lies beside it.
pub(super) fn passes_place<E: Equations>(
    equations: &E,
    (from, to): Ends<'_, E::Point>,
    place: &DVector<f64>,
) -> bool {
    let way = &to.at - &from.at;
    let (share, off) = along_chord((&from.at, &way), place);
    (0.0..=1.0).contains(&share)
        && off < MAX_CHORD_DISTANCE * way.norm()
        && CurveCubic::between(equations, (from, to))
            .and_then(|cubic| cubic.node_at(share))
            .is_ok_and(|node| (place - &node.at).norm() < NEAR * way.norm())
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

/// The cubic between two nodes along the tangents of their curve.
pub(super) struct CurveCubic<'a, E: Equations> {
    equations: &'a E,
    from: &'a DVector<f64>,
    way: DVector<f64>,
    /// Unit tangents at both ends.
    directions: [DVector<f64>; 2],
    /// Slopes at the node found last.
    slopes: RefCell<Option<DMatrix<f64>>>,
}

impl<'a, E: Equations> CurveCubic<'a, E> {
    /// The cubic between two nodes of a curve.
    pub fn between(
        equations: &'a E,
        (from, to): (&'a Node<E::Point>, &Node<E::Point>),
    ) -> Result<Self, OrbitError> {
        let way = &to.at - &from.at;
        let (begins, slopes) = curve_tangent(equations, from, &way)?;
        let (ends, _) = curve_tangent(equations, to, &way)?;
        Ok(Self {
            equations,
            from: &from.at,
            way,
            directions: [begins, ends],
            slopes: RefCell::new(Some(slopes)),
        })
    }

    /// The point at this share of the way on the cubic: a guess of the curve's node.
    pub fn guess_at(&self, share: f64) -> DVector<f64> {
        let [begins, ends] = &self.directions;
        let far = self.way.norm() * (1.0 + (ends - begins).norm_squared() / 24.0);
        let (left, smooth) = (1.0 - share, share * share * (3.0 - 2.0 * share));
        let bend = (begins * left - ends * share) * (far * share * left);
        self.from + &self.way * smooth + bend
    }

    /// The node of the curve near the cubic at this share of the way.
    pub fn node_at(&self, share: f64) -> Result<Node<E::Point>, OrbitError> {
        let (guess, chord) = (self.guess_at(share), self.way.normalize());
        let slopes = &mut *self.slopes.borrow_mut();
        correct_with_slopes(self.equations, &guess, Some(&chord), slopes, Accuracy::Full)
    }
}

/// Nodes that a guess between nodes is interpolated from.
const SUPPORT_NODES: usize = 4;

/// The point at this share of the way on the polynomial (Lagrange) through the nodes nearest to it.
fn interpolate_nodes<P>(known: &[(f64, f64, Node<P>)], share: f64) -> DVector<f64> {
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
