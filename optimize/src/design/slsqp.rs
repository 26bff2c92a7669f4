//! Sequential quadratic programming (Kraft 1988, the crate `slsqp`) as a solver of `argmin`.

use std::cell::RefCell;

use argmin::core::{
    CostFunction, Error, Gradient, IterState, Jacobian, KV, Operator, Problem, Solver,
};
use slsqp::{Func, StopTols, minimize};

type SqpPoint = Vec<f64>;
type SqpState = IterState<SqpPoint, SqpPoint, (), (), (), f64>;

/// Minimises a [`CostFunction`] with its [`Gradient`] within bounds, where all values of an [`Operator`] with its
/// [`Jacobian`] are at most 0. An iteration is a run of quadratic programs from the point of the one before, without its
/// memory of curvature.
#[derive(Debug, Clone)]
pub struct Slsqp {
    /// Least and largest value of each coordinate.
    pub bounds: Vec<(f64, f64)>,
    /// Number of constraints.
    pub constraints: usize,
    /// Evaluations of an iteration at most.
    pub max_evaluations: usize,
    /// Relative change of the cost that ends an iteration.
    pub cost_tolerance: f64,
    /// Change of all coordinates that ends an iteration.
    pub step_tolerance: f64,
}

impl<P> Solver<P, SqpState> for Slsqp
where
    P: CostFunction<Param = SqpPoint, Output = f64>
        + Gradient<Param = SqpPoint, Gradient = SqpPoint>
        + Operator<Param = SqpPoint, Output = SqpPoint>
        + Jacobian<Param = SqpPoint, Jacobian = Vec<SqpPoint>>,
{
    fn name(&self) -> &str {
        "SLSQP"
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<P>,
        mut state: SqpState,
    ) -> Result<(SqpState, Option<KV>), Error> {
        let start = state
            .take_param()
            .ok_or_else(|| Error::msg("SLSQP needs a start"))?;
        let problem = RefCell::new(problem);
        let failure = RefCell::new(None);
        let or_nan = |result: Result<f64, Error>| {
            result.unwrap_or_else(|error| {
                failure.borrow_mut().get_or_insert(error);
                f64::NAN
            })
        };
        let objective = |at: &[f64], gradient: Option<&mut [f64]>, (): &mut ()| {
            let (at, mut problem) = (at.to_vec(), problem.borrow_mut());
            or_nan(problem.cost(&at).and_then(|cost| {
                if let Some(gradient) = gradient {
                    gradient.copy_from_slice(&problem.gradient(&at)?);
                }
                Ok(cost)
            }))
        };
        let constraint = |index: usize| {
            let (problem, or_nan) = (&problem, &or_nan);
            move |at: &[f64], gradient: Option<&mut [f64]>, (): &mut ()| {
                let (at, mut problem) = (at.to_vec(), problem.borrow_mut());
                or_nan(problem.apply(&at).and_then(|values| {
                    if let Some(gradient) = gradient {
                        gradient.copy_from_slice(&problem.jacobian(&at)?[index]);
                    }
                    Ok(values[index])
                }))
            }
        };
        let constraints: Vec<_> = (0..self.constraints).map(constraint).collect();
        let constraints: Vec<&dyn Func<()>> = constraints.iter().map(|it| it as _).collect();
        let tolerances = StopTols {
            ftol_rel: self.cost_tolerance,
            xtol_abs: vec![self.step_tolerance; start.len()],
            ..StopTols::default()
        };
        let found = minimize(
            objective,
            &start,
            &self.bounds,
            &constraints,
            (),
            self.max_evaluations,
            Some(tolerances),
        );
        // A run that fails, by rounding mostly, has its best point too.
        let (at, cost) = match found {
            Ok((_, at, cost)) | Err((_, at, cost)) => (at, cost),
        };
        if let Some(error) = failure.into_inner() {
            return Err(error);
        }
        Ok((state.param(at).cost(cost), None))
    }
}
