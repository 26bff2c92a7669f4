//! Systems of equations whose solutions make curves, and the nodes of those curves.

use nalgebra::{DMatrix, DVector};

use crate::orbit::OrbitError;
use crate::tolerance::TEST_ROUNDING;

/// A system of equations in scaled unknowns; what is known exactly besides the evaluation spares differences.
pub(crate) trait Equations {
    /// What an evaluation brings to light besides the residual.
    type Point: Clone;
    /// Number of first unknowns by which an evaluation tells the derivatives; those by the others are the columns.
    const EXACT_COLUMNS: usize = 0;

    /// Evaluates the residual of the equations, and what comes to light besides.
    fn evaluate(&self, at: &DVector<f64>) -> Result<Evaluation<Self::Point>, OrbitError>;

    /// Derivatives of the residual, a row for each equation, with these columns; their error slows the convergence only.
    fn jacobian(&self, here: &Evaluation<Self::Point>, columns: &DMatrix<f64>) -> DMatrix<f64> {
        let _ = here;
        columns.clone()
    }

    /// Derivatives by the other unknowns, where all of them are known exactly.
    fn exact_columns(&self, here: &Evaluation<Self::Point>) -> Option<DMatrix<f64>> {
        let _ = here;
        None
    }

    /// The columns to first order in 1e-6, from the motion that an evaluation keeps; none where it does not tell them.
    fn variational_columns(&self, here: &Evaluation<Self::Point>) -> Option<DMatrix<f64>> {
        let _ = here;
        None
    }

    /// True if Newton's method settles only from guesses very near.
    fn needs_close_guess(&self, here: &Self::Point) -> bool {
        let _ = here;
        false
    }

    /// Size of the motion at a place, in units of the family's scales; 0 where the unknowns hold no state.
    fn motion_size(&self, at: &DVector<f64>) -> f64 {
        let _ = at;
        0.0
    }

    /// The residual alone at a place.
    fn residual(&self, at: &DVector<f64>) -> Result<DVector<f64>, OrbitError> {
        Ok(self.evaluate(at)?.residual)
    }

    /// The residual beside another place, and whether nothing that breaks a derivative lies between them.
    fn residual_of_neighbour(
        &self,
        here: &Self::Point,
        at: &DVector<f64>,
    ) -> Result<(DVector<f64>, bool), OrbitError> {
        let _ = here;
        Ok((self.residual(at)?, true))
    }
}

/// The equations evaluated at one place: residual, its rounding, and what came to light.
#[derive(Debug, Clone)]
pub(crate) struct Evaluation<P> {
    pub residual: DVector<f64>,
    /// Norm of the residual that rounding alone may leave.
    pub tolerance: f64,
    pub point: P,
}

impl<P> Evaluation<P> {
    /// This evaluation with one equation more: a test function vanishes.
    pub fn with_test(self, value: f64) -> Self {
        Self {
            residual: self.residual.push(value),
            tolerance: self.tolerance.max(TEST_ROUNDING),
            ..self
        }
    }
}

/// A node of a solution curve: the unknowns of a solution, with the equations evaluated there.
#[derive(Debug, Clone)]
pub(crate) struct CurveNode<P> {
    pub at: DVector<f64>,
    pub here: Evaluation<P>,
}

/// The nodes at both ends of a step along a curve.
pub(crate) type StepEnds<'n, P> = (&'n CurveNode<P>, &'n CurveNode<P>);
