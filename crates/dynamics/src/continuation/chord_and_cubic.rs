//! The chord and the cubic between two nodes of a solution curve: which places lie between the nodes, and guesses of nodes there.

use std::cell::RefCell;

use nalgebra::{DMatrix, DVector};

use super::equations::{CurveNode, Equations, StepEnds};
use super::newton_corrector::{Accuracy, correct_with_columns, curve_tangent};
use crate::orbit::OrbitError;
use crate::tolerance::NEAR;

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
    (from, to): StepEnds<'_, E::Point>,
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

/// The cubic between two nodes along the tangents of their curve.
pub(super) struct CurveCubic<'a, E: Equations> {
    equations: &'a E,
    from: &'a DVector<f64>,
    way: DVector<f64>,
    /// Unit tangents at both ends.
    directions: [DVector<f64>; 2],
    /// Slopes at the node found last.
    columns: RefCell<Option<DMatrix<f64>>>,
}

impl<'a, E: Equations> CurveCubic<'a, E> {
    /// The cubic between two nodes of a curve.
    pub fn between(
        equations: &'a E,
        (from, to): (&'a CurveNode<E::Point>, &CurveNode<E::Point>),
    ) -> Result<Self, OrbitError> {
        let way = &to.at - &from.at;
        let (begins, columns) = curve_tangent(equations, from, &way)?;
        let (ends, _) = curve_tangent(equations, to, &way)?;
        Ok(Self {
            equations,
            from: &from.at,
            way,
            directions: [begins, ends],
            columns: RefCell::new(Some(columns)),
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
    pub fn node_at(&self, share: f64) -> Result<CurveNode<E::Point>, OrbitError> {
        let (guess, chord) = (self.guess_at(share), self.way.normalize());
        let columns = &mut *self.columns.borrow_mut();
        correct_with_columns(
            self.equations,
            &guess,
            Some(&chord),
            columns,
            Accuracy::Full,
        )
    }
}
