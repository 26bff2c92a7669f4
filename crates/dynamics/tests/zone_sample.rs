//! Zones of 200 random machines against 30-digit values: g0, s_SN with its impact, s_PD.
//!
//! The machines come from here (`cargo test --release -p softstop-dynamics --test dynamics zone_sample -- --ignored
//! --nocapture` prints them), with guesses of the orbits from which `tests/reference/zones.py` finds folds and flips by
//! an integrator of its own.

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use serde_json::{Value, json};
use softstop::{Scene, Slope, Stop};
use softstop_dynamics::BranchPoint;
use softstop_dynamics::continuation::{Direction, TestFunction};
use softstop_dynamics::zone::{Zone, hysteresis, loss_of_stability};
use softstop_testing::reference::{ZONES, list, number, ratios};
use softstop_testing::tolerance::GROWN;
use softstop_testing::{is_near, random};

/// Machines of the sample.
const MACHINES: usize = 200;

/// Four digits of a number, so that it is written in few.
fn short(value: f64) -> f64 {
    format!("{value:.3e}").parse().expect("a number")
}

/// Numbers evenly spread in their logarithm.
fn spread(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low.ln()..high.ln()).prop_map(|value| short(value.exp()))
}

fn even(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low..high).prop_map(short)
}

/// Machines as zones.py reads them: bare, with a strip, or with a stop of two slopes.
fn machines() -> impl Strategy<Value = Value> {
    let strip = (
        even(0.0, 30.0),
        even(0.0, 30.0),
        even(0.05, 1.0),
        even(0.0, 1.0),
    );
    let strip = strip.prop_map(|(k2, k3, sigma, travel)| {
        let sigma_nu = short(sigma + travel);
        json!({"regime": "loaded", "k2": k2, "k3": k3, "sigma": sigma, "sigma_nu": sigma_nu})
    });
    let slopes = (spread(0.1, 1e3), even(0.1, 1.0));
    let slopes =
        slopes.prop_map(|(k2, sigma)| json!({"regime": "slopes", "k2": k2, "sigma": sigma}));
    let law = prop_oneof![
        2 => Just(json!({"regime": "unloaded"})),
        2 => strip,
        1 => slopes,
    ];
    let preload = prop_oneof![1 => Just(0.0), 4 => spread(0.1, 500.0)];
    let damping = (spread(1e-3, 0.1), spread(1e-3, 0.3));
    let machine = (law, even(0.2, 12.0), spread(0.1, 1e4), preload, damping);
    machine.prop_map(|(mut law, clearance, stiffness, preload, damping)| {
        law["clearance"] = clearance.into();
        law["stiffness"] = stiffness.into();
        law["preload"] = if law["regime"] == "slopes" {
            0.0
        } else {
            preload
        }
        .into();
        law["damping"] = damping.0.into();
        law["contact_damping"] = damping.1.into();
        law
    })
}

fn scene(parameters: &Value) -> Scene {
    let scene = ratios(parameters).scene().expect("valid");
    if parameters["regime"] != "slopes" {
        return scene;
    }
    let [first, second] = ["k2", "stiffness"].map(|key| number(parameters, key));
    let slope = |from, stiffness| Slope { from, stiffness };
    let loading = vec![
        slope(0.0, first),
        slope(number(parameters, "sigma"), second),
    ];
    let stop = Stop::PiecewiseLinear {
        loading,
        unloading: Vec::new(),
    };
    Scene { stop, ..scene }
}

/// s_PD: where z = 1, followed down from g0, doubles its period.
fn flip(zone: &Zone) -> Option<BranchPoint> {
    let orbit = zone.orbit_at(0.0).ok()?;
    loss_of_stability(&orbit, Direction::Down, TestFunction::Flip).ok()?
}

#[test]
#[ignore = "prints the sample"]
fn sample() {
    let mut runner = TestRunner::new(random::cases(1));
    let machines = machines();
    let guess = |point: &BranchPoint| {
        let numbers = [point.position, point.velocity, point.parameter];
        json!(numbers.map(|number| format!("{number:.9}")))
    };
    let mut found = Vec::new();
    while found.len() < MACHINES {
        let parameters = machines.new_tree(&mut runner).expect("a machine").current();
        if let Ok(zone) = hysteresis(&scene(&parameters)) {
            let flip = flip(&zone).map(|flip| guess(&flip));
            found.push(
                json!({"parameters": parameters, "fold": guess(&zone.high.point), "flip": flip}),
            );
        }
    }
    println!("{}", json!(found));
}

#[test]
fn zones_agree_with_thirty_digits() {
    let records = list(&ZONES, "zones");
    assert_eq!(records.len(), MACHINES);
    let mut flips = 0;
    for expected in records {
        let zone = hysteresis(&scene(&expected["parameters"])).expect("a zone");
        let agrees = |value: f64, key: &str| {
            let wanted = number(expected, key);
            let close = is_near(value, wanted, GROWN * wanted.max(1.0));
            assert!(close, "{key} {value} in place of {expected}");
        };
        agrees(zone.frequency_g0, "frequency_g0");
        agrees(zone.high.frequency, "frequency_sn");
        agrees(zone.high.point.before_impact_velocity(), "velocity_sn");
        match (flip(&zone), expected["frequency_pd"].is_null()) {
            (Some(flip), false) => {
                agrees(flip.parameter, "frequency_pd");
                flips += 1;
            }
            (None, true) => {}
            (flip, _) => panic!("{flip:?} in place of {expected}"),
        }
    }
    assert!(flips > MACHINES / 4, "{flips} flips");
}
