//! Forces that cannot be, or that are too much.

use super::*;
use softstop_testing::{hertz, preloaded};

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
        (preloaded(7.0, 70.0), 20.0),
        // A contact that deep takes many thousand steps in each second.
        (hertz(50.0, 1.5, 0.1), 0.05),
    ];
    for (stop, end) in stops {
        let loaded = Scene {
            stop: stop.clone(),
            ..loaded()
        };
        for scene in [bare(stop), loaded] {
            for size in [1e12, 1e300, 1e-300, f64::MAX, f64::MIN_POSITIVE] {
                for size in [size, -size] {
                    for order in 0..=HIGHEST_ORDER {
                        advance_or_fail(
                            &scene,
                            &Polynomial::default().with_derivative(order, size),
                            end,
                        );
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
