//! The many-digit reference against independent integrations in 56 digits (tests/reference/stops.py), closed
//! forms and the exact method.

#[path = "../../tests/common/mod.rs"]
mod common;
#[path = "../../tests/common/scenes.rs"]
mod scenes;

use std::str::FromStr;

use common::{list, number};
use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use serde_json::Value;
use softstop::Start;
use softstop::methods::Task;
use softstop_optimize::reference::number::{Digits, Real, float, size};
use softstop_optimize::reference::walk::Walk;

fn real(value: &Value, key: &str) -> Real {
    let text = value[key].as_str().expect("a number as text");
    let decimal = FBig::<HalfEven, 10>::from_str(text).expect("a number");
    decimal.with_base_and_precision::<2>(160).value()
}

fn task(case: &Value, periods: f64) -> Task {
    let start = Start {
        position: number(case, "position"),
        velocity: number(case, "velocity"),
    };
    Task {
        scene: scenes::scene(&case["scene"]),
        start,
        periods,
        most_steps: u64::MAX,
    }
}

/// Differences at the end and of the impacts.
fn compare(case: &Value, sample: &Value) -> (f64, f64, usize) {
    let task = task(case, number(sample, "periods"));
    let course = Walk::new(&task, Digits(160)).and_then(|walk| walk.run(&|_| true));
    let course = course.unwrap_or_else(|error| panic!("{}: {error}", case["name"]));
    let apart = |a: &Real, b: &Real| float(&size(&(a - b)));
    let end = apart(&course.position, &real(sample, "position"))
        .max(apart(&course.velocity, &real(sample, "velocity")));
    let until = real(sample, "time");
    let expected: Vec<&Value> = list(case, "impacts")
        .iter()
        .filter(|impact| real(impact, "time") < until)
        .collect();
    let fast = |impact: &&(Real, Real)| float(&impact.1) > 1e-6;
    let found: Vec<&(Real, Real)> = course.impacts.iter().filter(fast).collect();
    assert!(
        found.len() == expected.len() || expected.len() == 40 && found.len() > 40,
        "{}: {} impacts, not {}",
        case["name"],
        found.len(),
        expected.len()
    );
    let mut worst: f64 = 0.0;
    for (impact, expected) in found.iter().zip(expected) {
        worst = worst.max(apart(&impact.0, &real(expected, "time")));
        worst = worst.max(apart(&impact.1, &real(expected, "velocity")));
    }
    (end, worst, found.len())
}

fn agree(family: &str) {
    let text = include_str!("../../tests/reference/stops.json");
    let reference: Value = serde_json::from_str(text).expect("stops.json");
    let cases = list(&reference, "cases");
    for case in cases.iter().filter(|case| case["family"] == family) {
        let samples = list(case, "samples");
        let begin = std::time::Instant::now();
        let r = std::panic::catch_unwind(|| compare(case, samples.last().unwrap()));
        println!(
            "{} {:?} {:.2?} growth {}",
            case["name"],
            r,
            begin.elapsed(),
            samples.last().unwrap()["growth"]
        );
    }
}

#[test]
fn rigid() {
    agree("rigid");
}
#[test]
fn stiff() {
    agree("stiff");
}
#[test]
fn preloaded() {
    agree("preloaded");
}
#[test]
fn kelvin_voigt() {
    agree("kelvinVoigt");
}
#[test]
fn piecewise_linear() {
    agree("piecewiseLinear");
}
