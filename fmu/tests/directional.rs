//! Directional derivatives against differences, through the C functions.

use crate::common::{OK, OUTPUTS, Unit};
use softstop_testing::assert_near;
use softstop_testing::tolerance::SOLVED;

fn outputs(unit: &Unit) -> [f64; 9] {
    OUTPUTS.map(|name| unit.get(name))
}

/// Central difference of `run` about 0.
fn difference(run: impl Fn(f64) -> [f64; 9], width: f64) -> [f64; 9] {
    let (high, low) = (run(width), run(-width));
    std::array::from_fn(|n| (high[n] - low[n]) / (2.0 * width))
}

fn assert_close(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    for (n, name) in OUTPUTS.iter().enumerate() {
        let (found, expected) = (found[n], expected[n]);
        let off = (found - expected).abs();
        assert!(
            off < tolerance * (1.0 + expected.abs()),
            "{what}: {name} {found} {expected}"
        );
    }
}

/// Steps of 3 s through flight, strip, stop and back: the force of the last one.
#[test]
fn force_across_the_impacts_of_the_last_step() {
    for model in [2.0, 3.0, 4.0, 5.0, 6.0] {
        let run = |steps: u32, change: f64| {
            let unit = Unit::new();
            assert_eq!(unit.set("stop.model", model), OK);
            unit.begin();
            for number in 0..steps {
                let last = number + 1 == steps;
                assert_eq!(unit.set("force", if last { 0.2 + change } else { 0.2 }), OK);
                assert_eq!(unit.step(3.0 * f64::from(number), 3.0), OK);
            }
            unit
        };
        for steps in 1..=8 {
            let found = run(steps, 0.0)
                .derivatives(&OUTPUTS, &[("force", 1.0)])
                .expect("available");
            let expected = difference(|change| outputs(&run(steps, change)), 1e-5);
            assert_close(&found, &expected, 1e-5, &format!("{model} {steps}"));
        }
    }
}

/// Right after the force was set, only what it feeds through at once is left.
#[test]
fn feedthrough_after_setting_the_force() {
    let unit = Unit::new();
    assert_eq!(unit.set("mass", 2.0), OK);
    unit.begin();
    assert_eq!(unit.step(0.0, 7.0), OK);
    let across = unit
        .derivatives(&["position"], &[("force", 1.0)])
        .expect("available");
    assert!(across[0].abs() > 0.1);
    let same = unit.get("force");
    assert_eq!(unit.set("force", same), OK);
    let found = unit
        .derivatives(&["position", "velocity", "acceleration"], &[("force", 3.0)])
        .expect("available");
    assert_eq!(found, [0.0, 0.0, 1.5]);
}

/// In initialisation outputs are functions of all parameters.
#[test]
fn parameters_in_initialisation() {
    let unit = Unit::new();
    let begin = |unit: &Unit| {
        // Beyond the stop, where every parameter counts.
        unit.set_all(&[("initial.position", 11.3), ("initial.velocity", 2.0)]);
        unit.enter(0.0);
    };
    begin(&unit);
    let mut felt = 0;
    for name in [
        "mass",
        "stiffness",
        "damping",
        "excitation.amplitude",
        "excitation.phase",
        "excitation.frequency",
        "clearance",
        "contact.damping",
        "stop.stiffness",
        "stop.preload",
        "piercing.thickness",
        "piercing.travel",
        "initial.position",
        "initial.velocity",
        "force",
    ] {
        let found = unit
            .derivatives(&OUTPUTS, &[(name, 2.0)])
            .expect("available");
        let value = unit.get(name);
        let moved = |change: f64| {
            let unit = Unit::new();
            begin(&unit);
            assert_eq!(unit.set(name, value + 2.0 * change), OK);
            outputs(&unit)
        };
        let signed = ["excitation.phase", "force"].contains(&name);
        let low = if value == 0.0 && !signed { 0.0 } else { -1e-6 };
        let (high, low, width) = (moved(1e-6), moved(low), 1e-6 - low);
        let expected: Vec<_> = (0..9).map(|n| (high[n] - low[n]) / width).collect();
        assert_close(&found, &expected, 1e-6, name);
        felt += u32::from(found.iter().any(|derivative| *derivative != 0.0));
    }
    // At drive angle 0 neither frequency nor phase counts.
    assert_eq!(felt, 13);
    // k (x - r - s - v) - k x + ... is linear in the preload.
    let found = unit.derivatives(&["contact.force"], &[("stop.preload", 1.0)]);
    assert_near(found.expect("available")[0], 1.0, SOLVED);
}

/// At the end of its range a parameter can be changed to one side only.
#[test]
fn parameters_at_the_end_of_their_range() {
    let begin = |thickness: f64| {
        let unit = Unit::new();
        unit.set_all(&[
            ("stop.model", 2.0),
            ("piercing.thickness", thickness),
            ("piercing.travel", 0.0),
            ("piercing.friction", 0.0),
            ("piercing.stiffness", 0.0),
            ("clearance", 1.0),
            ("initial.position", 1.2),
            ("initial.velocity", 3.0),
        ]);
        unit.enter(0.0);
        unit
    };
    let found = begin(0.0)
        .derivatives(&OUTPUTS, &[("piercing.thickness", 1.0)])
        .expect("available");
    let (here, there) = (outputs(&begin(0.0)), outputs(&begin(1e-6)));
    let expected: Vec<_> = (0..9).map(|n| (there[n] - here[n]) / 1e-6).collect();
    assert_close(&found, &expected, 1e-5, "thickness");
    // Pressed with k4 (x - r - s), k4 = 7.
    assert_near(found[3], -7.0, 1e-9);
}
