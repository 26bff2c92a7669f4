//! Adaptive solvers of other crates behind [`Integrator`]: what one reaches with a good library and an event
//! function.
//!
//! | scheme | crate | source |
//! |---|---|---|
//! | [`tsit45`](AdaptiveScheme::Tsit45) | diffsol | Tsitouras, Comput. Math. Appl. 62 (2011) 770-775: explicit, order 5(4) |
//! | [`esdirk34`](AdaptiveScheme::Esdirk34) | diffsol | Jorgensen, Kristensen and Thomsen (2018), arXiv:1803.01613: diagonally implicit, order 3(4) |
//! | [`bdf`](AdaptiveScheme::Bdf) | diffsol | backward differences of orders 1 to 5; Shampine and Reichelt, SIAM J. Sci. Comput. 18 (1997) 1-22 |
//! | [`dopri5`](AdaptiveScheme::Dopri5) | differential-equations | Dormand and Prince, J. Comput. Appl. Math. 6 (1980) 19-26: explicit, order 5(4) |
//! | [`dop853`](AdaptiveScheme::Dop853) | differential-equations | Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I (1993), II.5: explicit, order 8(5,3) |
//!
//! The smooth law of one phase is followed with that phase's guards as the solver's event functions; at an
//! event the core's rules of landing choose state and phase, and the solver begins anew there. All settings but
//! the tolerance are the crates' own. While the mass is held the solver follows the drive instead, which
//! has to let it go.
//!
//! A contact that begins and ends within one step is passed over by all of them. diffsol's roots are its own: it looks
//! for a change of sign between the ends of a step, so it does not see a crossing in the first step of a leg
//! that begins on the very surface, where the event function is zero. A step that ends beyond its phase without
//! a root reported is an error, not mended. The events of differential-equations 0.7.0 do not work (its file says
//! why), so there the crossing is sought by steps of the same scheme from the start of the step that passed it,
//! each counted.
//!
//! Evaluations count calls of the law of force, those along the Jacobian included. Steps are accepted ones.

mod differential_equations;
mod diffsol;
mod leg;

use crate::methods::{Integrator, MethodError, Solution, Task, Work, in_range};
use softstop::internals::PhaseTracker;
use softstop::{MotionError, Start};

use leg::{Leg, Outcome, out_of_steps};

/// A scheme of a crate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AdaptiveScheme {
    /// diffsol's Tsitouras 5(4).
    Tsit45,
    /// diffsol's diagonally implicit scheme of order 3(4).
    Esdirk34,
    /// diffsol's backward differences.
    Bdf,
    /// differential-equations' Dormand and Prince 5(4).
    Dopri5,
    /// differential-equations' Dormand and Prince 8(5,3).
    Dop853,
}

impl AdaptiveScheme {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Tsit45,
        Self::Esdirk34,
        Self::Bdf,
        Self::Dopri5,
        Self::Dop853,
    ];

    /// The crate and its name for the scheme.
    pub fn name(self) -> &'static str {
        self.solver().0
    }

    /// The same, and what follows a leg by it.
    fn solver(self) -> (&'static str, Follow) {
        match self {
            Self::Tsit45 => ("diffsol tsit45", diffsol::tsit45),
            Self::Esdirk34 => ("diffsol esdirk34", diffsol::esdirk34),
            Self::Bdf => ("diffsol bdf", diffsol::bdf),
            Self::Dopri5 => (
                "differential-equations dopri5",
                differential_equations::dopri5,
            ),
            Self::Dop853 => (
                "differential-equations dop853",
                differential_equations::dop853,
            ),
        }
    }
}

/// Follows a leg.
type Follow = fn(&Leg<'_>, &Adaptive) -> Outcome;

/// A crate's solver with its tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Adaptive {
    /// The scheme.
    pub scheme: AdaptiveScheme,
    /// Error allowed in a step, relative to position and velocity, and as much in m and in m/s, > 0.
    pub tolerance: f64,
}

impl Integrator for Adaptive {
    fn name(&self) -> String {
        format!("{}, tolerance {:e}", self.scheme.name(), self.tolerance)
    }

    fn integrate(&self, task: &Task) -> Result<Solution, MethodError> {
        let tolerance = self.tolerance;
        let holds = tolerance > 0.0 && tolerance.is_finite();
        in_range("tolerance", tolerance, holds, "finite and > 0")?;
        let until = task.until()?;
        let (_, follow) = self.scheme.solver();
        let mut walk =
            PhaseTracker::new(&task.scene.check().map_err(MotionError::from)?, task.start)?;
        let mut work = Work::default();
        let mut end = walk.state();
        // Within rounding of the end no solver can make a step.
        while until - walk.time() > 1e3 * f64::EPSILON * until {
            let left = task.most_steps.saturating_sub(work.steps);
            let leg = Leg::new(&task.scene, &walk, until, left);
            let outcome = match left {
                0 => Err(out_of_steps(leg.from, 0)),
                _ => follow(&leg, self),
            };
            work.evaluations += leg.evaluations();
            let reached = outcome.map_err(|error| match error {
                MethodError::Stuck { steps, .. } => error.after(work.steps + steps),
                other => other,
            })?;
            work.steps += reached.steps;
            if walk.phase().is_some() {
                let [position, velocity] = reached.state;
                end = Start::new(position, velocity);
            }
            let Some(guard) = reached.guard else { break };
            let crossed = walk.cross(guard, reached.time, end);
            crossed.map_err(|error| MethodError::from(error).after(work.steps))?;
            end = walk.state();
        }
        Ok(Solution {
            end: (end.position, end.velocity),
            impacts: walk.into_impacts(),
            work,
        })
    }
}
