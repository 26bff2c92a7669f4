//! What the coupling costs in accuracy: error over the step of the master.

use anyhow::Result;
use rayon::prelude::*;
use serde::Serialize;
use softstop_console::progress::Progress;

use super::coupled::{Coupling, Motor, Point, System};

/// Time in s after which both are judged.
const END: f64 = 12.0;
/// Step of the reference in s, and the largest one of the study, halved from one to the next.
const FINEST: f64 = 0.000_390_625;
const LARGEST: f64 = 0.2;

/// The ways of coupling.
pub(super) const COUPLINGS: [Coupling; 3] =
    [Coupling::Plain, Coupling::Derivatives, Coupling::RollBack];

/// A run.
#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct Error {
    pub coupling: Coupling,
    /// Step in s.
    pub step: f64,
    /// Error of the speed in rad/s.
    pub speed: f64,
    /// Error of the time of the last impact in s.
    pub impact: f64,
}

/// Errors of all couplings with so many steps, the largest one first.
pub(super) fn study(steps: i32, progress: &Progress) -> Result<Vec<Error>> {
    let truth = run(Coupling::RollBack, FINEST)?;
    let runs: Vec<(Coupling, f64)> = COUPLINGS
        .into_iter()
        .flat_map(|coupling| (0..steps).map(move |k| (coupling, LARGEST / f64::from(1 << k))))
        .collect();
    let error = |&(coupling, step): &(Coupling, f64)| {
        progress.step()?;
        let (speed, impact) = run(coupling, step)?;
        Ok(Error {
            coupling,
            step,
            speed: (speed - truth.0).abs(),
            impact: (impact - truth.1).abs(),
        })
    };
    runs.par_iter().map(error).collect()
}

/// The order seen between the second step and the last, by the error of the speed.
pub(super) fn order(errors: &[Error], coupling: Coupling) -> f64 {
    let own: Vec<&Error> = errors.iter().filter(|it| it.coupling == coupling).collect();
    let (first, last) = (own[1], own[own.len() - 1]);
    (first.speed / last.speed).ln() / (first.step / last.step).ln()
}

/// Speed at the end, and time of the last impact.
fn run(coupling: Coupling, step: f64) -> Result<(f64, f64)> {
    let point = Point::b()?;
    let mut system = System::new(point.in_motion(), Some(Motor::SYSTEM), &[], coupling)?;
    system.go_to(END, step)?;
    Ok((system.speed()?, system.press.get("impact.time")?))
}
