//! Where one law becomes another: soft stops that grow rigid, springs that vanish, and the rigid
//! stop's periodic motion in closed form.

mod closed_form;
mod equal;
mod rigid;

use nalgebra::{Matrix2, Vector2};
use softstop::{Clock, Parameter, Ratios, Release, Scene, Start, Stop};
use softstop_dynamics::{Continuation, Orbit, ParameterFamily, orbit};
use softstop_testing::tolerance::ROUNDING;
use softstop_testing::{assert_near, hertz, is_near, kelvin_voigt, preloaded, slope};

const DAMPING: f64 = 0.02;

fn machine(frequency: f64, clearance: f64, contact_damping: f64, stop: Stop) -> Scene {
    let base = Ratios {
        frequency,
        clearance,
        damping: DAMPING,
        ..Ratios::unloaded()
    };
    Scene {
        stop,
        contact_damping,
        ..base.scene().expect("valid")
    }
}

fn end(scene: &Scene, start: Start, periods: f64) -> Vector2<f64> {
    let clock = Clock::new(scene.excitation.frequency, 0.0);
    let until = clock.instant(periods * scene.period());
    let state = scene.trajectory_until(start, until).expect("bounded").end;
    Vector2::new(state.position, state.velocity)
}

/// Errors against the limit, as the stiffness grows by a factor from one to the next, must shrink with
/// the expected power of the stiffness.
fn assert_order(errors: &[f64], factor: f64, power: f64) {
    for pair in errors.windows(2) {
        let observed = (pair[0] / pair[1]).ln() / factor.ln();
        assert!(
            is_near(observed, power, 0.05),
            "order {observed}, expected {power}, errors {errors:?}"
        );
    }
    assert!(errors.last().is_some_and(|last| *last < 1e-2));
}

const START: Start = Start::new(0.0, 3.0);

/// A spring that vanishes leaves the linear oscillator, with an error in proportion to its stiffness.
#[test]
fn soft_stops_vanish() {
    let linear = end(&machine(0.8, 1.5, 0.0, Stop::None), START, 3.0);
    let stops: [fn(f64) -> Stop; 5] = [
        |stiffness| kelvin_voigt(stiffness, Release::Clearance),
        |stiffness| kelvin_voigt(stiffness, Release::ZeroForce),
        |stiffness| preloaded(stiffness, stiffness),
        |stiffness| Stop::PiecewiseLinear {
            loading: vec![slope(0.0, stiffness), slope(0.3, 3.0 * stiffness)],
            unloading: vec![slope(0.0, 0.5 * stiffness)],
        },
        |stiffness| hertz(stiffness, 1.5, 0.3),
    ];
    for stop in stops {
        let errors: Vec<f64> = [1e-3, 1e-5, 1e-7]
            .into_iter()
            .map(|k| (end(&machine(0.8, 1.5, 2.0 * DAMPING, stop(k)), START, 3.0) - linear).norm())
            .collect();
        assert_order(&errors, 1e-2, -1.0);
        let none = machine(0.8, 1.5, 2.0 * DAMPING, stop(0.0));
        assert_near(
            (end(&none, START, 3.0) - linear).norm(),
            0.0,
            10.0 * ROUNDING,
        );
    }
}

/// A power law comes continuously from its neighbours: exponent 1 + e is off the linear spring by O(e).
#[test]
fn exponents_join() {
    let law = |exponent| hertz(30.0, exponent, 0.0);
    let linear = end(&machine(0.8, 1.5, 0.5, law(1.0)), START, 1.0);
    let errors: Vec<f64> = [1e-3, 1e-5, 1e-7]
        .into_iter()
        .map(|e| (end(&machine(0.8, 1.5, 0.5, law(1.0 + e)), START, 1.0) - linear).norm())
        .collect();
    assert_order(&errors, 1e-2, -1.0);
}
