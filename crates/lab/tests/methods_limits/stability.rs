//! Limits of stability, and gain and loss of energy.

use super::*;
use softstop_testing::tolerance::SOLVED;

fn energy(found: &Solution) -> f64 {
    0.5 * (found.end.0.powi(2) + found.end.1.powi(2))
}

fn grows(scene: &Scene, scheme: Scheme, step: f64) -> bool {
    match steps(scene, scheme, step, 200_000) {
        Ok(found) => energy(&found) > 1e4,
        Err(MethodError::BlownUp { .. }) => true,
        Err(other) => panic!("{other}"),
    }
}

/// The step at which a free motion begins to grow, by running, lies where theory has it.
#[test]
fn measured_limits_are_those_of_theory() {
    let linear_acceleration = Scheme::Newmark {
        beta: 1.0 / 6.0,
        gamma: 0.5,
    };
    for scheme in Scheme::ALL.into_iter().chain([linear_acceleration]) {
        for zeta in [0.0, 0.05, 0.4] {
            let scene = free(zeta);
            match scheme.stability_limit(zeta) {
                Some(0.0) => assert!(grows(&scene, scheme, 0.02), "{scheme:?} {zeta}"),
                Some(limit) => {
                    assert!(!grows(&scene, scheme, 0.99 * limit), "{scheme:?} {zeta}");
                    assert!(grows(&scene, scheme, 1.01 * limit), "{scheme:?} {zeta}");
                }
                None => assert!(!grows(&scene, scheme, 1e3), "{scheme:?} {zeta}"),
            }
        }
    }
}

#[test]
fn energies_of_the_free_oscillator() {
    let scene = free(0.0);
    let run = |scheme, step: f64, count| energy(&steps(&scene, scheme, step, count).expect("ok"));
    // Explicit Euler multiplies the energy by 1 + h^2 in every step.
    let gained = run(Scheme::ExplicitEuler, 0.01, 10_000);
    let expected = 0.5 * (1.0f64 + 1e-4).powi(10_000);
    assert!(is_near(gained / expected, 1.0, SOLVED), "{gained}");
    // The semi-implicit one keeps x^2 + v^2 - h x v.
    for count in [10_001, 50_000, 99_999] {
        let kept = run(Scheme::SemiImplicitEuler, 0.2, count);
        assert!(is_near(kept, 0.5, 0.06), "{kept}");
    }
    // Implicit midpoint and average acceleration keep quadratic energies at any step.
    for scheme in [
        Scheme::ImplicitMidpoint,
        Scheme::NEWMARK,
        Scheme::GeneralisedAlpha { rho_inf: 1.0 },
    ] {
        for step in [0.1, 1.0, 30.0] {
            let kept = run(scheme, step, 10_000);
            assert!(is_near(kept, 0.5, SOLVED), "{scheme:?} {step}: {kept}");
        }
    }
    // Generalised-alpha with numerical damping, and RK4 below its limit, lose some.
    for scheme in [
        Scheme::GeneralisedAlpha { rho_inf: 0.5 },
        Scheme::RungeKutta4,
    ] {
        let left = run(scheme, 0.5, 10_000);
        assert!(left < 0.25, "{scheme:?}: {left}");
    }
}
