//! The stepper along a solution curve, with steps as long as the curve allows.

use nalgebra::{DMatrix, DVector};

use super::arclength::{Accuracy, Equations, Node, correct_with_slopes, curve_tangent};
use crate::orbit::OrbitError;

/// First step along a curve, in arclength.
const FIRST_STEP: f64 = 0.02;
/// Smallest step along a curve, in arclength.
const SMALLEST_STEP: f64 = 1e-11;
/// Largest step along a curve, in arclength, unless it is said otherwise.
pub(crate) const LARGEST_STEP: f64 = 0.25;
/// Cosine of the largest turn of the direction in a step.
const LARGEST_TURN: f64 = 0.96;
/// Cosine of the turn up to which steps grow.
const GENTLE_TURN: f64 = 0.995;
/// Distance of the next node in steps beyond which it lies on another curve.
const LONGEST_CHORD: f64 = 1.1;
/// Factor by which steps grow.
const STEP_GROWTH: f64 = 1.6;

/// First and largest of quick steps, in arclength.
const QUICK_STEPS: (f64, f64) = (0.05, 1.0);
/// Cosine of the largest turn of the direction in a quick step.
const QUICK_TURN: f64 = 0.85;
/// Cosine of the turn that quick steps are meant to make.
const MEANT_TURN: f64 = 0.93;
/// Scaled distance by which the guess of a quick step is meant to be off.
const MEANT_ERROR: f64 = 5e-3;
/// Least and largest factor by which quick steps grow.
const QUICK_GROWTH: (f64, f64) = (0.5, 2.5);
/// Quick step below which it is the node from which no step can be taken that is in doubt.
const DOUBTFUL_STEP: f64 = 1e-3;

/// A stepper along a solution curve, with adaptive steps.
pub(crate) struct Stepper<'a, E: Equations> {
    equations: &'a E,
    pub node: Node<E::Point>,
    pub direction: DVector<f64>,
    slopes: DMatrix<f64>,
    /// The last node and the direction there.
    last: Option<(DVector<f64>, DVector<f64>)>,
    accuracy: Accuracy,
    is_renewed: bool,
    pub step: f64,
    largest: f64,
}

/// A step along a curve that can be taken.
pub(crate) struct CurveStep<P> {
    pub node: Node<P>,
    pub direction: DVector<f64>,
    slopes: DMatrix<f64>,
    growth: f64,
}

impl<'a, E: Equations> Stepper<'a, E> {
    /// A stepper from a node on the side of `along`, with steps of at most `largest`.
    pub fn new(
        equations: &'a E,
        node: Node<E::Point>,
        along: &DVector<f64>,
        largest: f64,
    ) -> Result<Self, OrbitError> {
        let (direction, slopes) = curve_tangent(equations, &node, along)?;
        Ok(Self {
            equations,
            last: None,
            accuracy: Accuracy::Full,
            is_renewed: false,
            node,
            direction,
            slopes,
            step: FIRST_STEP.min(largest),
            largest,
        })
    }

    /// This stepper in few long steps, with guesses that bend as the curve did: for smooth curves.
    pub fn with_quick_steps(self) -> Self {
        let (step, largest) = QUICK_STEPS;
        Self {
            accuracy: Accuracy::Quick,
            step,
            largest,
            ..self
        }
    }

    /// Attempts a step of the present length: the next node of the curve.
    pub fn attempt_step(&self) -> Result<CurveStep<E::Point>, OrbitError> {
        let guess = self.predict();
        let mut slopes = Some(self.slopes.clone());
        let (equations, across) = (self.equations, Some(&self.direction));
        let node = correct_with_slopes(equations, &guess, across, &mut slopes, self.accuracy)?;
        let (direction, slopes) = curve_tangent(equations, &node, &self.direction)?;
        let turn = direction.dot(&self.direction);
        let leaps = (&node.at - &self.node.at).norm() > LONGEST_CHORD * self.step;
        let (largest, growth) = match self.accuracy {
            Accuracy::Quick => (QUICK_TURN, quick_growth(turn, (&node.at - guess).norm())),
            _ if turn > GENTLE_TURN => (LARGEST_TURN, STEP_GROWTH),
            _ => (LARGEST_TURN, 1.0),
        };
        if turn <= largest || leaps {
            return Err(OrbitError::Diverged { residual: 0.0 });
        }
        Ok(CurveStep {
            node,
            direction,
            slopes,
            growth,
        })
    }

    /// Predicts the next node, on the cubic through the last two nodes and their directions: in the plane across the
    /// direction here, a step away, but where steps are quick or the curve is steep.
    fn predict(&self) -> DVector<f64> {
        let straight = &self.node.at + self.step * &self.direction;
        let Some((last, before)) = &self.last else {
            return straight;
        };
        let (way, turn) = (&self.node.at - last, &self.direction - before);
        let far = way.norm() * (1.0 + turn.norm_squared() / 24.0);
        let mean = way / far;
        let (ahead, share) = (&self.direction - mean, self.step / far);
        let cubic = 2.0 * &ahead - &turn;
        let bend = self.step * share * ((&ahead + &cubic) + share * cubic);
        let leans =
            self.accuracy == Accuracy::Quick || self.equations.is_steep(&self.node.here.point);
        let along = if leans {
            0.0
        } else {
            bend.dot(&self.direction)
        };
        straight + bend - along * &self.direction
    }

    /// Takes a step: goes to its node, with the next length.
    pub fn step_to(&mut self, step: CurveStep<E::Point>) {
        let last = std::mem::replace(&mut self.node, step.node);
        let before = std::mem::replace(&mut self.direction, step.direction);
        self.last = Some((last.at, before));
        self.slopes = step.slopes;
        self.is_renewed = false;
        self.step = (step.growth * self.step).min(self.largest);
    }

    /// Shortens the step; false if it is the shortest already. A quick node, whose direction is that of the place one
    /// Newton step before, perhaps beyond a corner, is corrected anew.
    pub fn shorten_step(&mut self) -> bool {
        if self.accuracy == Accuracy::Quick && self.step < DOUBTFUL_STEP && !self.is_renewed {
            self.is_renewed = true;
            self.renew_node().unwrap_or_default();
            return true;
        }
        let possible = self.step > SMALLEST_STEP;
        self.step *= 0.4;
        possible
    }

    /// Corrects the node and the direction there to the last digit.
    fn renew_node(&mut self) -> Result<(), OrbitError> {
        let across = Some(&self.direction);
        let node = correct_with_slopes(
            self.equations,
            &self.node.at,
            across,
            &mut None,
            Accuracy::Full,
        )?;
        let (direction, slopes) = curve_tangent(self.equations, &node, &self.direction)?;
        (self.node, self.direction, self.slopes, self.last) = (node, direction, slopes, None);
        Ok(())
    }
}

/// Factor by which a quick step grows or shrinks, by the cosine of its turn and the error of its guess.
fn quick_growth(turn: f64, off: f64) -> f64 {
    let (least, most) = QUICK_GROWTH;
    let by_turn = ((1.0 - MEANT_TURN) / (1.0 - turn)).sqrt();
    let by_guess = (MEANT_ERROR / off).powf(0.25);
    by_turn.min(by_guess).clamp(least, most)
}
