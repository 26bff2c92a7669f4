//! Steps along a curve of solutions, as long as it allows.

use nalgebra::{DMatrix, DVector};

use super::arclength::{Care, Equations, Node, correct_with, tangent, tangent_with};
use crate::orbit::OrbitError;

/// First, smallest and largest arclength steps.
const FIRST_STEP: f64 = 0.02;
const SMALLEST_STEP: f64 = 1e-9;
pub(crate) const LARGEST_STEP: f64 = 0.25;
/// Largest turn of the direction per step, as a cosine, and that up to which steps grow.
const LARGEST_TURN: f64 = 0.96;
const GENTLE_TURN: f64 = 0.995;
/// Distance of the next node in steps beyond which it lies on another curve.
const LONGEST_CHORD: f64 = 1.1;
/// The former of these where guesses bend with the curve, and how many times as long the first step is there.
const QUICK_TURN: f64 = 0.985;
const QUICK_STEP: f64 = 2.5;

/// Goes along a curve with adaptive steps.
pub(crate) struct Walker<'a, E: Equations> {
    equations: &'a E,
    pub node: Node<E::Point>,
    pub direction: DVector<f64>,
    slopes: DMatrix<f64>,
    /// Change of the direction by arclength, across it, where guesses take it.
    bend: Option<DVector<f64>>,
    care: Care,
    /// Cosine of the turn of the direction per step up to which steps grow.
    gentle: f64,
    pub step: f64,
    largest: f64,
}

/// A step that can be taken.
pub(crate) struct Stride<P> {
    pub node: Node<P>,
    direction: DVector<f64>,
    slopes: DMatrix<f64>,
    grows: bool,
}

impl<'a, E: Equations> Walker<'a, E> {
    /// From a node on the side of `along`, with steps of at most `largest`.
    pub fn new(
        equations: &'a E,
        node: Node<E::Point>,
        along: &DVector<f64>,
        largest: f64,
    ) -> Result<Self, OrbitError> {
        let (direction, slopes) = tangent(equations, &node, along)?;
        Ok(Self {
            equations,
            bend: None,
            care: Care::Full,
            gentle: GENTLE_TURN,
            node,
            direction,
            slopes,
            step: FIRST_STEP.min(largest),
            largest,
        })
    }

    /// The same in fewer evaluations, with guesses that bend as the curve did: for smooth curves.
    pub fn quick(self) -> Self {
        Self {
            bend: Some(DVector::zeros(self.direction.len())),
            care: Care::Quick,
            gentle: QUICK_TURN,
            step: (QUICK_STEP * self.step).min(self.largest),
            ..self
        }
    }

    /// The next node at the present length of step.
    pub fn attempt(&self) -> Result<Stride<E::Point>, OrbitError> {
        let mut guess = &self.node.at + self.step * &self.direction;
        if let Some(bend) = &self.bend {
            guess += 0.5 * self.step * self.step * bend;
        }
        let mut slopes = Some(self.slopes.clone());
        let (equations, across) = (self.equations, Some(&self.direction));
        let node = correct_with(equations, &guess, across, &mut slopes, self.care)?;
        let (direction, slopes) = tangent_with(equations, &node, &self.direction, self.care)?;
        let turn = direction.dot(&self.direction);
        let leaps = (&node.at - &self.node.at).norm() > LONGEST_CHORD * self.step;
        if turn <= LARGEST_TURN || leaps {
            return Err(OrbitError::Diverged { residual: 0.0 });
        }
        Ok(Stride {
            node,
            direction,
            slopes,
            grows: turn > self.gentle,
        })
    }

    /// Goes there.
    pub fn take(&mut self, stride: Stride<E::Point>) {
        if let Some(bend) = &mut self.bend {
            let far = (&stride.node.at - &self.node.at).norm();
            let turn = (&stride.direction - &self.direction) / far;
            *bend = &turn - turn.dot(&stride.direction) * &stride.direction;
        }
        self.node = stride.node;
        self.direction = stride.direction;
        self.slopes = stride.slopes;
        if stride.grows {
            self.step = (1.6 * self.step).min(self.largest);
        }
    }

    /// Shortens the step; false if it is the shortest already.
    pub fn shorten(&mut self) -> bool {
        let possible = self.step > SMALLEST_STEP;
        self.step *= 0.4;
        possible
    }
}
