//! Every law of a stop against independent 40-digit integrations (tests/reference/stops.py).

use serde_json::Value;
use softstop::{Dimension, Parameter, PhaseKind, Scene, Start, Stop, Trajectory};
use softstop_testing::is_near;
use softstop_testing::reference::{STOPS, list, number};
use softstop_testing::scenes::{instant, scene};
use softstop_testing::tolerance::SOLVED;

/// Rounding errors, in units of 2^-53 times the growth of a perturbation, that a motion may show. The
/// most are seen where an overdamped contact is left slowly: its end then hangs on the last digit of the
/// clearance.
const ALLOWED: f64 = 600.0;

/// The scenes on which general methods fail, a stiff stop over 200 periods and a rigid one through accumulation, rest and release,
/// and their absolute accuracy.
const EXACT: [(&str, f64); 3] = [
    ("stiff", 1e-11),
    ("rigid zeno A", 1e-12),
    ("rigid zeno B", 1e-12),
];

/// The worst errors of the samples: in units of what is allowed, and absolute.
fn worst(case: &Value, scene: &Scene, trajectory: &Trajectory) -> [f64; 2] {
    let mut growth: f64 = 1.0;
    let mut worst = [0.0_f64; 2];
    for sample in list(case, "samples") {
        let (x, v) = (number(sample, "position"), number(sample, "velocity"));
        growth = growth.max(number(sample, "growth"));
        let periods = number(sample, "periods");
        let state = trajectory.at(instant(scene, periods)).expect("within");
        let error = (state.position - x).abs().max((state.velocity - v).abs());
        let allowed = ALLOWED * 0.5 * f64::EPSILON * (1.0 + growth) * (1.0 + x.abs() + v.abs());
        worst = [worst[0].max(error / allowed), worst[1].max(error)];
    }
    worst
}

/// A machine of so many times the mass that moves alike: all its forces are as many times as large.
fn of_mass(mut scene: Scene, mass: f64) -> Scene {
    for parameter in Parameter::ALL {
        let is_of_mass = matches!(
            parameter.about().dimension,
            Dimension::Mass | Dimension::Stiffness | Dimension::Damping | Dimension::Force
        );
        if let Some(value) = parameter.get(&scene).filter(|_| is_of_mass) {
            parameter.set(&mut scene, mass * value);
        }
    }
    if let Stop::PiecewiseLinear { loading, unloading } = &mut scene.stop {
        for slope in loading.iter_mut().chain(unloading) {
            slope.stiffness *= mass;
        }
    }
    scene
}

#[test]
fn motions_agree_with_forty_digits() {
    let cases = list(&STOPS, "cases");
    assert!(cases.len() >= 100);
    let (mut failures, mut exact) = (Vec::new(), 0);
    for (index, case) in cases.iter().enumerate() {
        let name = &case["name"];
        let scene = match case["family"].as_str() {
            Some("random") => of_mass(scene(&case["scene"]), 0.5 + 0.5 * (index % 6) as f64),
            _ => scene(&case["scene"]),
        };
        let start = Start::new(number(case, "position"), number(case, "velocity"));
        let last = list(case, "samples").last().expect("samples");
        let end = instant(&scene, number(last, "periods"));
        let trajectory = match scene.trajectory_until(start, end) {
            Ok(trajectory) => trajectory,
            Err(error) => {
                failures.push(format!("{name}: {error}"));
                continue;
            }
        };
        let [error, absolute] = worst(case, &scene, &trajectory);
        if error > 1.0 || error.is_nan() {
            failures.push(format!("{name}: {error:e} times what is allowed"));
        }
        if let Some((_, allowed)) = EXACT.iter().find(|exact| name == exact.0) {
            exact += 1;
            if absolute >= *allowed {
                failures.push(format!("{name}: {absolute:e} off"));
            }
        }
        failures.extend(compare_impacts(case, &trajectory));
        failures.extend(compare_rests(case, &trajectory));
        let balance = trajectory.energy_defect().abs()
            / (trajectory.work().supplied.abs() + trajectory.work().dissipated + scene.mass);
        if balance > 1e-11 {
            failures.push(format!("{name}: energy defect {balance:e}"));
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
    assert_eq!(exact, EXACT.len());
}

fn compare_impacts(case: &Value, trajectory: &Trajectory) -> Option<String> {
    let name = &case["name"];
    let found: Vec<_> = trajectory
        .impacts()
        .filter(|touch| touch.before_impact_velocity > 1e-6)
        .collect();
    let expected = list(case, "impacts");
    if found.len() < expected.len() || (found.len() > expected.len() && expected.len() < 40) {
        let counts = (found.len(), expected.len());
        return Some(format!("{name}: {} impacts, not {}", counts.0, counts.1));
    }
    let growth = list(case, "samples")
        .iter()
        .map(|sample| number(sample, "growth"))
        .fold(1.0, f64::max);
    for (touch, impact) in found.iter().zip(expected) {
        let (time, velocity) = (number(impact, "time"), number(impact, "velocity"));
        let allowed = 10.0 * ALLOWED * 0.5 * f64::EPSILON * (1.0 + growth);
        let off = (trajectory.clock.time(touch.instant) - time).abs();
        if off * velocity.min(1.0) > allowed * (1.0 + time) {
            return Some(format!("{name}: impact at {time} is {off:e} off"));
        }
        let off = (touch.before_impact_velocity - velocity).abs();
        if off * velocity.min(1.0) > allowed * (10.0 + velocity) {
            return Some(format!(
                "{name}: velocity of the impact at {time} is {off:e} off"
            ));
        }
    }
    None
}

/// Rests of the reference, as (from, to), against those of the trajectory.
fn compare_rests(case: &Value, trajectory: &Trajectory) -> Option<String> {
    let name = &case["name"];
    let resting = |kind: PhaseKind| matches!(kind, PhaseKind::Resting | PhaseKind::Stuck);
    let found: Vec<(f64, f64)> = trajectory
        .arcs
        .iter()
        .filter(|arc| resting(arc.kind) && arc.duration > 1e-9)
        .map(|arc| {
            let start = trajectory.clock.time(arc.start);
            (start, start + arc.duration)
        })
        .collect();
    for rest in list(case, "rests") {
        let from = number(rest, "from");
        // A rest without end lasts as long as the motion is followed.
        let last = trajectory.arcs.last().expect("arcs");
        let end = trajectory.clock.time(last.start) + last.duration;
        let to = if rest["to"].is_null() {
            end
        } else {
            number(rest, "to").min(end)
        };
        let is_this = |(start, end): &&(f64, f64)| {
            is_near(*start, from, 10.0 * SOLVED) && is_near(*end, to, 10.0 * SOLVED)
        };
        if to - from > 1e-6 && !found.iter().any(|rest| is_this(&rest)) {
            return Some(format!(
                "{name}: no rest from {from} to {to} among {found:?}"
            ));
        }
    }
    None
}
