//! The solvers of the crate `diffsol`, with its root finding.

use diffsol::error::DiffsolError;
use diffsol::{
    NalgebraContext, NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquations,
    OdeEquationsImplicit, OdeSolverMethod, OdeSolverProblem, OdeSolverStopReason,
};

use super::leg::{Leg, State};
use super::span::{Halt, Reached, Span, bounded};
use super::{Adaptive, AdaptiveScheme};

type Matrix = NalgebraMat<f64>;
type Direct = NalgebraLU<f64>;

/// Follows a leg by one of the crate's schemes.
pub(super) fn run(leg: &Leg<'_>, span: &Span, settings: &Adaptive) -> Result<Reached, Halt> {
    let refused = |error| halt(span.from, 0, &error);
    let problem = problem(leg, span, settings).map_err(refused)?;
    match settings.scheme {
        AdaptiveScheme::Tsit45 => follow(problem.tsit45().map_err(refused)?, leg, span),
        AdaptiveScheme::Esdirk34 => {
            follow(problem.esdirk34::<Direct>().map_err(refused)?, leg, span)
        }
        _ => follow(problem.bdf::<Direct>().map_err(refused)?, leg, span),
    }
}

/// The leg as diffsol takes it.
fn problem<'a>(
    leg: &'a Leg<'_>,
    span: &'a Span,
    settings: &Adaptive,
) -> Result<
    OdeSolverProblem<
        impl OdeEquationsImplicit<M = Matrix, V = NalgebraVec<f64>, T = f64, C = NalgebraContext> + 'a,
    >,
    DiffsolError,
> {
    OdeBuilder::<Matrix>::new()
        .t0(span.from)
        .rtol(settings.relative)
        .atol([settings.absolute])
        .rhs_implicit(
            |y, _, t, rate| rate.copy_from_slice(&leg.rate(t, pair(y))),
            |y, _, _, along, product| {
                product.copy_from_slice(&leg.rate_along(pair(y), pair(along)));
            },
        )
        .init(|_, _, y| y.copy_from_slice(&span.state), 2)
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
fn follow<'a, E, S>(mut solver: S, leg: &Leg<'_>, span: &Span) -> Result<Reached, Halt>
where
    E: OdeEquations<T = f64, V = NalgebraVec<f64>> + 'a,
    S: OdeSolverMethod<'a, E>,
{
    solver
        .set_stop_time(span.until)
        .map_err(|error| halt(span.from, 0, &error))?;
    let guards = |state: State| (0..leg.guard_count()).map(move |index| leg.guard(index, state));
    let mut before: Vec<f64> = guards(span.state).collect();
    let mut steps = 0;
    loop {
        let reason = solver
            .step()
            .map_err(|error| halt(solver.state().t, steps, &error))?;
        steps += 1;
        let (time, state) = (solver.state().t, pair(solver.state().y.batch_as_slice(0)));
        match reason {
            // Roots are found on the way down too; a guard counts on its way up.
            OdeSolverStopReason::RootFound(root, index) if before[index] <= 0.0 => {
                let found = solver
                    .interpolate(root)
                    .map_err(|error| halt(root, steps, &error))?;
                return Ok(Reached {
                    time: root,
                    state: pair(found.batch_as_slice(0)),
                    guard: Some(index),
                    steps,
                });
            }
            OdeSolverStopReason::RootFound(..) | OdeSolverStopReason::InternalTimestep => {
                within(leg, time, steps, state)?;
            }
            OdeSolverStopReason::TstopReached => {
                within(leg, time, steps, state)?;
                return Ok(Reached {
                    time,
                    state,
                    guard: None,
                    steps,
                });
            }
        }
        if steps >= span.most_steps {
            return Err(Halt::out_of_steps(time, steps));
        }
        before.clear();
        before.extend(guards(state));
    }
}

/// Refuses the end of a step at which no root was reported, if it lies beyond the phase or any bounds.
fn within(leg: &Leg<'_>, time: f64, steps: u64, state: State) -> Result<(), Halt> {
    bounded(time, steps, state)?;
    match leg.highest(state) {
        Some((_, value)) if value > 0.0 => {
            let reason = "a step ended beyond its phase, and diffsol reported no root";
            Err(Halt::new(time, steps, reason))
        }
        _ => Ok(()),
    }
}

fn pair(values: &[f64]) -> State {
    [values[0], values[1]]
}

fn halt(time: f64, steps: u64, error: &DiffsolError) -> Halt {
    Halt::new(time, steps, error.to_string())
}
