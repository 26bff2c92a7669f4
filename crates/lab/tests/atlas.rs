//! What the failures atlas says: limits of stability in contact lie where theory has them, every failure that it
//! names really happens, and the exact method does not share them. What is true is known from closed forms.

mod contacts;
mod energy;
mod stability;

use std::f64::consts::TAU;

use softstop::{Excitation, Release, Scene, Start, Stop};
use softstop_lab::methods::{
    Events, Exact, FixedStep, Integrator, Judge, MethodError, Scheme, Solution, Task, Verdict,
};
use softstop_testing::kelvin_voigt;

/// m = k1 = 1, no damping, no drive, w = 1; a Kelvin-Voigt stop.
fn undriven(clearance: f64, stiffness: f64) -> Scene {
    Scene {
        mass: 1.0,
        stiffness: 1.0,
        damping: 0.0,
        excitation: Excitation {
            amplitude: 0.0,
            frequency: 1.0,
            phase: 0.0,
        },
        clearance,
        contact_damping: 0.0,
        stop: kelvin_voigt(stiffness, Release::Clearance),
        piercing: None,
        rigid: None,
        followers: softstop::Ties::NONE,
        below: None,
    }
}

fn task(scene: Scene, position: f64, velocity: f64, duration: f64) -> Task {
    let (start, periods) = (Start::new(position, velocity), duration / scene.period());
    Task::new(scene, start, periods, 10_000_000)
}

fn fixed(scheme: Scheme, events: Events, step: f64) -> FixedStep {
    FixedStep::new(scheme, step, events)
}

fn exact(task: &Task) -> Solution {
    Exact.integrate(task).expect("the exact method goes on")
}

/// The verdict on a method by the exact one, which the caller has checked.
fn verdict(method: &impl Integrator, task: &Task) -> Verdict {
    let truth = exact(task);
    Judge::new(task, &truth, 0.01).verdict(&method.integrate(task))
}
