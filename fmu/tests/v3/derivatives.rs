//! Derivatives on both sides of an event, along a direction and by each known.

use softstop_fmi::variable::{Access, Kind};
use softstop_fmu::table;

use super::unit::Unit;
use crate::common::{DISCARD, OK, reference};

const KNOWNS: [&str; 4] = [
    "initial.position",
    "initial.velocity",
    "force",
    "base.acceleration",
];

/// Outputs that are the largest of some, where another one is the largest on the other side.
const KINKED: [&str; 3] = [
    "contact.peak",
    "impact.step.hardest.time",
    "impact.step.hardest.velocity",
];

/// Machines whose first impact is a jump of the force, or of the velocity.
const SOFT: &[(&str, f64)] = &[];
const RIGID: &[(&str, f64)] = &[
    ("stop.model", 6.0),
    ("piercing.thickness", 0.0),
    ("piercing.travel", 0.0),
];

pub fn assert_close(one: f64, other: f64, most: f64) {
    assert!((one - other).abs() <= most, "{one} and {other}");
}

const AT_REST_ON_A_PRELOADED_STOP: [(&str, f64); 7] = [
    ("stop.model", 2.0),
    ("piercing.thickness", 0.0),
    ("piercing.travel", 0.0),
    ("clearance", 0.5),
    ("initial.position", 0.5),
    ("initial.velocity", 0.0),
    ("stop.preload", 32.0),
];

fn reals() -> Vec<u32> {
    let real = table().rows().filter(|variable| {
        let is_output = matches!(
            variable.access,
            Access::Continuous { .. } | Access::Discrete { .. }
        );
        is_output && matches!(variable.kind, Kind::Real(_))
    });
    real.map(|variable| variable.reference).collect()
}

/// Adjoint derivatives are the transposed of directional ones.
fn check_transposed(unit: &Unit) {
    let (unknowns, knowns) = (reals(), KNOWNS.map(reference));
    let columns: Vec<_> = knowns
        .iter()
        .map(|&known| unit.directional(&unknowns, &[known], &[1.0]))
        .collect();
    let weights: Vec<_> = (0..unknowns.len()).map(|k| 0.3 + 0.1 * k as f64).collect();
    let sums = unit.adjoint(&unknowns, &knowns, &weights);
    for (column, sum) in columns.iter().zip(sums) {
        let terms = column.iter().zip(&weights);
        let direct: f64 = terms.map(|(of, weight)| of * weight).sum();
        assert_close(sum, direct, 1e-13 * direct.abs());
    }
    let along: Vec<_> = KNOWNS.iter().map(|_| 1.0).collect();
    let whole = unit.directional(&unknowns, &knowns, &along);
    for (row, &unknown) in unknowns.iter().enumerate() {
        let gradient = unit.adjoint(&[unknown], &knowns, &[1.0]);
        for (by, column) in gradient.iter().zip(&columns) {
            assert_eq!(by.to_bits(), column[row].to_bits());
        }
        let sum: f64 = gradient.iter().sum();
        let scale: f64 = gradient.iter().map(|by| by.abs()).sum();
        // Those by differences have some nine digits.
        let is_smooth = KINKED.iter().all(|name| reference(name) != unknown);
        assert!(
            !is_smooth || (whole[row] - sum).abs() <= 1e-7 * scale.max(1.0),
            "{unknown}"
        );
    }
}

/// Position and velocity at a time under a small change, and how many impacts there were.
fn moved(values: &[(&str, f64)], time: f64, name: &str, change: f64) -> ([f64; 2], f64) {
    let unit = Unit::begun((false, false), &[]);
    let start = match name {
        "force" => 0.0,
        _ => unit.get(name),
    };
    let mut values = values.to_vec();
    values.push((name, start + change));
    let unit = Unit::begun((false, false), &values);
    unit.step(0.0, time);
    (
        ["position", "velocity"].map(|of| unit.get(of)),
        unit.get("impact.count"),
    )
}

