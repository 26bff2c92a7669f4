//! The many-digit reference against independent integrations in 56 digits (tests/reference/stops.py), a closed
//! form and the exact method.

use std::cell::RefCell;
use std::str::FromStr;

use crate::many_digits::number::{Digits, Real, float, size};
use crate::many_digits::walk::Walk;
use crate::many_digits::{ReferenceError, solve};
use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use serde_json::Value;
use softstop::{Excitation, Impact, Scene, Start, Stop};
use softstop_lab::methods::{Exact, Integrator, Task};
use softstop_lab::throughput::random_machines::{Draw, Kind};
use softstop_testing::reference::{STOPS, list, number};
use softstop_testing::{hertz, is_near, unloaded};

/// Half a unit in the 30th digit of numbers up to 1000, to which stops.json is written, ten times over.
const ALLOWED: f64 = 1e-26;

/// Impacts slower than this, in m/s, are not told by every method.
const SLOW: f64 = 1e-6;

/// A number that stops.json holds as text, with all its digits.
fn real(value: &Value, key: &str) -> Real {
    let text = value[key].as_str().expect("a number as text");
    let decimal = FBig::<HalfEven, 10>::from_str(text).expect("a number");
    decimal.with_base_and_precision::<2>(160).value()
}

fn task(scene: Scene, start: (f64, f64), periods: f64) -> Task {
    Task::new(scene, Start::new(start.0, start.1), periods, u64::MAX)
}

fn apart(a: &Real, b: &Real) -> f64 {
    float(&size(&(a - b)))
}

/// The worst difference of the end and of the impacts up to it from a record.
fn error(case: &Value) -> f64 {
    let name = &case["name"];
    let last = list(case, "samples").last().expect("samples");
    let start = (number(case, "position"), number(case, "velocity"));
    let scene = softstop_testing::scenes::scene(&case["scene"]);
    let task = task(scene, start, number(last, "periods"));
    let course = Walk::new(&task, Digits(160)).and_then(|walk| walk.run(&|_| true));
    let course = course.unwrap_or_else(|error| panic!("{name}: {error}"));
    let mut worst = apart(&course.state.position, &real(last, "position"))
        .max(apart(&course.state.velocity, &real(last, "velocity")));
    let expected = list(case, "impacts");
    let fast = |impact: &&(Real, Real)| float(&impact.1) > SLOW;
    let found: Vec<_> = course.impacts.iter().filter(fast).collect();
    // Only the first 40 impacts are on record.
    assert_eq!(found.len().min(40), expected.len(), "impacts of {name}");
    for (impact, expected) in found.iter().zip(expected) {
        worst = worst.max(apart(&impact.0, &real(expected, "time")));
        worst = worst.max(apart(&impact.1, &real(expected, "velocity")));
    }
    worst
}

fn agrees(family: &str, count: usize) {
    let cases = list(&STOPS, "cases").iter();
    let cases: Vec<_> = cases.filter(|case| case["family"] == family).collect();
    assert_eq!(cases.len(), count);
    for case in cases {
        let error = error(case);
        assert!(error < ALLOWED, "{}: {error:e}", case["name"]);
    }
}

#[test]
fn rigid_stops_agree_with_56_digits() {
    agrees("rigid", 21);
}

#[test]
fn stiff_stops_agree_with_56_digits() {
    agrees("stiff", 2);
}

#[test]
fn preloaded_stops_agree_with_56_digits() {
    agrees("preloaded", 21);
}

#[test]
fn kelvin_voigt_stops_agree_with_56_digits() {
    agrees("kelvinVoigt", 21);
}

#[test]
fn piecewise_linear_stops_agree_with_56_digits() {
    agrees("piecewiseLinear", 14);
}

