//! The solvers of the crate `differential-equations`, with guards sought by steps of the same scheme.
//!
//! Its own events and dense output are not used: in version 0.7.0 the search for an event loses its bracket, and the
//! interpolants are not those of the schemes' authors.

use crate::methods::{MethodError, Probe, locate_rise};
use differential_equations::control::ControlFlag;
use differential_equations::error::Error;
use differential_equations::interpolate::Interpolation;
use differential_equations::ivp::IVP;
use differential_equations::methods::{DormandPrince, ExplicitRungeKutta, Ordinary};
use differential_equations::ode::ODE;
use differential_equations::solout::Solout;
use differential_equations::solution::Solution as Points;

use super::Adaptive;
use super::leg::{Leg, Outcome, Reached, SolverState, bounded};

/// A scheme of the crate with O coefficients of its interpolant, S stages and I with those of the interpolant.
type RungeKutta<const O: usize, const S: usize, const I: usize> =
    ExplicitRungeKutta<Ordinary, DormandPrince, f64, SolverState, O, S, I>;

/// Follows a leg by Dormand and Prince's scheme of order 5.
pub(super) fn dopri5(leg: &Leg<'_>, settings: &Adaptive) -> Outcome {
    follow(ExplicitRungeKutta::dopri5, leg, settings)
}

/// Follows a leg by that of order 8.
pub(super) fn dop853(leg: &Leg<'_>, settings: &Adaptive) -> Outcome {
    follow(ExplicitRungeKutta::dop853, leg, settings)
}

impl ODE<f64, SolverState> for Leg<'_> {
    fn diff(&self, time: f64, state: &SolverState, rate: &mut SolverState) {
        *rate = self.rate(time, *state);
    }
}

/// Steps until a guard has risen, then seeks the place by shorter steps from where that step began.
fn follow<const O: usize, const S: usize, const I: usize>(
    scheme: fn() -> RungeKutta<O, S, I>,
    leg: &Leg<'_>,
    settings: &Adaptive,
) -> Outcome {
    let most = usize::try_from(leg.most_steps).unwrap_or(usize::MAX);
    let method = || {
        let method = scheme().rtol(settings.tolerance).atol(settings.tolerance);
        method.max_steps(most)
    };
    let start = (leg.from, leg.state);
    let mut watch = Watch {
        leg,
        before: start,
        reached: start,
        steps: 0,
        risen: false,
    };
    let problem = IVP::ode(leg, leg.from, leg.until, leg.state).method(method());
    let outcome = problem.solout(&mut watch).solve();
    let (before, (time, state), steps) = (watch.before, watch.reached, watch.steps);
    let failed =
        |error: Error<f64, SolverState>| MethodError::stuck(time, steps, format!("{error:?}"));
    outcome.map_err(failed)?;
    bounded(time, state)?;
    let mut reached = Reached {
        time,
        state,
        guard: None,
        steps,
    };
    if watch.risen {
        // Of several guards the first zero of the highest.
        let ends = [before, (time, state)].map(|(at, state)| Probe {
            at,
            value: leg.height(state),
            state,
        });
        // What rounding leaves of position and of time.
        let slope = (ends[1].value - ends[0].value) / (time - before.0);
        let width = 4.0 * f64::EPSILON * time.abs();
        let tolerance = 2.0 * f64::EPSILON * (leg.size() + slope * time.abs());
        let found = locate_rise(ends, width, tolerance, |at| {
            let step = IVP::ode(leg, before.0, at, before.1);
            let points = step.method(method().h0(at - before.0)).solve();
            let state = points.map_err(failed)?.y.last().copied();
            let state = state.unwrap_or(before.1);
            Ok::<_, MethodError>((leg.height(state), state))
        })?;
        (reached.time, reached.state) = (found.at, found.state);
        reached.guard = leg.highest(found.state).map(|(index, _)| index);
    }
    Ok(reached)
}

/// Watches the steps of a leg.
struct Watch<'a> {
    leg: &'a Leg<'a>,
    /// Where the last step began and where it ended.
    before: (f64, SolverState),
    reached: (f64, SolverState),
    steps: u64,
    /// A guard was above zero at its end.
    risen: bool,
}

impl Solout<f64, SolverState> for &mut Watch<'_> {
    fn solout<I>(
        &mut self,
        time: f64,
        before: f64,
        state: &SolverState,
        from: &SolverState,
        _: &mut I,
        _: &mut Points<f64, SolverState>,
    ) -> ControlFlag<f64, SolverState>
    where
        I: Interpolation<f64, SolverState> + ?Sized,
    {
        // The start is shown too.
        if time <= before {
            return ControlFlag::Continue;
        }
        (self.before, self.reached) = ((before, *from), (time, *state));
        self.steps += 1;
        self.risen = self.leg.height(*state) > 0.0;
        match self.risen || bounded(time, *state).is_err() {
            true => ControlFlag::Terminate,
            false => ControlFlag::Continue,
        }
    }
}
