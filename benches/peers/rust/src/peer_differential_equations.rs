//! differential-equations: with terminal events, each followed by a new problem, as its guide to events says;
//! and without, the law changing within steps.

use differential_equations::prelude::*;

use crate::request::{End, Law, Request};

/// Steps after which it gives up; its own 10,000 are too few at small tolerances.
const MOST_STEPS: usize = 10_000_000;

struct Phase {
    law: Law,
    /// When it begins. Time is counted from here, since events are located to 1e-12 of it.
    start: f64,
    frequency: f64,
    clearance: f64,
    direction: CrossingDirection,
}

impl ODE<f64, [f64; 2]> for Phase {
    fn diff(&self, time: f64, y: &[f64; 2], rate: &mut [f64; 2]) {
        let drive = (self.frequency * (self.start + time)).cos();
        rate[0] = y[1];
        rate[1] = self.law.acceleration(drive, y[0], y[1]);
    }
}

impl Event<f64, [f64; 2]> for Phase {
    fn config(&self) -> EventConfig {
        EventConfig::new(self.direction, Some(1))
    }

    fn event(&self, _time: f64, y: &[f64; 2]) -> f64 {
        y[0] - self.clearance
    }
}

fn phase(request: &Request, frequency: f64, start: f64, contact: bool) -> Phase {
    let direction = if contact {
        CrossingDirection::Negative
    } else {
        CrossingDirection::Positive
    };
    Phase {
        law: request.law(contact),
        start,
        frequency,
        clearance: request.scene.clearance,
        direction,
    }
}

/// Dormand and Prince's pair of order 8, with events.
pub fn dop853(request: &Request, frequency: f64) -> Result<End, String> {
    let end = request.end(frequency);
    let (mut time, mut y, mut contact, mut impacts) = (0.0, request.scene.start, false, 0);
    loop {
        let phase = phase(request, frequency, time, contact);
        let method = ExplicitRungeKutta::dop853()
            .rtol(request.tolerance)
            .atol(request.tolerance)
            .max_steps(MOST_STEPS);
        let solution = IVP::ode(&phase, 0.0, end - time, y)
            .event(&phase)
            .method(method)
            .solve()
            .map_err(|error| format!("{error:?}"))?;
        y = *solution.y.last().ok_or("no states")?;
        time += *solution.t.last().ok_or("no times")?;
        if !matches!(solution.status, Status::Interrupted) {
            return Ok((y[0], y[1], impacts));
        }
        contact = !contact;
        impacts += u64::from(contact);
    }
}

struct DifferentialEquationsMachine<'a> {
    request: &'a Request,
    frequency: f64,
}

impl ODE<f64, [f64; 2]> for DifferentialEquationsMachine<'_> {
    fn diff(&self, time: f64, y: &[f64; 2], rate: &mut [f64; 2]) {
        let law = self.request.law(y[0] > self.request.scene.clearance);
        rate[0] = y[1];
        rate[1] = law.acceleration((self.frequency * time).cos(), y[0], y[1]);
    }
}

/// Dormand and Prince's pair of order 8, without events.
pub fn dop853_unlocated(request: &Request, frequency: f64) -> Result<End, String> {
    let machine = DifferentialEquationsMachine { request, frequency };
    let method = ExplicitRungeKutta::dop853()
        .rtol(request.tolerance)
        .atol(request.tolerance)
        .max_steps(MOST_STEPS);
    let solution = IVP::ode(&machine, 0.0, request.end(frequency), request.scene.start)
        .method(method)
        .solve()
        .map_err(|error| format!("{error:?}"))?;
    let beyond = |y: &[f64; 2]| y[0] > request.scene.clearance;
    let steps = solution.y.windows(2);
    let impacts = steps.filter(|step| !beyond(&step[0]) && beyond(&step[1]));
    let impacts = impacts.count() as u64;
    let y = solution.y.last().ok_or("no states")?;
    Ok((y[0], y[1], impacts))
}
