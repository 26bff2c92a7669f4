//! Derivatives by differences, of machines of any size.

use approx::assert_relative_eq;
use softstop_fmi::variable::Access;
use softstop_fmi::{Advance, Derivatives, Events, Imprint, Known, Row, Unit, slope};
use softstop_units::Drive;

const LOAD: usize = 1;

fn row(name: &str) -> &'static Row<Drive> {
    Drive::about().table.by_name(name).expect("a variable")
}

/// A drive at 1 rad/s that the load takes work from over a short step: J w dw = -dW.
#[test]
fn of_the_speed_by_the_work_of_the_load() {
    for size in [1e-8, 1.0, 1e8] {
        let mut values = Imprint::<Drive>::library().values().to_vec();
        for (name, value) in [
            ("inertia", size),
            ("motor.torque", size),
            ("motor.speed", 1.0),
            ("initial.speed", 1.0),
        ] {
            values[row(name).slot().expect("a parameter").0] = value;
        }
        let mut drive = Drive::begin(&values, 0.0).expect("a drive");
        drive.drive(LOAD, &Derivatives::default()).expect("a load");
        let advance = drive.advance(1e-9, None, &mut Events::default());
        assert!(matches!(advance, Ok(Advance::Arrived)));
        let Access::Continuous { value, tangent, .. } = row("speed").access else {
            unreachable!("speed is continuous");
        };
        let along = drive.tangent(&[(Known::Signal(LOAD), 1.0)]);
        let found = tangent(&along.expect("a derivative"), (value, 1.0));
        assert_relative_eq!(found * size, -1.0, max_relative = 1e-6);
    }
}

/// A bend, a jump or an end of the range beside the argument keep the differences off; at the argument there is none.
#[test]
fn narrow_enough_or_none() {
    for beside in [1e-1, 1e-3, 1e-5, -1e-5] {
        let bent = |x: f64| (x - beside).abs() + x.sin();
        let found = slope(bent(0.0), 1.0, 1.0, |x| Some(bent(x)));
        assert_relative_eq!(found, 1.0 - beside.signum(), epsilon = 1e-6);
        let jumps = |x: f64| f64::from(u8::from(x > beside)) + x.sin();
        let found = slope(jumps(0.0), 1.0, 1.0, |x| Some(jumps(x)));
        assert_relative_eq!(found, 1.0, epsilon = 1e-6);
        let found = slope(0.0, 1.0, 1.0, |x| (x < beside.abs()).then(|| x.sin()));
        assert_relative_eq!(found, 1.0, epsilon = 1e-6);
    }
    let one_sided = slope(0.0, 1.0, 1.0, |x| (x >= 0.0).then(|| x.sin()));
    assert_relative_eq!(one_sided, 1.0, epsilon = 1e-6);
    assert!(slope(0.0, 1.0, 1.0, |x| Some(x.abs())).is_nan());
    assert!(slope(0.0, 1.0, 1.0, |x| Some(x.signum())).is_nan());
    assert!(slope(0.0, 1.0, 1.0, |_| None).is_nan());
    // Rounding in parts of what is usual of a value does not count, however small the value or its derivative.
    for (here, derivative) in [(0.0, 0.0), (1e-9, 1e-9), (0.0, 1e-8)] {
        let rounded = |x: f64| here + derivative * x + 1e-16 * (1e9 * x).sin();
        let found = slope(here, 1.0, 1e-3, |x| Some(rounded(x)));
        assert!((found - derivative).abs() < 1e-10, "{found}");
    }
}
