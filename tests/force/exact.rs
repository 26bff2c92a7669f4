//! Forces whose motion has a closed form, or an order of its error.

use super::*;
use approx::assert_relative_eq;
use softstop::Start;
use softstop_testing::tolerance::ROUNDING;
use softstop_testing::{assert_near, is_near, preloaded};

fn factorial(n: usize) -> f64 {
    (1..=n).map(|k| k as f64).product()
}

#[test]
fn a_lone_mass_follows_each_order_in_closed_form() {
    for order in 0..=HIGHEST_ORDER {
        let mut force = [0.0; HIGHEST_ORDER + 1];
        force[order] = 2.0;
        let mut machine = pushed(&bare(Stop::Rigid { restitution: 0.5 }), AT_REST, &force);
        // 2 t^(n + 2) / (n + 2)! = 1 at the stop.
        let power = (order + 2) as f64;
        let impact = (factorial(order + 2) / 2.0).powf(1.0 / power);
        machine.advance(0.9 * impact).expect("bounded");
        let expected = 0.9f64.powf(power);
        let found = machine.sample();
        assert_near(found.position, expected, 1e-15 * (1.0 + expected));
        let speed = power * 0.9f64.powf(power - 1.0) / impact;
        assert_near(found.velocity, speed, 1e-15 * (1.0 + speed));
        machine.advance(1.01 * impact).expect("bounded");
        let found = machine.last_impact().expect("an impact");
        assert_near(found.time, impact, 4e-16 * (1.0 + impact));
        let speed = power / impact;
        assert_near(found.velocity, speed, 4e-15 * (1.0 + speed));
    }
}

#[test]
fn acceleration_and_jerk_follow_the_force() {
    let mut machine = pushed(&bare(Stop::None), AT_REST, &SEVENTH);
    let force = Polynomial::new(SEVENTH);
    for step in 1..=40 {
        let time = 0.17 * f64::from(step);
        machine.advance(time).expect("bounded");
        let (sample, now) = (machine.sample(), force.shifted(time));
        assert_relative_eq!(
            sample.acceleration,
            now.value(),
            epsilon = ROUNDING,
            max_relative = ROUNDING
        );
        assert_relative_eq!(
            sample.jerk,
            now.rate(),
            epsilon = ROUNDING,
            max_relative = ROUNDING
        );
    }
}

/// Half of a drive handed over as an external force, by cubics that fit its value and three
/// derivatives at the start of each step: off by h^4 / 24.
#[test]
fn a_sine_fitted_by_cubics_is_of_the_fourth_order() {
    let whole = Ratios::unloaded().scene().expect("valid");
    let mut half = whole.clone();
    half.excitation.amplitude = 0.5;
    let start = Start::new(0.0, 14.0);
    let (w, end) = (whole.excitation.frequency, 2.0 * whole.period());
    let mut exact = Simulation::new(&whole, start).expect("valid");
    exact.advance(end).expect("bounded");
    assert!(exact.impact_count() > 0);
    let error = |steps: u32| {
        let mut machine = Simulation::new(&half, start).expect("valid");
        for step in 1..=steps {
            let (sin, cos) = (w * machine.time()).sin_cos();
            let cubic = [
                0.5 * cos,
                -0.5 * w * sin,
                -0.5 * w * w * cos,
                0.5 * w * w * w * sin,
            ];
            machine.set_force(&cubic).expect("finite");
            let time = end * f64::from(step) / f64::from(steps);
            machine.advance(time).expect("bounded");
        }
        (machine.sample().position - exact.sample().position).abs()
    };
    let errors = [256, 512, 1024].map(error);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(is_near(order, 4.0, 0.2), "order {order}, errors {errors:?}");
    }
}

#[test]
fn a_long_run_keeps_the_force_where_it_was_set() {
    // (t - 50)^2 / 50 - 20, which ends at -20 after a way of thousands of steps.
    let (mut scene, force) = (bare(Stop::None), [30.0, -2.0, 0.04]);
    (scene.stiffness, scene.damping, scene.excitation.frequency) = (4e4, 40.0, 3.0);
    let mut machine = pushed(&scene, AT_REST, &force);
    machine.advance(50.0).expect("bounded");
    // b x = f - c f' / k + (c^2 / k^2 - m / k) f'', the polynomial answer, m = 1.
    let (k, c) = (scene.stiffness, scene.damping);
    let expected = (-20.0 + (c * c / k / k - scene.mass / k) * 0.04) / k;
    assert_near(
        machine.sample().position,
        expected,
        10.0 * ROUNDING * expected.abs(),
    );
}

/// A mass leaning on the preload holds until the force passes its balance, whichever order lets it go.
#[test]
fn a_held_mass_is_let_go_when_its_balance_is_reached() {
    for order in 1..=HIGHEST_ORDER {
        let stop = preloaded(7.0, 3.0);
        let scene = Scene {
            clearance: 0.0,
            ..bare(stop)
        };
        // 1 + t^n: at 3, the preload, after 2^(1/n) s.
        let mut force = [0.0; HIGHEST_ORDER + 1];
        (force[0], force[order]) = (1.0, factorial(order));
        let mut machine = pushed(&scene, AT_REST, &force);
        let release = 2f64.powf(1.0 / order as f64);
        machine.advance(release - 1e-9).expect("bounded");
        assert_eq!(machine.sample().phase, PhaseKind::Resting, "order {order}");
        machine.advance(release + 1e-9).expect("bounded");
        assert_eq!(machine.sample().phase, PhaseKind::Stop, "order {order}");
    }
}