#[test]
fn derivatives_before_and_after_an_impact() {
    for values in [SOFT, RIGID] {
        let unit = Unit::begun((true, true), values);
        let time = unit.step(0.0, 10.0).time;
        let known = ["initial.position", "initial.velocity", "force"];
        let by = known.map(reference);
        let of = ["position", "velocity"].map(reference);
        let jacobian = || by.map(|known| unit.directional(&of, &[known], &[1.0]));
        unit.enter_event_mode();
        check_transposed(&unit);
        let (before, state_before) = (jacobian(), unit.get("velocity"));
        unit.update();
        check_transposed(&unit);
        let (after, state_after) = (jacobian(), unit.get("velocity"));
        for (k, name) in known.iter().enumerate() {
            for sign in [1.0, -1.0] {
                let width = sign * 1e-5;
                let [one, two] = [width, 0.5 * width].map(|by| moved(values, time, name, by));
                let (exact, velocity) = match one.1 {
                    0.0 => (&before[k], state_before),
                    _ => (&after[k], state_after),
                };
                let here = [unit.get("position"), velocity];
                for side in 0..2 {
                    let slope = |of: f64, width: f64| (of - here[side]) / width;
                    let (far, near) = (slope(one.0[side], width), slope(two.0[side], 0.5 * width));
                    let extrapolated = 2.0 * near - far;
                    assert_close(extrapolated, exact[side], 1e-6 * exact[side].abs().max(1.0));
                }
            }
        }
    }
}

#[test]
fn adjoint_is_directional_transposed_over_many_impacts() {
    for values in [SOFT, RIGID] {
        let unit = Unit::begun((false, false), values);
        unit.step(0.0, 23.0);
        check_transposed(&unit);
        unit.step(23.0, 5.0);
        let (of, by) = (reals(), ["force", "base.acceleration"].map(reference));
        for &unknown in &of {
            let gradient = unit.adjoint(&[unknown], &by, &[1.0]);
            let columns = by.map(|by| unit.directional(&[unknown], &[by], &[1.0])[0]);
            assert_eq!(gradient, columns);
        }
    }
}

/// On a preloaded stop at rest, which another clearance would move to or away: an output that it bends is refused, and the
/// instance goes on.
#[test]
fn an_output_without_a_derivative_ends_nothing() {
    let unit = Unit::new((false, false));
    for (name, value) in AT_REST_ON_A_PRELOADED_STOP {
        unit.check(unit.set(name, value));
    }
    unit.enter();
    let [clearance, position, force] =
        ["clearance", "position", "contact.force"].map(|name| [reference(name)]);
    let by_clearance = |of: &[u32]| unit.try_directional(of, &clearance, &[1.0]);
    assert_eq!(by_clearance(&position), (OK, vec![0.0]));
    assert_eq!(by_clearance(&force).0, DISCARD);
    let lines = unit.take_log();
    assert!(
        lines.len() == 1 && lines[0].contains("contact.force has no derivative"),
        "{lines:?}"
    );
    unit.exit();
    unit.step(0.0, 1.0);
}

/// Before a blow of a rigid stop and after it: its position changes by the opposite, times the restitution, whatever changes
/// the motion and whatever the last digit of its time.
#[test]
fn both_sides_of_a_blow_under_a_drive_that_is_followed_in_pieces() {
    for start in 0..40 {
        for handling in [(true, true), (false, true)] {
            let mut values = RIGID.to_vec();
            values.extend([
                ("drive.takes.speed", 1.0),
                ("drive.takes.amplitude", 1.0),
                ("drive.speed", if start % 2 == 0 { 0.06 } else { 1.15 }),
                ("drive.amplitude", 40.0),
                ("stop.restitution", 0.5),
                ("clearance", 1.0),
                ("initial.position", -1.0 - 0.01 * f64::from(start)),
            ]);
            let unit = Unit::begun(handling, &values);
            let time = unit.step(0.0, 50.0).time;
            let knowns = [
                "force",
                "drive.speed",
                "drive.amplitude",
                "initial.position",
            ];
            let changes = || {
                let of = ["position", "impact.velocity"].map(reference);
                knowns.map(|known| unit.directional(&of, &[reference(known)], &[1.0]))
            };
            let before = handling.0.then(|| {
                unit.enter_event_mode();
                let before = changes();
                unit.update();
                before
            });
            let after = changes();
            let velocity = unit.get("impact.velocity");
            assert_eq!(unit.get("impact.time"), time);
            assert!(after.iter().all(|of| of[1] != 0.0), "{after:?}");
            for (before, after) in before.iter().flatten().zip(&after) {
                assert_eq!(before[1], 0.0);
                assert_close(-0.5 * before[0], after[0], 1e-6 * (1.0 + velocity));
            }
        }
    }
}
