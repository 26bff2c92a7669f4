//! Time does not drift: the drive angle after very many periods, and the way there and back.

use proptest::prelude::*;
use softstop::{Clock, DriveAngle, Instant};
use softstop_testing::{assert_near, assert_relative, cases};

/// cos and sin of w t at 60 digits (mpmath), w and t taken as the exact doubles.
const ANGLES: [(f64, f64, f64, f64); 4] = [
    (
        1.15,
        1e9,
        -0.939_425_719_500_436_4,
        -0.342_752_560_225_430_43,
    ),
    (
        0.05,
        3.7e10,
        -0.187_341_891_364_802_61,
        -0.982_294_770_290_394_3,
    ),
    (
        19.75,
        123_456_789.125,
        -0.762_749_720_506_014,
        0.646_693_794_517_929_1,
    ),
    (
        0.9875,
        6.3e8,
        0.983_496_844_004_826,
        -0.180_925_282_458_110_69,
    ),
];

#[test]
fn drive_angle_is_exact_after_a_hundred_million_periods() {
    for (frequency, time, expected_cos, expected_sin) in ANGLES {
        let clock = Clock::new(frequency, 0.0);
        let instant = clock.instant(time);
        let DriveAngle { cos, sin } = clock.drive(instant);
        assert_near(cos, expected_cos, 4e-15);
        assert_near(sin, expected_sin, 4e-15);
        assert_relative(clock.time(instant), time, f64::EPSILON);
    }
}

#[test]
fn whole_periods_leave_no_rest() {
    let clock = Clock::new(1.15, 0.7);
    let mut instant = Clock::at_cycle(0);
    for _ in 0..100_000 {
        instant = clock.after(instant, 0.3 * clock.period());
        instant = clock.after(instant, 0.7 * clock.period());
    }
    // Each of the 200,000 sums may round by half a unit of the period.
    let rest = clock.elapsed(Clock::at_cycle(100_000), instant);
    assert_near(rest, 0.0, 200_000.0 * f64::EPSILON * clock.period());
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn instants_and_times_agree(
        frequency in 1e-3..1e3f64,
        time in -1e6..1e6f64,
        elapsed in 0.0..1e4f64,
    ) {
        let clock = Clock::new(frequency, 0.0);
        let from = clock.instant(time);
        prop_assert!(from.offset >= 0.0 && from.offset < clock.period());
        let to = clock.after(from, elapsed);
        prop_assert!(to.offset >= 0.0 && to.offset < clock.period());
        let rounding = 4.0 * f64::EPSILON * (time.abs() + elapsed + clock.period());
        assert_near(clock.time(from), time, rounding);
        assert_near(clock.elapsed(from, to), elapsed, rounding);
        assert_near(clock.time(to) - time, elapsed, rounding);
        let same = Instant { ..from };
        prop_assert_eq!(clock.elapsed(from, same), 0.0);
    }
}
