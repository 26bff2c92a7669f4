//! The drive: its inputs, whether they hold, and what it does.

use softstop_fmi::variable::{Access, Kind};

use super::rows::{LARGE, Row, after, continuous, fixed, real, row, shown_in, with_drive, within};
use crate::machine::Machine;
use crate::signal;
use crate::start::slot;
use crate::tangent::Tangent;
use crate::units;

/// What its angle at the start depends on.
#[rustfmt::skip]
const TURNED: &[&str] = &["excitation.frequency", "excitation.phase", "drive.takes.speed"];

/// What its force at the start depends on.
#[rustfmt::skip]
const FORCED: &[&str] = &[
    "excitation.amplitude", "excitation.frequency", "excitation.phase", "drive.amplitude", "drive.takes.speed",
    "drive.takes.amplitude",
];

/// What its power at the start depends on.
#[rustfmt::skip]
const POWERED: &[&str] = &[
    "excitation.amplitude", "excitation.frequency", "excitation.phase", "initial.velocity", "drive.amplitude",
    "drive.takes.speed", "drive.takes.amplitude",
];

fn power(machine: &Machine) -> f64 {
    machine.drive_power().0
}

/// Derivative of its power.
fn power_change(of: &Tangent) -> f64 {
    let (force, velocity) = (of.machine.drive_force().0, of.machine.sample().velocity);
    of.drive_force_change * velocity + force * of.exact.velocity
}

/// All of it.
#[rustfmt::skip]
pub(super) const DRIVE: &[Row] = &[
    row(103, "drive.speed", shown_in(within(&units::ANGULAR_FREQUENCY, -LARGE, LARGE), "Hz"), Access::Signal(signal::SPEED),
        "Speed of the drive, its angle being the integral: it holds in place of excitation.frequency if drive.takes.speed is true. With derivatives of order 1 to 7 it goes on as a polynomial"),
    row(104, "drive.amplitude", within(&units::FORCE, -LARGE, LARGE), Access::Signal(signal::AMPLITUDE),
        "Amplitude of the drive: it holds in place of excitation.amplitude if drive.takes.amplitude is true. With derivatives as for drive.speed"),
    fixed(25, "drive.takes.speed", slot::TAKES_SPEED, Kind::Boolean,
        "The input drive.speed leads the drive, which then begins at the angle excitation.phase; otherwise excitation.frequency does"),
    fixed(26, "drive.takes.amplitude", slot::TAKES_AMPLITUDE, Kind::Boolean,
        "The input drive.amplitude leads the drive; otherwise excitation.amplitude does"),
    continuous(212, "drive.angle", shown_in(real(&units::ANGLE), "deg"), after(TURNED),
        (|machine| machine.drive_angle().0, |of, output| of.along(|_| 0.0, output)), &[|machine| machine.drive_angle().1, |machine| machine.drive_angle().2],
        "Angle of the drive F0 cos(angle), counted on over the turns"),
    continuous(213, "drive.force", shown_in(real(&units::FORCE), "kN"), with_drive(FORCED),
        (|machine| machine.drive_force().0, |of, output| of.along(|of| of.drive_force_change, output)), &[|machine| machine.drive_force().1, |machine| machine.drive_force().2],
        "Force of the drive on the mass"),
    continuous(214, "drive.power", real(&units::POWER), with_drive(POWERED),
        (power, |of, output| of.along(power_change, output)), &[|machine| machine.drive_power().1, |machine| machine.drive_power().2],
        "Power that the drive gives to the mass, force times velocity"),
    continuous(215, "drive.work", real(&units::ENERGY), after(&[]),
        (Machine::drive_work, |of, output| of.along(|of| of.exact.supplied - of.exact.work, output)), &[power, |machine| machine.drive_power().1],
        "Work of the drive on the mass since the start, the integral of drive.power"),
];
