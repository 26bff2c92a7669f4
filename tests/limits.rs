//! Machines whose time scales lie too far apart for doubles are refused. With springs up to their limit and dampers up to
//! a thousandth of theirs eight digits hold.

use softstop::{Machine, Release, Scene, SceneError, Simulation, Slope, Start, Stop};
use softstop_testing::{hertz, kelvin_voigt, loaded, preloaded};

/// The promise of docs/machine.md.
const EIGHT_DIGITS: f64 = 1e-8;
const LIMIT: f64 = 1e7;
const DAMPER_LIMIT: f64 = 1e9;
const HEAVIEST_WITH_EIGHT: f64 = 1e6;
/// Inside and outside of the limit, by more than its own rounding.
const INSIDE: f64 = 1.0 - 1e-12;
const OUTSIDE: f64 = 1.0 + 1e-12;

/// A mass that flies through a clearance of 10 m against a stop; nothing else acts on it.
fn flight(frequency: f64, contact_damping: f64, stop: Stop) -> Scene {
    let mut scene = Scene {
        mass: 2.0,
        stiffness: 0.0,
        clearance: 10.0,
        contact_damping,
        ..Scene::of_stop(stop)
    };
    scene.excitation.amplitude = 0.0;
    scene.excitation.frequency = frequency;
    scene
}

fn spring(stiffness: f64) -> Stop {
    kelvin_voigt(stiffness, Release::Clearance)
}

/// Speed after one contact over that before it.
fn rebound(scene: &Scene, speed: f64) -> f64 {
    let mut machine = Simulation::new(scene, Start::new(7.0, speed)).expect("a machine");
    machine.advance(6.0 / speed).expect("bounded");
    -machine.sample().velocity / speed
}

#[test]
fn a_contact_at_the_limit_keeps_eight_digits() {
    for zeta in [0.0, 1e-3, 0.02, 0.05, 0.1, 0.3, 0.7, 0.95] {
        for (frequency, speed) in [(1.15, 3.0), (40.0, 700.0), (0.01, 0.2)] {
            let fastest = (0.5 * HEAVIEST_WITH_EIGHT / zeta).min(LIMIT);
            let rate = INSIDE * fastest * frequency;
            let (stiffness, damping) = (2.0 * rate * rate, 2.0 * 2.0 * zeta * rate);
            let scene = flight(frequency, damping, spring(stiffness));
            let root = (1.0_f64 - zeta * zeta).sqrt();
            let expected = (-zeta * std::f64::consts::PI / root).exp();
            let error = (rebound(&scene, speed) - expected).abs();
            assert!(
                error < EIGHT_DIGITS,
                "zeta {zeta}, w {frequency}: {error:e}"
            );
        }
    }
}

