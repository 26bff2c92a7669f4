//! The stepper along a solution curve, with steps as long as the curve allows.

use nalgebra::{DMatrix, DVector};

use super::continuation_settings::ContinuationSettings;
use super::equations::{CurveNode, Equations};
use super::newton_corrector::{Accuracy, correct_with_columns, curve_tangent};
use crate::orbit::OrbitError;

/// Crawling steps in a row after which a curve is given up.
const MAX_CRAWL_STEPS: usize = 60;
/// Share of a motion's size, in units of the family's scales, by which the largest step grows where the motion is that large:
/// at resonance with hardly any damping.
const HUGE_SHARE: f64 = 0.01;

/// A stepper along a solution curve, with adaptive steps.
pub(crate) struct Stepper<'a, E: Equations> {
    equations: &'a E,
    pub node: CurveNode<E::Point>,
    pub direction: DVector<f64>,
    columns: DMatrix<f64>,
    /// The last node and the direction there.
    last: Option<(DVector<f64>, DVector<f64>)>,
    accuracy: Accuracy,
    is_renewed: bool,
    pub step: f64,
    pub settings: ContinuationSettings,
    /// Crawling steps in a row.
    crawled: usize,
}

/// A step along a curve that can be taken.
pub(crate) struct CurveStep<P> {
    pub node: CurveNode<P>,
    pub direction: DVector<f64>,
    columns: DMatrix<f64>,
    growth: f64,
}

impl<'a, E: Equations> Stepper<'a, E> {
    /// A stepper from a node on the side of `along`.
    pub fn new(
        equations: &'a E,
        node: CurveNode<E::Point>,
        along: &DVector<f64>,
        settings: &ContinuationSettings,
    ) -> Result<Self, OrbitError> {
        let (direction, columns) = curve_tangent(equations, &node, along)?;
        Ok(Self {
            equations,
            last: None,
            accuracy: Accuracy::Full,
            is_renewed: false,
            node,
            direction,
            columns,
            step: settings.first_step.min(settings.largest_step),
            settings: *settings,
            crawled: 0,
        })
    }

    /// This stepper in few long steps, with guesses that bend as the curve did: for smooth curves.
    pub fn with_long_steps(self) -> Self {
        let settings = self.settings.with_long_steps();
        Self {
            accuracy: Accuracy::Quick,
            step: settings.first_step,
            settings,
            ..self
        }
    }

    /// Attempts a step of the present length: the next node of the curve.
    pub fn attempt_step(&self) -> Result<CurveStep<E::Point>, OrbitError> {
        let guess = self.predict();
        let mut columns = Some(self.columns.clone());
        let (equations, across) = (self.equations, Some(&self.direction));
        let node = correct_with_columns(equations, &guess, across, &mut columns, self.accuracy)?;
        let (direction, columns) = curve_tangent(equations, &node, &self.direction)?;
        let turn = direction.dot(&self.direction);
        let least = self.settings.min_turn_cosine;
        // A node farther off than the largest turn allows lies on another curve.
        let chord = (&node.at - &self.node.at).norm();
        if turn <= least || least * chord > self.step {
            return Err(OrbitError::Diverged { residual: 0.0 });
        }
        let growth = match self.accuracy {
            Accuracy::Quick => self.growth_at(turn, (&node.at - guess).norm()),
            _ if 1.0 - turn < 0.125 * (1.0 - least) => self.settings.step_growth,
            _ => 1.0,
        };
        Ok(CurveStep {
            node,
            direction,
            columns,
            growth,
        })
    }

    /// Factor by which a long step grows or shrinks, so that it makes half the largest turn and its guess is off by half of
    /// what Newton's method reaches, by the cosine of its turn and the error of its guess.
    fn growth_at(&self, turn: f64, off: f64) -> f64 {
        let settings = &self.settings;
        let by_turn = (0.5 * (1.0 - settings.min_turn_cosine) / (1.0 - turn)).sqrt();
        let by_guess = (0.5 * settings.newton_reach / off).powf(0.25);
        let most = settings.step_growth;
        by_turn.min(by_guess).clamp(most.recip(), most)
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
        let leans = self.accuracy == Accuracy::Quick
            || self.equations.needs_close_guess(&self.node.here.point);
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
        self.columns = step.columns;
        self.is_renewed = false;
        self.crawled = match self.step < self.settings.crawling_step {
            true => self.crawled + 1,
            false => 0,
        };
        let size = (HUGE_SHARE * self.equations.motion_size(&self.node.at)).max(1.0);
        self.step = (step.growth * self.step).min(size * self.settings.largest_step);
    }

    /// True if the steps have been crawling for so long that the curve is given up.
    pub fn is_crawling(&self) -> bool {
        self.crawled > MAX_CRAWL_STEPS
    }

    /// Shortens the step; false if it is the shortest already. A quick node, whose direction is that of the place one
    /// Newton step before, perhaps beyond a corner, is corrected anew.
    pub fn shorten_step(&mut self) -> bool {
        if self.accuracy == Accuracy::Quick
            && self.step < self.settings.doubtful_step
            && !self.is_renewed
        {
            self.is_renewed = true;
            self.renew_node().unwrap_or_default();
            return true;
        }
        let possible = self.step > self.settings.smallest_step;
        self.step *= 0.4;
        possible
    }

    /// Corrects the node and the direction there to the last digit.
    fn renew_node(&mut self) -> Result<(), OrbitError> {
        let across = Some(&self.direction);
        let node = correct_with_columns(
            self.equations,
            &self.node.at,
            across,
            &mut None,
            Accuracy::Full,
        )?;
        let (direction, columns) = curve_tangent(self.equations, &node, &self.direction)?;
        (self.node, self.direction, self.columns, self.last) = (node, direction, columns, None);
        Ok(())
    }
}
