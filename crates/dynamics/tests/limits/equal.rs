//! Different words for the same machine.

use super::*;
use approx::{abs_diff_eq, assert_abs_diff_eq};
use softstop_testing::tolerance::{GROWN, MOTION};

/// Different words for the same machine move alike, to the last digits.
#[test]
fn equal_laws_move_alike() {
    let spring = Stop::Preloaded {
        stiffness: 30.0,
        preload: 0.0,
    };
    let slope = |from| Slope {
        from,
        stiffness: 30.0,
    };
    let same = [
        Stop::KelvinVoigt {
            stiffness: 30.0,
            release: Release::Clearance,
        },
        Stop::PiecewiseLinear {
            loading: vec![slope(0.0)],
            unloading: vec![],
        },
        Stop::PiecewiseLinear {
            loading: vec![slope(0.0), slope(0.05), slope(0.11)],
            unloading: vec![slope(0.0), slope(0.07)],
        },
        Stop::Hertz {
            stiffness: 30.0,
            exponent: 1.0,
            dissipation: 0.0,
        },
    ];
    for clearance in [1.5, 0.0, -0.4] {
        let expected = end(&machine(0.8, clearance, 0.5, spring.clone()), START, 5.0);
        for stop in &same {
            let found = end(&machine(0.8, clearance, 0.5, stop.clone()), START, 5.0);
            assert!(
                abs_diff_eq!((found - expected).norm(), 0.0, epsilon = MOTION),
                "{stop:?}"
            );
        }
        // A rigid stop that is not reached changes nothing.
        let far = Scene {
            rigid: Some(RigidStop {
                travel: 50.0,
                restitution: 0.3,
            }),
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
        let law = |exponent, dissipation| Stop::Hertz {
            stiffness,
            exponent,
            dissipation,
        };
        for clearance in [0.0, -0.5] {
            let linear = machine(0.3, clearance, contact_damping, law(1.0, 0.0));
            let expected = linear.trajectory(START, 2).expect("bounded");
            for (exponent, dissipation) in [(1.0, 1e-9), (1.0 + 1e-10, 0.0)] {
                let scene = machine(0.3, clearance, contact_damping, law(exponent, dissipation));
                let found = scene.trajectory(START, 2).expect("bounded");
                assert!(
                    abs_diff_eq!(found.end.position, expected.end.position, epsilon = GROWN),
                    "{stiffness:e} {contact_damping:e}"
                );
                assert_abs_diff_eq!(
                    found.energy_defect(),
                    0.0,
                    epsilon = MOTION * (1.0 + found.work.dissipated)
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
    let wall = Some(RigidStop {
        travel: 1.0,
        restitution: 0.5,
    });
    let none = Scene {
        rigid: wall,
        ..machine(1.15, 0.5, 5.0, Stop::None)
    };
    let limp = Scene {
        rigid: wall,
        ..machine(
            1.15,
            0.5,
            5.0,
            Stop::Preloaded {
                stiffness: 0.0,
                preload: 0.0,
            },
        )
    };
    assert_eq!(end(&none, START, 4.0), end(&limp, START, 4.0));
}
