//! The output variables.

use softstop_fmi::variable::{Access, Kind};

use super::rows::{Row, after, at_once, continuous, count, discrete, nominal, real, row};
use crate::machine::Machine;
use crate::units;

fn velocity(machine: &Machine) -> f64 {
    machine.sample().velocity
}

fn acceleration(machine: &Machine) -> f64 {
    machine.sample().acceleration
}

fn jerk(machine: &Machine) -> f64 {
    machine.sample().jerk
}

fn clamp_count(count: u64) -> i32 {
    i32::try_from(count).unwrap_or(i32::MAX)
}

/// All that decides on the force and the acceleration at the start.
#[rustfmt::skip]
const EVERYTHING: &[&str] = &[
    "mass", "stiffness", "damping", "excitation.amplitude", "excitation.frequency", "excitation.phase",
    "clearance", "contact.damping", "stop.model", "stop.stiffness", "stop.preload", "stop.release",
    "stop.exponent", "stop.dissipation", "stop.loading.count", "stop.loading.from",
    "stop.loading.stiffness", "stop.unloading.count", "stop.unloading.from", "stop.unloading.stiffness",
    "rigid.present", "rigid.travel", "piercing.stiffness", "piercing.friction", "piercing.thickness",
    "piercing.travel", "initial.position", "initial.velocity", "force", "material",
];

/// What the energy stored at the start depends on.
#[rustfmt::skip]
const STORES: &[&str] = &[
    "mass", "stiffness", "clearance", "stop.model", "stop.stiffness", "stop.preload", "stop.exponent",
    "stop.loading.count", "stop.loading.from", "stop.loading.stiffness", "stop.unloading.count",
    "stop.unloading.from", "stop.unloading.stiffness", "piercing.thickness", "piercing.travel",
    "initial.position", "initial.velocity",
];

/// The outputs.
#[rustfmt::skip]
pub(super) const OUTPUTS: &[Row] = &[
    continuous(203, "contact.force", nominal(real(&units::FORCE), 10.0), at_once(EVERYTHING),
        (|machine| machine.sample().contact_force, |of| of.contact_force),
        &[|machine| machine.rates().contact_force.0, |machine| machine.rates().contact_force.1],
        "Force of stop and strip on the mass: F in m x'' + b1 x' + k1 x + F = F0 cos(w t + phi) + force. Positive in compression (against positive x); it includes the additional damping in contact. While the phase is resting it is what holds the mass, while it is chatter the mean over the bounces"),
    continuous(200, "position", nominal(real(&units::LENGTH), 10.0), after(&["initial.position"]),
        (|machine| machine.sample().position, |of| of.position), &[velocity, acceleration],
        "Position of the mass"),
    continuous(201, "velocity", nominal(real(&units::VELOCITY), 10.0), after(&["initial.velocity"]),
        (velocity, |of| of.velocity), &[acceleration, jerk],
        "Velocity of the mass"),
    continuous(202, "acceleration", nominal(real(&units::ACCELERATION), 10.0), at_once(EVERYTHING),
        (acceleration, |of| of.acceleration), &[jerk, |machine| machine.rates().snap],
        "Acceleration of the mass; while the phase is chatter the mean over the bounces, 0"),
    row(204, "phase", Kind::Enumeration(&units::PHASE),
        Access::Integer { value: Machine::phase, depends: at_once(EVERYTHING) },
        "Law that the mass moves under at present"),
    count(205, "impact.count", |machine| clamp_count(machine.simulation().impact_count()),
        "Impacts since the start: upward crossings of the clearance with contact, and rebounds at a rigid stop that stands there"),
    discrete(207, "impact.time", real(&units::TIME),
        (|machine| machine.last_impact().time, |of| of.impact_time),
        "Time of the last impact, exact whatever the communication step; 0 before the first one"),
    discrete(208, "impact.velocity", nominal(real(&units::VELOCITY), 10.0),
        (|machine| machine.last_impact().velocity, |of| of.impact_velocity),
        "Velocity just before the last impact; 0 before the first one"),
    count(206, "pierce.count", |machine| clamp_count(machine.simulation().pierce_count()),
        "Strips pierced through since the start"),
    continuous(209, "energy.mechanical", nominal(real(&units::ENERGY), 100.0), after(STORES),
        (|machine| machine.energy().mechanical, |of| of.mechanical),
        &[|machine| machine.rates().mechanical.0, |machine| machine.rates().mechanical.1],
        "Kinetic energy and energy of the springs, that of a loaded stop included"),
    continuous(210, "energy.supplied", nominal(real(&units::ENERGY), 100.0), after(&[]),
        (|machine| machine.energy().supplied, |of| of.supplied),
        &[|machine| machine.rates().supplied.0, |machine| machine.rates().supplied.1],
        "Work of the drive, of the external force and of tuning since the start"),
    continuous(211, "energy.dissipated", nominal(real(&units::ENERGY), 100.0), after(&[]),
        (|machine| machine.energy().dissipated, |of| of.dissipated),
        &[|machine| machine.rates().dissipated.0, |machine| machine.rates().dissipated.1],
        "Energy lost to damping, friction, forming and impacts on rigid stops since the start"),
];
