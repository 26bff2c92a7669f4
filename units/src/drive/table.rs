//! The variables of the drive.

use softstop_fmi::Flow::Signal;
use softstop_fmi::rows::{
    LARGE, SMALL, after, bare, continuous, fixed, nominal, real, row, shown_in, tunable, within,
};
use softstop_fmi::si;
use softstop_fmi::variable::{Access, Dependencies, Kind, Variable};
use softstop_fmi::{Quantity, Terminal};

use super::motor::MODEL;
use super::{ANGLE, DISSIPATED, Drive, LOAD, PAID, SPEED, SUPPLIED, VOLTAGE, slot};
use crate::difference::Direction;

type DriveVariable = Variable<Drive, Direction<Drive>>;

pub(super) static QUANTITIES: &[&Quantity] = &[
    &si::ANGLE,
    &si::ANGULAR_FREQUENCY,
    &si::TORQUE,
    &si::INERTIA,
    &si::ROTATIONAL_DAMPING,
    &si::UNBALANCE,
    &si::FORCE,
    &si::POWER,
    &si::ENERGY,
];

pub(super) const TERMINALS: &[Terminal] = &[Terminal {
    name: "drive",
    description: "Load of the rotating unbalance: softstop.fmu",
    members: &[
        ("speed", Signal, "speed"),
        ("amplitude", Signal, "amplitude"),
        ("work", Signal, "load.work"),
    ],
}];

pub(super) const GROUPS: &[&[DriveVariable]] = &[INPUTS, PARAMETERS, OUTPUTS];

/// What sets the motor's torque at the start.
#[rustfmt::skip]
const DRIVES: &[&str] = &[
    "motor.model", "motor.voltage", "motor.torque", "motor.speed", "motor.slip", "initial.speed", "voltage",
];

/// What the voltage changes at once.
const fn at_once(initial: &'static [&'static str]) -> Dependencies {
    Dependencies {
        inputs: &["voltage"],
        initial,
    }
}

#[rustfmt::skip]
const INPUTS: &[DriveVariable] = &[
    row(100, "voltage", bare(-LARGE, LARGE), Access::Signal(VOLTAGE),
        "Voltage that is added to motor.voltage; with its derivatives of order 1 to 7 it goes on as a polynomial"),
    row(101, "load.work", within(&si::ENERGY, -LARGE, LARGE), Access::Signal(LOAD),
        "Work that the load has taken so far, with its derivatives of order 1 to 7 if they are known: drive.work of softstop.fmu. What it jumps by is taken from the rotor evenly over the next step"),
];

#[rustfmt::skip]
const PARAMETERS: &[DriveVariable] = &[
    fixed(0, "motor.model", slot::MODEL, Kind::Enumeration(&MODEL),
        "Law of the motor's torque"),
    tunable(fixed(1, "motor.voltage", slot::VOLTAGE, bare(-LARGE, LARGE),
        "Voltage u as a share of the rated one; 0 is a motor without current")),
    fixed(2, "motor.torque", slot::TORQUE, within(&si::TORQUE, 0.0, LARGE),
        "Torque at rest (directCurrent), or the largest one (asynchronous), at the rated voltage"),
    fixed(3, "motor.speed", slot::SPEED, shown_in(within(&si::ANGULAR_FREQUENCY, SMALL, LARGE), "Hz"),
        "Speed without load at the rated voltage"),
    fixed(4, "motor.slip", slot::SLIP, bare(SMALL, LARGE),
        "Slip at the largest torque (asynchronous)"),
    fixed(5, "inertia", slot::INERTIA, within(&si::INERTIA, SMALL, LARGE),
        "Moment of inertia J of all that turns"),
    fixed(6, "friction", slot::FRICTION, within(&si::ROTATIONAL_DAMPING, 0.0, LARGE),
        "Viscous friction c of the bearings"),
    fixed(7, "unbalance", slot::UNBALANCE, within(&si::UNBALANCE, 0.0, LARGE),
        "Mass of the unbalance times its distance from the axis"),
    fixed(8, "initial.speed", slot::INITIAL_SPEED, shown_in(within(&si::ANGULAR_FREQUENCY, -LARGE, LARGE), "Hz"),
        "Speed at the start time"),
    fixed(9, "initial.angle", slot::INITIAL_ANGLE, shown_in(within(&si::ANGLE, -LARGE, LARGE), "deg"),
        "Angle at the start time"),
];

#[rustfmt::skip]
const OUTPUTS: &[DriveVariable] = &[
    continuous(200, "speed", shown_in(real(&si::ANGULAR_FREQUENCY), "Hz"), after(&["initial.speed"]),
        (Drive::speed, Direction::of), &[|drive| drive.now()[SPEED]],
        "Speed w of the rotor: drive.speed of softstop.fmu"),
    continuous(201, "angle", shown_in(real(&si::ANGLE), "deg"), after(&["initial.angle"]),
        (|drive| drive.state[ANGLE], Direction::of), &[Drive::speed],
        "Angle of the rotor, counted on over the turns"),
    continuous(202, "amplitude", shown_in(real(&si::FORCE), "kN"), after(&["initial.speed", "unbalance"]),
        (Drive::amplitude, Direction::of),
        &[|drive| 2.0 * drive.motor.unbalance * drive.speed() * drive.now()[SPEED]],
        "Force of the rotating unbalance, unbalance w^2: drive.amplitude of softstop.fmu"),
    continuous(203, "torque", nominal(real(&si::TORQUE), 10.0), at_once(DRIVES),
        (Drive::torque, Direction::of), &[],
        "Torque of the motor"),
    continuous(204, "power", nominal(real(&si::POWER), 10.0), at_once(DRIVES),
        (|drive| drive.torque() * drive.speed(), Direction::of), &[],
        "Power of the motor"),
    continuous(205, "energy.kinetic", nominal(real(&si::ENERGY), 10.0), after(&["inertia", "initial.speed"]),
        (Drive::kinetic, Direction::of),
        &[|drive| drive.motor.inertia * drive.speed() * drive.now()[SPEED]],
        "Energy of the rotor"),
    continuous(206, "energy.supplied", nominal(real(&si::ENERGY), 10.0), after(&[]),
        (|drive| drive.state[SUPPLIED], Direction::of), &[|drive| drive.now()[SUPPLIED]],
        "Work of the motor since the start"),
    continuous(207, "energy.dissipated", nominal(real(&si::ENERGY), 10.0), after(&[]),
        (|drive| drive.state[DISSIPATED], Direction::of), &[|drive| drive.now()[DISSIPATED]],
        "Energy lost to friction since the start"),
    continuous(208, "energy.load", nominal(real(&si::ENERGY), 10.0), after(&[]),
        (|drive| drive.state[PAID], Direction::of), &[|drive| drive.now()[PAID]],
        "Work that the load has taken from the rotor since the start; load.work from the end of the next step on"),
];
