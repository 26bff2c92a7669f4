//! The exact flow against 40-digit values (tests/reference/flow.py): every kind of root, zero and
//! tiny stiffness, exact and near resonance, short and long times.

use softstop::DriveAngle;
use softstop::internals::{ArcSolution, Departure, LinearLaw, Polynomial};
use softstop_testing::reference::{FLOW, number};

/// Rounding errors, in units of the 2^-53 sensitivity of the case to its own inputs, that an
/// evaluation may show.
const ALLOWED: f64 = 40.0;

#[test]
fn flow_agrees_with_forty_digits() {
    let cases = FLOW.as_array().expect("a list");
    assert!(cases.len() > 200);
    let mut worst = (0.0, String::new());
    for case in cases {
        let get = |key| number(case, key);
        let w = get("drive_frequency");
        let flow = LinearLaw::new(
            1.0,
            2.0 * get("decay"),
            get("stiffness"),
            get("amplitude"),
            w,
        );
        let departure = Departure {
            position: get("position"),
            velocity: get("velocity"),
            drive: DriveAngle::at(get("drive_angle")),
            forcing: Polynomial::linear(get("constant"), get("ramp")),
            acceleration: None,
        };
        let elapsed = get("elapsed");
        let drive = DriveAngle::at(get("drive_angle") + w * elapsed);
        let (x, v) = ArcSolution::new(&flow, departure).state_at(elapsed, drive);
        let checks = [
            (x, "expected_position", "position_sensitivity"),
            (v, "expected_velocity", "velocity_sensitivity"),
        ];
        for (value, expected, sensitivity) in checks {
            let scale = get(sensitivity).abs().max(f64::MIN_POSITIVE) * f64::EPSILON * 0.5;
            let ratio = (value - get(expected)).abs() / scale;
            if ratio.is_nan() || ratio > worst.0 {
                worst = (ratio, format!("{} {expected}", case["name"]));
            }
            if ratio.is_nan() || ratio > ALLOWED {
                println!(
                    "{} {expected}: {value:e} vs {:e}: {ratio:.1}",
                    case["name"],
                    get(expected)
                );
            }
        }
    }
    assert!(
        worst.0 <= ALLOWED,
        "worst: {} roundings in {}",
        worst.0,
        worst.1
    );
}
