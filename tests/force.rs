//! What holds for every polynomial force: it does not matter how it is written, set anew or how the run is
//! divided; energies balance; the order of interpolation is the one to be expected; nothing hangs.

use proptest::prelude::*;
use softstop::flow::{HIGHEST_ORDER, Polynomial};
use softstop::{Excitation, MotionError, PhaseKind, Ratios, Scene, Simulation, Start, Stop};
use softstop_testing::{cases, machines, start_below};

const SEVENTH: [f64; 8] = [0.2, -0.1, 0.15, -0.02, -0.03, 0.02, -0.006, 0.0008];

/// A machine whose force is set at the start.
fn pushed(scene: &Scene, start: Start, force: &[f64]) -> Simulation {
    let mut machine = Simulation::new(scene, start).expect("valid");
    machine.set_force(force).expect("finite");
    machine
}

/// A lone mass before a stop: neither spring nor damper nor drive.
fn bare(stop: Stop) -> Scene {
    Scene {
        stiffness: 0.0,
        damping: 0.0,
        contact_damping: 0.0,
        clearance: 1.0,
        excitation: Excitation {
            amplitude: 0.0,
            frequency: 1e-3,
            phase: 0.0,
        },
        piercing: None,
        rigid: None,
        stop,
        ..Ratios::unloaded().scene().expect("valid")
    }
}

const AT_REST: Start = Start {
    position: 0.0,
    velocity: 0.0,
};

fn factorial(n: usize) -> f64 {
    (1..=n).map(|k| k as f64).product()
}

fn close(a: f64, b: f64, allowed: f64) -> bool {
    (a - b).abs() <= allowed * (1.0 + a.abs().max(b.abs()))
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
        assert!(close(found.position, expected, 1e-15), "order {order}");
        let speed = power * 0.9f64.powf(power - 1.0) / impact;
        assert!(close(found.velocity, speed, 1e-15), "order {order}");
        machine.advance(1.01 * impact).expect("bounded");
        let found = machine.last_impact().expect("an impact");
        assert!(close(found.time, impact, 4e-16), "order {order}");
        assert!(
            close(found.velocity, power / impact, 4e-15),
            "order {order}"
        );
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
        assert!(close(sample.acceleration, now.value(), 1e-14));
        assert!(close(sample.jerk, now.rate(), 1e-14));
    }
}

#[test]
fn a_polynomial_that_is_a_ramp_is_the_ramp() {
    for ratios in [Ratios::unloaded(), Ratios::loaded()] {
        let scene = ratios.scene().expect("valid");
        let start = Start {
            position: 3.0,
            velocity: 11.0,
        };
        let ramp = [0.3, 0.02];
        let mut closed = pushed(&scene, start, &ramp);
        let mut stepped = pushed(&scene, start, &[0.3, 0.02, 0.0, 0.0, 0.0, 0.0, 0.0, 1e-290]);
        for period in 1..=10 {
            let time = f64::from(period) * scene.period();
            closed.advance(time).expect("bounded");
            stepped.advance(time).expect("bounded");
            let (a, b) = (closed.sample(), stepped.sample());
            assert!(
                close(a.position, b.position, 1e-11),
                "{period}: {a:?} {b:?}"
            );
            assert!(
                close(a.velocity, b.velocity, 1e-11),
                "{period}: {a:?} {b:?}"
            );
            assert_eq!(closed.impact_count(), stepped.impact_count());
        }
        assert!(closed.impact_count() > 5);
    }
}

#[test]
fn the_division_of_a_run_does_not_matter() {
    let hertz = Stop::Hertz {
        stiffness: 50.0,
        exponent: 1.5,
        dissipation: 0.1,
    };
    for stop in [hertz, Stop::Rigid { restitution: 0.6 }] {
        let scene = Scene {
            stop,
            clearance: 1.0,
            ..Ratios::loaded().scene().expect("valid")
        };
        let start = Start {
            position: -1.0,
            velocity: 2.0,
        };
        let mut whole = pushed(&scene, start, &SEVENTH);
        let mut divided = whole.clone();
        whole.advance(12.0).expect("bounded");
        let mut share = 0.0;
        for step in 1..=1000u32 {
            share += f64::from(step * 7919 % 1000 + 1) / 500_500.0;
            divided
                .advance(12.0 * f64::min(share, 1.0))
                .expect("bounded");
            let _ = (divided.sample(), divided.energy());
        }
        divided.advance(12.0).expect("bounded");
        assert!(whole.impact_count() > 1);
        assert_eq!(whole.sample(), divided.sample(), "bit for bit");
        assert_eq!(whole.last_impact(), divided.last_impact());
        assert_eq!(whole.energy(), divided.energy());
    }
}

#[test]
fn setting_what_holds_anyway_changes_nothing() {
    let scene = Ratios::loaded().scene().expect("valid");
    let start = Start {
        position: 3.0,
        velocity: 11.0,
    };
    let force = Polynomial::new(SEVENTH);
    let mut once = pushed(&scene, start, &SEVENTH);
    let mut again = once.clone();
    for step in 1..=500 {
        let time = 0.017 * f64::from(step);
        again.advance(time).expect("bounded");
        again
            .set_force(force.shifted(time).derivatives())
            .expect("finite");
    }
    once.advance(8.5).expect("bounded");
    again.advance(8.5).expect("bounded");
    let (a, b) = (once.sample(), again.sample());
    assert!(once.impact_count() > 0);
    assert!(close(a.position, b.position, 1e-12), "{a:?} {b:?}");
    assert!(close(a.velocity, b.velocity, 1e-12), "{a:?} {b:?}");
}

