//! Directional derivatives against differences, through the C functions.

use crate::common::{OK, OUTPUTS, Unit};
use softstop_testing::assert_near;
use softstop_testing::tolerance::SOLVED;

/// Outputs of drive and frame, and what a step tells of its contacts.
pub const FURTHER: [&str; 11] = [
    "drive.angle",
    "drive.force",
    "drive.power",
    "drive.work",
    "frame.force",
    "contact.peak",
    "contact.impulse",
    "impact.step.first.time",
    "impact.step.first.velocity",
    "impact.step.hardest.time",
    "impact.step.hardest.velocity",
];

fn outputs<const N: usize>(unit: &Unit, names: [&str; N]) -> [f64; N] {
    names.map(|name| unit.get(name))
}

/// Central difference of `run` about 0.
fn difference<const N: usize>(run: impl Fn(f64) -> [f64; N], width: f64) -> [f64; N] {
    let (high, low) = (run(width), run(-width));
    std::array::from_fn(|n| (high[n] - low[n]) / (2.0 * width))
}

fn assert_close(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len());
    for (n, (found, expected)) in found.iter().zip(expected).enumerate() {
        let off = (found - expected).abs();
        assert!(
            off < tolerance * (1.0 + expected.abs()),
            "{what}: {n} {found} {expected}"
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
            let expected = difference(|change| outputs(&run(steps, change), OUTPUTS), 1e-5);
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
            outputs(&unit, OUTPUTS)
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
    let (here, there) = ([0.0, 1e-6].map(begin))
        .map(|unit| outputs(&unit, OUTPUTS))
        .into();
    let expected: Vec<_> = (0..9).map(|n| (there[n] - here[n]) / 1e-6).collect();
    assert_close(&found, &expected, 1e-5, "thickness");
    // Pressed with k4 (x - r - s), k4 = 7.
    assert_near(found[3], -7.0, 1e-9);
}

/// At the start and over a first step, under a constant drive, one that its inputs lead and along a ramp of it.
#[test]
fn drive_frame_and_contacts() {
    let names = [&FURTHER[..], &OUTPUTS].concat();
    let names: [&str; 20] = names.try_into().expect("twenty names");
    let led_by = [
        (0.0, 0.0, 0.0),
        (1.0, 0.0, 0.05),
        (1.0, 1.0, 0.0),
        (1.0, 1.0, 0.05),
    ];
    for (model, (speed, amplitude, ramp), time) in [2.0, 3.0, 4.0, 5.0, 6.0]
        .into_iter()
        .flat_map(|model| led_by.map(|led| (model, led)))
        .flat_map(|(model, led)| [0.0, 0.4, 9.0].map(|time| (model, led, time)))
    {
        let run = |name: &str, change: f64| {
            let unit = Unit::new();
            let moved = |of: &str, value: f64| value + if of == name { change } else { 0.0 };
            let set = |of, value| assert_eq!(unit.set(of, moved(of, value)), OK, "{of}");
            unit.set_all(&[
                ("stop.model", model),
                ("excitation.phase", 0.7),
                ("drive.takes.speed", speed),
                ("drive.takes.amplitude", amplitude),
            ]);
            set("initial.position", 5.0);
            set("initial.velocity", 11.0);
            if time > 0.0 {
                unit.begin();
            } else {
                unit.enter(0.0);
            }
            set("force", 0.4);
            set("base.acceleration", 0.3);
            set("drive.speed", 1.15);
            set("drive.amplitude", 1.0);
            assert_eq!(unit.slope("force", 1, 0.4 * ramp), OK);
            assert_eq!(unit.slope("drive.speed", 1, ramp), OK);
            if time > 0.0 {
                assert_eq!(unit.step(0.0, time), OK);
                assert!(time < 1.0 || unit.get("impact.step.count") > 0.0, "{model}");
            }
            unit
        };
        for (name, seed) in [
            ("initial.position", 0.5),
            ("initial.velocity", -1.0),
            ("force", 1.0),
            ("base.acceleration", 0.5),
            ("drive.speed", -0.25),
            ("drive.amplitude", 1.5),
        ] {
            let found = run("", 0.0).derivatives(&names, &[(name, seed)]);
            let expected = difference(|change| outputs(&run(name, seed * change), names), 1e-6);
            let found = found.expect("available");
            let what = format!("{model} {speed} {amplitude} {ramp} {time} {name}");
            assert_close(&found, &expected, 2e-6, &what);
        }
    }
}

/// Two preloaded stops, where a start slower by a ten-thousandth makes another impact the hardest, and the end of a step
/// just after the mass has reached the stop.
#[test]
fn beside_another_hardest_impact_and_another_phase() {
    const STOPS: &[(&str, f64)] = &[
        ("stop.stiffness", 48.0),
        ("stop.preload", 32.0),
        ("stop.below.model", 5.0),
        ("stop.below.stiffness", 28.0),
        ("stop.below.preload", 26.0),
        ("stop.below.clearance", 0.5),
        ("clearance", 1.0),
        ("piercing.thickness", 0.0),
        ("piercing.travel", 0.0),
        ("rigid.present", 0.0),
        ("initial.position", 0.0),
        ("initial.velocity", 1.357_521),
    ];
    const STRIP: &[(&str, f64)] = &[("initial.position", 5.0), ("initial.velocity", 14.0)];
    for (values, inputs, time) in [(STOPS, [0.0, 0.0], 6.0), (STRIP, [0.4, 0.3], 0.476_66)] {
        let run = |change: f64| {
            let unit = Unit::new();
            unit.set_all(values);
            unit.begin();
            unit.set_all(&[
                ("force", inputs[0] + change),
                ("base.acceleration", inputs[1]),
            ]);
            assert_eq!(unit.step(0.0, time), OK);
            unit
        };
        let found = run(0.0).derivatives(&FURTHER, &[("force", 1.0)]);
        let expected = difference(|change| outputs(&run(change), FURTHER), 1e-6);
        assert_close(&found.expect("available"), &expected, 2e-6, "force");
    }
}

/// With an unloading chain the energy that is stored bends at its knees, one of which is 0.001 away.
#[test]
fn stored_energy_beside_a_knee() {
    let unit = |position: f64| {
        let unit = Unit::new();
        unit.set_all(&[
            ("stop.model", 3.0),
            ("stop.loading.stiffness[1]", 25.0),
            ("stop.unloading.count", 2.0),
            ("stop.unloading.stiffness[1]", 6.0),
            ("stop.unloading.from[2]", 0.3),
            ("stop.unloading.stiffness[2]", 25.0),
            ("piercing.thickness", 0.0),
            ("piercing.travel", 0.0),
            ("clearance", 1.0),
            ("initial.position", position),
            ("initial.velocity", 2.0),
        ]);
        unit.enter(0.0);
        unit
    };
    let energy = ["energy.mechanical"];
    for position in [1.299, 1.301] {
        let by = |name| unit(position).derivatives(&energy, &[(name, 1.0)]);
        let expected = difference(|change| outputs(&unit(position + change), energy), 1e-6);
        let found = by("initial.position").expect("available");
        assert_close(&found, &expected, 1e-6, "position");
        // The stop's share has the opposite sign, the suspension's is k1 x.
        let found = by("clearance").expect("available");
        assert_close(&found, &[position - expected[0]], 1e-6, "clearance");
    }
}

/// After a step with impacts, once an input has been set: the amplitude feeds through to the acceleration alone.
#[test]
fn feedthrough_of_the_amplitude_after_impacts() {
    for speed in [0.0, 1.0] {
        let unit = Unit::new();
        unit.set_all(&[
            ("mass", 2.0),
            ("drive.takes.amplitude", 1.0),
            ("drive.amplitude", 1.0),
            ("drive.takes.speed", speed),
            ("drive.speed", 1.15),
        ]);
        unit.begin();
        assert_eq!(unit.step(0.0, 7.0), OK);
        assert!(unit.get("impact.step.count") > 0.0);
        assert_eq!(unit.set("force", 0.1), OK);
        let of = ["acceleration", "contact.peak", "position", "drive.force"];
        let found = unit.derivatives(&of, &[("drive.amplitude", 1.0)]);
        let cos = unit.get("drive.angle").cos();
        let expected = [0.5 * cos, 0.0, 0.0, cos];
        assert_close(&found.expect("available"), &expected, 1e-9, "amplitude");
    }
}
