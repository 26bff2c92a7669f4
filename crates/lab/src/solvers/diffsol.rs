//! The solvers of the crate `diffsol`, with its root finding.

use diffsol::error::DiffsolError;
use diffsol::{
    NalgebraContext, NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquations,
    OdeEquationsImplicit, OdeSolverMethod, OdeSolverProblem, OdeSolverStopReason,
};

use super::Adaptive;
use super::leg::{Leg, Outcome, Reached, SolverState, bounded, out_of_steps};
use crate::methods::MethodError;

type Matrix = NalgebraMat<f64>;
type Direct = NalgebraLU<f64>;

/// Follows a leg by Tsitouras' scheme.
pub(super) fn tsit45(leg: &Leg<'_>, settings: &Adaptive) -> Outcome {
    let problem = problem(leg, settings).map_err(refused(leg))?;
    follow(problem.tsit45().map_err(refused(leg))?, leg)
}

/// Follows a leg by the diagonally implicit scheme.
pub(super) fn esdirk34(leg: &Leg<'_>, settings: &Adaptive) -> Outcome {
    let problem = problem(leg, settings).map_err(refused(leg))?;
    follow(problem.esdirk34::<Direct>().map_err(refused(leg))?, leg)
}

/// Follows a leg by backward differences.
pub(super) fn bdf(leg: &Leg<'_>, settings: &Adaptive) -> Outcome {
    let problem = problem(leg, settings).map_err(refused(leg))?;
    follow(problem.bdf::<Direct>().map_err(refused(leg))?, leg)
}

/// The leg as diffsol takes it.
fn problem<'a>(
    leg: &'a Leg<'_>,
    settings: &Adaptive,
) -> Result<
    OdeSolverProblem<
        impl OdeEquationsImplicit<M = Matrix, V = NalgebraVec<f64>, T = f64, C = NalgebraContext> + 'a,
    >,
    DiffsolError,
> {
    OdeBuilder::<Matrix>::new()
        .t0(leg.from)
        .rtol(settings.tolerance)
        .atol([settings.tolerance])
        .rhs_implicit(
            |y, _, t, rate| rate.copy_from_slice(&leg.rate(t, pair(y))),
            |y, _, _, along, product| {
                product.copy_from_slice(&leg.rate_along(pair(y), pair(along)));
            },
        )
        .init(|_, _, y| y.copy_from_slice(&leg.state), 2)
        .root(
            |y, _, _, roots| {
                for (index, root) in roots.iter_mut().enumerate() {
                    *root = leg.guard(index, pair(y));
                }
            },
            leg.guard_count(),
        )
        .build()
}

/// Steps until a guard rises through zero.
fn follow<'a, E, S>(mut solver: S, leg: &Leg<'_>) -> Outcome
where
    E: OdeEquations<T = f64, V = NalgebraVec<f64>> + 'a,
    S: OdeSolverMethod<'a, E>,
{
    solver.set_stop_time(leg.until).map_err(refused(leg))?;
    let guards =
        |state: SolverState| (0..leg.guard_count()).map(move |index| leg.guard(index, state));
    let mut before: Vec<f64> = guards(leg.state).collect();
    let mut steps = 0;
    loop {
        let reason = solver.step();
        let reason = reason.map_err(|error| halt(solver.state().t, steps, &error))?;
        steps += 1;
        let (time, state) = (solver.state().t, pair(solver.state().y.batch_as_slice(0)));
        let reached = |time, state, guard| Reached {
            time,
            state,
            guard,
            steps,
        };
        match reason {
            // Roots are found on the way down too; a guard counts on its way up.
            OdeSolverStopReason::RootFound(root, index) if before[index] <= 0.0 => {
                let found = solver.interpolate(root);
                let found = found.map_err(|error| halt(root, steps, &error))?;
                return Ok(reached(root, pair(found.batch_as_slice(0)), Some(index)));
            }
            OdeSolverStopReason::RootFound(..) | OdeSolverStopReason::InternalTimestep => {
                within(leg, time, steps, state)?;
            }
            OdeSolverStopReason::TstopReached => {
                within(leg, time, steps, state)?;
                return Ok(reached(time, state, None));
            }
        }
        if steps >= leg.most_steps {
            return Err(out_of_steps(time, steps));
        }
        before.clear();
        before.extend(guards(state));
    }
}

/// Refuses the end of a step at which no root was reported, if it lies beyond the phase or any bounds.
fn within(leg: &Leg<'_>, time: f64, steps: u64, state: SolverState) -> Result<(), MethodError> {
    bounded(time, state)?;
    if leg.height(state) > 0.0 {
        let reason = "a step ended beyond its phase, and diffsol reported no root";
        return Err(MethodError::stuck(time, steps, reason));
    }
    Ok(())
}

fn pair(values: &[f64]) -> SolverState {
    [values[0], values[1]]
}

fn halt(time: f64, steps: u64, error: &DiffsolError) -> MethodError {
    MethodError::stuck(time, steps, error.to_string())
}

/// What was wrong before the first step.
fn refused(leg: &Leg<'_>) -> impl Fn(DiffsolError) -> MethodError + use<> {
    let from = leg.from;
    move |error| halt(from, 0, &error)
}