/// Half of a drive handed over as an external force, by cubics that fit its value and three
/// derivatives at the start of each step: off by h^4 / 24.
#[test]
fn a_sine_fitted_by_cubics_is_of_the_fourth_order() {
    let whole = Ratios::unloaded().scene().expect("valid");
    let mut half = whole.clone();
    half.excitation.amplitude = 0.5;
    let start = Start {
        position: 0.0,
        velocity: 14.0,
    };
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
        assert!(
            (order - 4.0).abs() < 0.2,
            "order {order}, errors {errors:?}"
        );
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
    assert!((machine.sample().position - expected).abs() < 1e-13 * expected.abs());
}

#[test]
fn a_derivative_that_cannot_be_taken_is_named() {
    let mut machine = Simulation::new(&bare(Stop::None), AT_REST).expect("valid");
    machine.set_force(&[1.0, 2.0, 3.0]).expect("finite");
    let before = machine.clone();
    for order in 0..10 {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut force = vec![0.5; order.min(HIGHEST_ORDER + 1)];
            force.resize(order, 0.0);
            force.push(value);
            let error = machine.set_force(&force).expect_err("not finite");
            assert!(matches!(error, MotionError::ForceNotFinite { order: o, .. } if o == order));
            assert!(error.to_string().contains(&format!("order {order}")));
        }
    }
    let error = machine.set_force(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 4.0]);
    let text = error.expect_err("order 9").to_string();
    assert_eq!(
        text,
        "force: derivative of order 9 = 4: must be 0 beyond order 7"
    );
    machine.advance(1.0).expect("bounded");
    let mut untouched = before;
    untouched.advance(1.0).expect("bounded");
    assert_eq!(machine.sample(), untouched.sample());
    machine.set_force(&[0.0; 12]).expect("zeros of any order");
}

#[test]
fn huge_and_tiny_forces_neither_hang_nor_panic() {
    let stops = [
        (Stop::None, 20.0),
        (Stop::Rigid { restitution: 0.6 }, 20.0),
        (
            Stop::Preloaded {
                stiffness: 7.0,
                preload: 70.0,
            },
            20.0,
        ),
        // A contact that deep takes many thousand steps in each second.
        (
            Stop::Hertz {
                stiffness: 50.0,
                exponent: 1.5,
                dissipation: 0.1,
            },
            0.05,
        ),
    ];
    for (stop, end) in stops {
        let loaded = Scene {
            stop: stop.clone(),
            ..Ratios::loaded().scene().expect("valid")
        };
        for scene in [bare(stop), loaded] {
            for size in [1e12, 1e300, 1e-300, f64::MAX, f64::MIN_POSITIVE] {
                for size in [size, -size] {
                    for order in 0..=HIGHEST_ORDER {
                        advance_or_fail(&scene, &Polynomial::default().with(order, size), end);
                    }
                    advance_or_fail(&scene, &Polynomial::new([size; 8]), end);
                }
            }
        }
    }
}

/// A motion that arrives, finite, or that says why it does not.
fn advance_or_fail(scene: &Scene, force: &Polynomial, end: f64) {
    let mut machine = pushed(scene, AT_REST, force.derivatives());
    match machine.advance(end) {
        Ok(()) => {
            let sample = machine.sample();
            assert!(sample.position.is_finite() && sample.velocity.is_finite());
        }
        Err(error) => assert!(
            matches!(
                error,
                MotionError::Unbounded { .. } | MotionError::Stalled { .. }
            ),
            "{error}"
        ),
    }
}

/// A mass leaning on the preload holds until the force passes its balance, whichever order lets it go.
#[test]
fn a_held_mass_is_let_go_when_its_balance_is_reached() {
    for order in 1..=HIGHEST_ORDER {
        let stop = Stop::Preloaded {
            stiffness: 7.0,
            preload: 3.0,
        };
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

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn energies_balance_and_division_does_not_matter(
        scene in machines(),
        depth in 0.0..3.0f64,
        velocity in -3.0..6.0f64,
        force in prop::array::uniform8(-1.0..1.0f64),
        degree in 2..8usize,
    ) {
        let mut force = force;
        for (order, derivative) in force.iter_mut().enumerate() {
            *derivative = if order > degree { 0.0 } else { *derivative };
        }
        let start = start_below(&scene, depth, velocity);
        let mut machine = Simulation::new(&scene, start).expect("valid");
        let before = machine.energy().mechanical;
        machine.set_force(&force).expect("finite");
        let mut whole = machine.clone();
        for step in 1..=40 {
            machine.advance(0.1 * f64::from(step)).expect("bounded");
        }
        whole.advance(4.0).expect("bounded");
        prop_assert_eq!(whole.sample(), machine.sample());
        let energy = machine.energy();
        let defect = energy.supplied - energy.dissipated - (energy.mechanical - before);
        let turnover = energy.supplied.abs() + energy.dissipated + energy.mechanical.abs();
        prop_assert!(defect.abs() < 1e-11 * turnover.max(1.0), "{:e} of {:e}", defect, turnover);
    }
}