/// x'' + x = cos 2t from (1, 0): x = (4 cos t - cos 2t)/3.
#[test]
fn a_machine_without_a_stop_has_its_closed_form() {
    let scene = Scene {
        damping: 0.0,
        excitation: Excitation {
            amplitude: 1.0,
            frequency: 2.0,
            phase: 0.0,
        },
        stop: Stop::None,
        ..unloaded(1.15)
    };
    // 7.5 periods of pi: cos t = 0, sin t = -1, cos 2t = -1, sin 2t = 0.
    let reference = solve(&task(scene, (1.0, 0.0), 7.5), &|_| true).expect("a reference");
    assert!(is_near(reference.end.0, 1.0 / 3.0, 1e-16), "{reference:?}");
    assert!(is_near(reference.end.1, 4.0 / 3.0, 3e-16), "{reference:?}");
    assert!(reference.doubt.end < 1e-44, "{reference:?}");
    assert!(reference.impacts.is_empty() && reference.crossings == 0);
}

/// In chaos the 48 digits shrink, and the reference tells by how much.
#[test]
fn chaos_shows_in_the_doubt() {
    let mut scene = unloaded(1.15);
    let calm = solve(&task(scene.clone(), (0.0, 14.0), 20.0), &|_| true).expect("a reference");
    scene.excitation.frequency = 0.9875;
    let chaos = solve(&task(scene, (0.0, 14.0), 60.0), &|_| true).expect("a reference");
    assert!(calm.doubt.end < 1e-43, "{:?}", calm.doubt);
    assert!(chaos.doubt.end < 1e-30, "{:?}", chaos.doubt);
    assert!(
        chaos.doubt.end > 100.0 * calm.doubt.end,
        "{:?}",
        chaos.doubt
    );
}

#[test]
fn progress_is_told_and_a_refusal_ends_the_run() {
    let task = task(unloaded(1.15), (0.0, 14.0), 2.0);
    let shares = RefCell::new(vec![0.0]);
    let note = |share| {
        shares.borrow_mut().push(share);
        true
    };
    solve(&task, &note).expect("a reference");
    let shares = shares.into_inner();
    assert!(shares.is_sorted() && shares.len() > 10 && shares[shares.len() - 1] > 0.9);
    assert_eq!(
        solve(&task, &|share| share < 0.3),
        Err(ReferenceError::Interrupted)
    );
}

#[test]
fn power_laws_and_starts_beyond_a_wall_are_refused() {
    let mut scene = unloaded(1.15);
    scene.stop = hertz(50.0, 1.5, 0.0);
    let refused = solve(&task(scene.clone(), (0.0, 14.0), 1.0), &|_| true);
    let power = ReferenceError::PowerLaw {
        exponent: 1.5,
        dissipation: 0.0,
    };
    assert_eq!(refused, Err(power));
    scene.stop = Stop::Rigid { restitution: 0.5 };
    let refused = solve(&task(scene, (11.0, 0.0), 1.0), &|_| true);
    assert!(
        matches!(refused, Err(ReferenceError::Task(_))),
        "{refused:?}"
    );
}

fn fast(impacts: &[Impact]) -> usize {
    let fast = impacts.iter().filter(|impact| impact.velocity > SLOW);
    fast.count()
}

/// Neither has code of the other; both are right to rounding, so that only the growth of rounding tells them
/// apart.
#[test]
fn the_exact_method_agrees_on_random_machines() {
    let mut draw = Draw::new(2003, 0);
    let mut impacts = 0;
    for index in 0..100 {
        let (kind, mut scene, start) = draw.machine().expect("a machine");
        if kind == Kind::Power {
            continue;
        }
        scene.mass = 0.5 + 0.5 * f64::from(index % 6);
        scene.damping *= 1.0 + f64::from(index % 7);
        scene.excitation.phase = f64::from(index);
        let task = task(scene, (start.position, start.velocity), 4.0);
        let exact = Exact.integrate(&task).expect("a motion");
        let reference = solve(&task, &|_| true);
        let reference = reference.unwrap_or_else(|error| panic!("{index}: {error}\n{task:?}"));
        let counts = [fast(&exact.impacts), fast(&reference.impacts)];
        assert_eq!(counts[0], counts[1], "{index}: {task:?}");
        let error = (exact.end.0 - reference.end.0)
            .abs()
            .max((exact.end.1 - reference.end.1).abs());
        assert!(error < 1e-9, "{index}: {error:e}\n{task:?}");
        impacts += counts[0];
    }
    assert!(impacts > 100, "{impacts} impacts");
}
