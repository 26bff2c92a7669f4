//! ode_solvers. It locates no events: `solout` may stop a run after a step, not at a time within it. So the
//! law changes within steps, and the error control is left to find that out.

use std::cell::Cell;

use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, Dopri5, System, Vector2};

use crate::request::{End, Request};

type State = Vector2<f64>;

/// Steps after which it gives up; its own 100,000 are too few at small tolerances.
const MOST_STEPS: u32 = 50_000_000;
/// Steps between tests for stiffness: none, since the jumps of the law are taken for it.
const STIFFNESS_TEST: u32 = u32::MAX;

struct Machine<'a> {
    request: &'a Request,
    frequency: f64,
    contact: bool,
    impacts: &'a Cell<u64>,
}

impl System<f64, State> for Machine<'_> {
    fn system(&self, time: f64, y: &State, rate: &mut State) {
        let law = self.request.law(y[0] > self.request.scene.clearance);
        rate[0] = y[1];
        rate[1] = law.acceleration((self.frequency * time).cos(), y[0], y[1]);
    }

    fn solout(&mut self, _time: f64, y: &State, _rate: &State) -> bool {
        let contact = y[0] > self.request.scene.clearance;
        if contact && !self.contact {
            self.impacts.set(self.impacts.get() + 1);
        }
        self.contact = contact;
        false
    }
}

fn machine<'a>(request: &'a Request, frequency: f64, impacts: &'a Cell<u64>) -> Machine<'a> {
    Machine {
        request,
        frequency,
        contact: false,
        impacts,
    }
}

fn last(states: &[State], impacts: &Cell<u64>) -> Result<End, String> {
    let end = states.last().ok_or("no states")?;
    Ok((end[0], end[1], impacts.get()))
}

macro_rules! method {
    ($name:ident, $stepper:ident, $beta:expr, $least:expr, $most:expr, $about:expr) => {
        #[doc = $about]
        pub fn $name(request: &Request, frequency: f64) -> Result<End, String> {
            let impacts = Cell::new(0);
            let end = request.end(frequency);
            let mut stepper = $stepper::from_param(
                machine(request, frequency, &impacts),
                0.0,
                end,
                end,
                State::from(request.scene.start),
                request.tolerance,
                request.tolerance,
                0.9,
                $beta,
                $least,
                $most,
                end,
                0.0,
                MOST_STEPS,
                STIFFNESS_TEST,
                OutputType::Sparse,
            );
            stepper.integrate().map_err(|error| error.to_string())?;
            last(stepper.y_out(), &impacts)
        }
    };
}

method!(
    dop853,
    Dop853,
    0.0,
    0.333,
    6.0,
    "Dormand and Prince's pair of order 8, its own settings."
);
method!(
    dopri5,
    Dopri5,
    0.04,
    0.2,
    10.0,
    "Dormand and Prince's pair of order 5, its own settings."
);
