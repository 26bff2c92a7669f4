//! diffsol with a root function and a reset, as its chapters "Events / Root finding" and "Resets" say.
//! Whether the mass is in contact is a third state that only the reset changes.

use diffsol::{
    DiffsolError, NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquations,
    OdeEquationsImplicit, OdeSolverMethod, OdeSolverProblem, OdeSolverStopReason,
};

use crate::request::{End, Request};

type Mat = NalgebraMat<f64>;
type Vector = NalgebraVec<f64>;

/// Failed steps after which it gives up: its own 50 and 40 are counted over the whole run.
const MOST_FAILURES: usize = 1_000_000;

/// Explicit Runge-Kutta, Tsitouras 5(4).
pub fn tsit45(request: &Request, frequency: f64) -> Result<End, String> {
    let solved = problem(request, frequency).and_then(|problem| {
        let mut solver = problem.tsit45()?;
        run(&mut solver, request.end(frequency))
    });
    solved.map_err(|error| error.to_string())
}

/// Backward differentiation of variable order.
pub fn bdf(request: &Request, frequency: f64) -> Result<End, String> {
    let solved = problem(request, frequency).and_then(|problem| {
        let mut solver = problem.bdf::<NalgebraLU<f64>>()?;
        run(&mut solver, request.end(frequency))
    });
    solved.map_err(|error| error.to_string())
}

fn problem(
    request: &Request,
    frequency: f64,
) -> Result<
    OdeSolverProblem<
        impl OdeEquationsImplicit<M = Mat, V = Vector, T = f64, C = <Mat as diffsol::MatrixCommon>::C>,
    >,
    DiffsolError,
> {
    let (free, contact) = (request.law(false), request.law(true));
    let law = move |mode: f64| if mode > 0.5 { contact } else { free };
    let clearance = request.scene.clearance;
    let [position, velocity] = request.scene.start;
    let mut problem = OdeBuilder::<Mat>::new()
        .rtol(request.tolerance)
        .atol([request.tolerance])
        .p([frequency])
        .rhs_implicit(
            move |y: &[f64], p: &[f64], t: f64, rate: &mut [f64]| {
                rate[0] = y[1];
                rate[1] = law(y[2]).acceleration((p[0] * t).cos(), y[0], y[1]);
                rate[2] = 0.0;
            },
            move |y: &[f64], _p: &[f64], _t: f64, v: &[f64], rate: &mut [f64]| {
                rate[0] = v[1];
                rate[1] = law(y[2]).acceleration(0.0, v[0], v[1]);
                rate[2] = 0.0;
            },
        )
        .init(
            move |_p: &[f64], _t: f64, y: &mut [f64]| {
                y.copy_from_slice(&[position, velocity, 0.0]);
            },
            3,
        )
        .root(
            move |y: &[f64], _p: &[f64], _t: f64, g: &mut [f64]| g[0] = y[0] - clearance,
            1,
        )
        .reset(move |y: &[f64], _p: &[f64], _t: f64, after: &mut [f64]| {
            let contact = f64::from(u8::from(y[1] > 0.0));
            after.copy_from_slice(&[clearance, y[1], contact]);
        })
        .build()?;
    problem.ode_options.max_nonlinear_solver_failures = MOST_FAILURES;
    problem.ode_options.max_error_test_failures = MOST_FAILURES;
    Ok(problem)
}

fn run<'a, E, S>(solver: &mut S, end: f64) -> Result<End, DiffsolError>
where
    E: OdeEquations<M = Mat, V = Vector, T = f64> + 'a,
    S: OdeSolverMethod<'a, E>,
{
    let mut impacts = 0;
    solver.set_stop_time(end)?;
    loop {
        match solver.step()? {
            OdeSolverStopReason::InternalTimestep => {}
            OdeSolverStopReason::RootFound(time, _) => {
                solver.state_mut_back(time)?;
                impacts += u64::from(solver.state().y[1] > 0.0);
                solver.apply_reset()?;
                solver.set_stop_time(end)?;
            }
            OdeSolverStopReason::TstopReached => {
                let y = solver.state().y;
                return Ok((y[0], y[1], impacts));
            }
        }
    }
}
