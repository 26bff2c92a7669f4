//! ode_solvers. It locates no events: `solout` may stop a run after a step, not at a time within it. So the
//! law changes within steps, and the error control is left to find that out.

use std::cell::Cell;

use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, Dopri5, System, Vector2, Vector3};

use crate::request::{End, Request};

/// Steps after which it gives up; its own 100,000 are too few at small tolerances.
const MOST_STEPS: u32 = 50_000_000;
/// Steps between tests for stiffness: none, since the jumps of the law are taken for it.
const STIFFNESS_TEST: u32 = u32::MAX;

struct OdeSolversMachine<'a> {
    request: &'a Request,
    frequency: f64,
    contact: bool,
    impacts: &'a Cell<u64>,
}

impl OdeSolversMachine<'_> {
    fn acceleration(&self, time: f64, position: f64, velocity: f64) -> f64 {
        let law = self.request.law(position > self.request.scene.clearance);
        law.acceleration((self.frequency * time).cos(), position, velocity)
    }

    fn note(&mut self, position: f64) {
        let contact = position > self.request.scene.clearance;
        if contact && !self.contact {
            self.impacts.set(self.impacts.get() + 1);
        }
        self.contact = contact;
    }
}

impl System<f64, Vector2<f64>> for OdeSolversMachine<'_> {
    fn system(&self, time: f64, y: &Vector2<f64>, rate: &mut Vector2<f64>) {
        rate[0] = y[1];
        rate[1] = self.acceleration(time, y[0], y[1]);
    }

    fn solout(&mut self, _time: f64, y: &Vector2<f64>, _rate: &Vector2<f64>) -> bool {
        self.note(y[0]);
        false
    }
}

/// Time as a third state: version 0.6.2 evaluates the last stage of its method of order 8 at the start of the
/// step instead of its end, which costs it its order unless time is a state.
impl System<f64, Vector3<f64>> for OdeSolversMachine<'_> {
    fn system(&self, _time: f64, y: &Vector3<f64>, rate: &mut Vector3<f64>) {
        rate[0] = y[1];
        rate[1] = self.acceleration(y[2], y[0], y[1]);
        rate[2] = 1.0;
    }

    fn solout(&mut self, _time: f64, y: &Vector3<f64>, _rate: &Vector3<f64>) -> bool {
        self.note(y[0]);
        false
    }
}

fn machine<'a>(
    request: &'a Request,
    frequency: f64,
    impacts: &'a Cell<u64>,
) -> OdeSolversMachine<'a> {
    OdeSolversMachine {
        request,
        frequency,
        contact: false,
        impacts,
    }
}

macro_rules! method {
    ($name:ident, $stepper:ident, $start:expr, $beta:expr, $least:expr, $most:expr, $about:expr) => {
        #[doc = $about]
        pub fn $name(request: &Request, frequency: f64) -> Result<End, String> {
            let impacts = Cell::new(0);
            let end = request.end(frequency);
            let [position, velocity] = request.scene.start;
            let mut stepper = $stepper::from_param(
                machine(request, frequency, &impacts),
                0.0,
                end,
                end,
                $start(position, velocity),
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
            let y = stepper.y_out().last().ok_or("no states")?;
            Ok((y[0], y[1], impacts.get()))
        }
    };
}

method!(
    dop853,
    Dop853,
    |position, velocity| Vector3::new(position, velocity, 0.0),
    0.0,
    0.333,
    6.0,
    "Dormand and Prince's pair of order 8, its own settings."
);
method!(
    dopri5,
    Dopri5,
    Vector2::new,
    0.04,
    0.2,
    10.0,
    "Dormand and Prince's pair of order 5, its own settings."
);
