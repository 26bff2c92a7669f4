//! Different words for the same machine.

use super::*;
use softstop_testing::tolerance::{GROWN, MOTION};
use softstop_testing::{assert_near, hertz, is_near, kelvin_voigt, preloaded, rigid_stop};

/// Different words for the same machine move alike, to the last digits.
#[test]
fn equal_laws_move_alike() {
    let spring = preloaded(30.0, 0.0);
    let slope = |from| slope(from, 30.0);
    let same = [
        kelvin_voigt(30.0, Release::Clearance),
        Stop::PiecewiseLinear {
            loading: vec![slope(0.0)],
            unloading: vec![],
        },
        Stop::PiecewiseLinear {
            loading: vec![slope(0.0), slope(0.05), slope(0.11)],
            unloading: vec![slope(0.0), slope(0.07)],
        },
        hertz(30.0, 1.0, 0.0),
    ];
    for clearance in [1.5, 0.0, -0.4] {
        let expected = end(&machine(0.8, clearance, 0.5, spring.clone()), START, 5.0);
        for stop in &same {
            let found = end(&machine(0.8, clearance, 0.5, stop.clone()), START, 5.0);
            assert!(is_near((found - expected).norm(), 0.0, MOTION), "{stop:?}");
        }
        // A rigid stop that is not reached changes nothing.
        let far = Scene {
            rigid: Some(rigid_stop(50.0, 0.3)),
            ..machine(0.8, clearance, 0.5, spring.clone())
        };
        assert_eq!(end(&far, START, 5.0), expected);
    }
}

/// Under heavy damping a nonlinear contact is followed in long steps; with an exponent next to 1 and a
/// faint dissipation it must be where the linear one is.
#[test]
fn slow_contacts_creep_alike() {
    for (stiffness, contact_damping) in [(1e4, 1e4), (1e6, 1e5), (1e8, 3e4)] {
        let law = |exponent, dissipation| hertz(stiffness, exponent, dissipation);
        for clearance in [0.0, -0.5] {
            let linear = machine(0.3, clearance, contact_damping, law(1.0, 0.0));
            let expected = linear.trajectory(START, 2).expect("bounded");
            for (exponent, dissipation) in [(1.0, 1e-9), (1.0 + 1e-10, 0.0)] {
                let scene = machine(0.3, clearance, contact_damping, law(exponent, dissipation));
                let found = scene.trajectory(START, 2).expect("bounded");
                assert!(
                    is_near(found.end.position, expected.end.position, GROWN),
                    "{stiffness:e} {contact_damping:e}"
                );
                assert_near(
                    found.energy_defect(),
                    0.0,
                    MOTION * (1.0 + found.work().dissipated),
                );
                // Not one step for each lifetime of the damped mode.
                assert!(found.arcs.len() < 20_000, "{} arcs", found.arcs.len());
            }
        }
    }
}

/// A wall behind nothing is a wall behind a stop of no stiffness: the contact's damping holds from the
/// clearance on.
#[test]
fn a_wall_behind_nothing_is_one_behind_a_vanishing_stop() {
    let wall = Some(rigid_stop(1.0, 0.5));
    let none = Scene {
        rigid: wall,
        ..machine(1.15, 0.5, 5.0, Stop::None)
    };
    let limp = Scene {
        rigid: wall,
        ..machine(1.15, 0.5, 5.0, preloaded(0.0, 0.0))
    };
    assert_eq!(end(&none, START, 4.0), end(&limp, START, 4.0));
}