/// The limit of a scene by its message: the name, and what is allowed.
fn limit(scene: &Scene) -> Option<(&'static str, f64)> {
    match scene.validate() {
        Ok(()) => None,
        Err(SceneError::TimeScales { name, limit, .. }) => Some((name, limit)),
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn what_is_too_fast_is_named_with_its_limit() {
    let frequency = 3.0;
    let rate = LIMIT * frequency;
    let (stiffest, damper) = (2.0 * rate * rate, 2.0 * DAMPER_LIMIT * frequency);
    type Set = fn(&mut Scene, f64);
    let cases: [(&str, f64, Set); 7] = [
        ("stop.stiffness", stiffest, |s, k| s.stop = spring(k)),
        ("stop.stiffness", stiffest, |s, k| {
            s.stop = preloaded(k, 3.0)
        }),
        ("stop.loading", stiffest, |s, stiffness| {
            let from = 0.0;
            s.stop = Stop::PiecewiseLinear {
                loading: vec![Slope { from, stiffness }],
                unloading: Vec::new(),
            }
        }),
        ("damping", damper, |s, c| s.damping = c),
        ("contact.damping", damper, |s, c| s.contact_damping = c),
        ("piercing.stiffness", stiffest, |s, k| {
            s.piercing = loaded().piercing;
            s.piercing.as_mut().expect("a strip").stiffness = k;
        }),
        ("piercing.friction", stiffest, |s, k| {
            s.piercing = loaded().piercing;
            s.piercing.as_mut().expect("a strip").friction = k;
        }),
    ];
    for (name, most, set) in cases {
        let mut scene = flight(frequency, 0.0, Stop::None);
        set(&mut scene, INSIDE * most);
        assert_eq!(limit(&scene), None, "{name}");
        set(&mut scene, OUTSIDE * most);
        let (found, allowed) = limit(&scene).expect(name);
        assert_eq!(found, name);
        assert!((allowed / most - 1.0).abs() < 1e-12, "{name}: {allowed}");
    }
}

#[test]
fn a_suspension_is_not_too_fast_for_its_drive() {
    let mut scene = flight(3.0, 0.0, Stop::None);
    scene.stiffness = 2.0 * 9.0 * LIMIT * LIMIT * INSIDE;
    assert_eq!(limit(&scene), None);
    scene.excitation.frequency *= INSIDE;
    let (name, least) = limit(&scene).expect("too slow a drive");
    assert_eq!(name, "excitation.frequency");
    assert!((least / 3.0 - 1.0).abs() < 1e-12, "{least}");
}

fn power_law(stiffness: f64, exponent: f64, dissipation: f64) -> Scene {
    flight(3.0, 0.0, hertz(stiffness, exponent, dissipation))
}

/// It may take a motion of 10 m and 30 m/s within 1e-6 m.
#[test]
fn a_power_law_has_a_depth() {
    let (depth, speed): (f64, f64) = (10.0 / LIMIT, 30.0);
    for exponent in [1.0, 1.5, 3.0, 20.0] {
        let whole = (exponent + 1.0) * 2.0 * speed / depth.powf(exponent + 1.0);
        let most = 0.5 * speed * whole;
        if most < 1e24 {
            assert_eq!(limit(&power_law(INSIDE * most, exponent, 0.0)), None);
            let (name, found) =
                limit(&power_law(OUTSIDE * most, exponent, 0.0)).expect("too stiff");
            assert_eq!(name, "stop.stiffness");
            assert!((found / most - 1.0).abs() < 1e-12, "{found}");
        }
        let most = whole / 1e3;
        if most < 1e24 {
            assert_eq!(limit(&power_law(1e3, exponent, INSIDE * most)), None);
            let (name, found) =
                limit(&power_law(1e3, exponent, OUTSIDE * most)).expect("too lossy");
            assert_eq!(name, "stop.dissipation");
            assert!((found / most - 1.0).abs() < 1e-12, "{found}");
        }
    }
    let message = power_law(1e3, 21.0, 0.0).validate().expect_err("too high");
    assert_eq!(
        message.to_string(),
        "stop.exponent = 21: must be from 1 to 20"
    );
}

/// Undamped and alone, a power law sends the mass back as fast as it came, at any exponent up to the highest.
#[test]
fn the_highest_exponent_keeps_all_digits() {
    for exponent in [5.0, 10.0, 15.0, 20.0] {
        for stiffness in [150.0, 1e6, 1e12] {
            let error = (rebound(&power_law(stiffness, exponent, 0.0), 3.0) - 1.0).abs();
            assert!(error < 1e-14, "n {exponent}, k {stiffness:e}: {error:e}");
        }
    }
}

#[test]
fn a_limit_is_told_in_the_units_of_the_machine() {
    let ratios = "[ratios]\ndamping = 0.02\nclearance = 10\ncontact.damping = 1e10\n\
                  excitation.frequency = 1.15\nstop = { model = \"none\" }\n";
    let error = Machine::from_toml(ratios).expect_err("too heavily damped");
    let message = error.to_string();
    for word in [
        "line 4",
        "contact.damping = 10000000000",
        "at most 575000000",
    ] {
        assert!(message.contains(word), "{message}");
    }
    let slow = "mass = 1\nstiffness = 39.47841760435743\ndamping = 0\nclearance = 1\ncontact.damping = 0\n\
                excitation = { amplitude = 1, frequency_hz = 1e-8 }\nstop = { model = \"none\" }\n";
    let message = Machine::from_toml(slow).expect_err("too slow").to_string();
    for word in ["excitation.frequency_hz = 1e-8", "at least 1.00000"] {
        assert!(message.contains(word), "{message}");
    }
}
