//! Limits of stability in contact lie where theory has them.

use super::*;
use softstop_testing::assert_near;
use softstop_testing::tolerance::ROUNDING;

/// Share of the depth at rest by which the mass starts off its rest: so little that no stage of a step leaves
/// the stop unless the motion grows.
const SWING: f64 = 1e-3;
/// Share of the depth at rest that a motion reaches only if it grows.
const GROWN: f64 = 0.2;

/// A machine that is pressed onto its stop, with a damping of this ratio in contact; its frequency and its depth
/// at rest.
fn pressed(stiffness: f64, ratio: f64) -> (Scene, f64, f64) {
    let frequency = (1.0 + stiffness).sqrt();
    let scene = Scene {
        contact_damping: 2.0 * ratio * frequency,
        ..undriven(-10.0, stiffness)
    };
    (scene, frequency, 10.0 / (1.0 + stiffness))
}

/// Whether so many steps of w h = `z` make the motion grow.
fn grows(scheme: Scheme, stiffness: f64, ratio: f64, z: f64, steps: u32) -> bool {
    let (scene, frequency, depth) = pressed(stiffness, ratio);
    let step = z / frequency;
    let start = scene.clearance + (1.0 - SWING) * depth;
    let task = task(scene, start, 0.0, f64::from(steps) * step);
    match fixed(scheme, Events::Ignored, step).integrate(&task) {
        Ok(found) => {
            let off = found.end.0 - (task.scene.clearance + depth);
            let size = off.hypot(found.end.1 / frequency);
            !found.impacts.is_empty() || size > GROWN * depth
        }
        Err(MethodError::BlownUp { .. }) => true,
        Err(other) => panic!("{other}"),
    }
}

/// The limit found by runs in contact, by bisection.
fn measured(scheme: Scheme, stiffness: f64, ratio: f64, steps: u32) -> f64 {
    let (mut low, mut high) = (1e-3, 4.0);
    assert!(!grows(scheme, stiffness, ratio, low, steps));
    assert!(grows(scheme, stiffness, ratio, high, steps));
    while high - low > 1e-4 * high {
        let middle = f64::midpoint(low, high);
        if grows(scheme, stiffness, ratio, middle, steps) {
            high = middle;
        } else {
            low = middle;
        }
    }
    f64::midpoint(low, high)
}

const DECADES: [f64; 5] = [1.0, 1e2, 1e4, 1e6, 1e8];

/// Holds runs in contact to the limit of theory, and prints a row: docs/methods.md sums them up.
fn check(scheme: Scheme, ratio: f64, steps: u32) {
    let limit = scheme.stability_limit(ratio).expect("there is a limit");
    let mut row = format!("| {} | {ratio} | {limit:.4} |", scheme.name());
    for stiffness in DECADES {
        let found = measured(scheme, stiffness, ratio, steps);
        assert_near(found, limit, 1e-3 * limit);
        row += &format!(" {found:.4} |");
    }
    println!("{row}");
}

#[test]
fn explicit_ones_without_damping() {
    check(Scheme::SemiImplicitEuler, 0.0, 5_000);
    check(Scheme::RungeKutta4, 0.0, 5_000);
    for stiffness in DECADES {
        assert!(grows(Scheme::ExplicitEuler, stiffness, 0.0, 0.02, 50_000));
    }
}

#[test]
fn explicit_ones_with_damping() {
    for ratio in [0.05, 0.3] {
        check(Scheme::SemiImplicitEuler, ratio, 5_000);
        check(Scheme::RungeKutta4, ratio, 5_000);
    }
}

/// Its amplification matrix has the determinant 1 - 2 ratio z + z^2.
#[test]
fn explicit_euler_lives_on_damping_alone() {
    check(Scheme::ExplicitEuler, 0.1, 400_000);
}

#[test]
fn implicit_ones_have_no_limit() {
    for scheme in [Scheme::ImplicitMidpoint, Scheme::NEWMARK] {
        assert_eq!(scheme.stability_limit(0.0), None);
        for stiffness in DECADES {
            assert!(!grows(scheme, stiffness, 0.0, 1e3, 5_000), "{scheme:?}");
        }
    }
}

/// Far beyond the limit the numbers leave all bounds; the exact motion is that of an oscillator about its rest.
#[test]
fn explicit_ones_blow_up_in_contact() {
    let stiffness = 1e8;
    let (scene, frequency, depth) = pressed(stiffness, 0.0);
    let rest = scene.clearance + depth;
    let start = rest - 0.5 * depth;
    let task = task(scene, start, 0.0, 2.0 * TAU);
    let truth = exact(&task);
    let angle = frequency * task.duration();
    // An angle of 1e5 rad is rounded to 1e-11, a position of 10 m to 2e-15 m.
    assert_near(truth.end.0, rest - 0.5 * depth * angle.cos(), ROUNDING);
    assert_near(
        truth.end.1,
        0.5 * depth * frequency * angle.sin(),
        10.0 * ROUNDING,
    );
    assert!(truth.impacts.is_empty());
    for scheme in [
        Scheme::ExplicitEuler,
        Scheme::SemiImplicitEuler,
        Scheme::RungeKutta4,
    ] {
        let method = fixed(scheme, Events::Ignored, TAU / 20.0);
        assert_eq!(verdict(&method, &task), Verdict::BlownUp, "{scheme:?}");
    }
    for scheme in [Scheme::ImplicitMidpoint, Scheme::NEWMARK] {
        let method = fixed(scheme, Events::Ignored, TAU / 20.0);
        assert_eq!(verdict(&method, &task), Verdict::Converged, "{scheme:?}");
    }
}
