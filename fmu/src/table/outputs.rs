//! The output variables.

use softstop::Impact;
use softstop_fmi::Clock;
use softstop_fmi::variable::{Access, Kind};

use super::rows::{Row, after, at_once, continuous, count, discrete, nominal, real, row, shown_in};
use crate::machine::Machine;
use crate::tangent::Tangent;
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

/// Derivative of the force on the frame.
fn frame_force(of: &Tangent) -> f64 {
    let (scene, of) = (of.machine.simulation().scene(), &of.exact);
    scene.stiffness * of.position + scene.damping * of.velocity + of.contact_force
}

fn first_impact(machine: &Machine) -> Impact {
    machine.contacts().first.unwrap_or_default()
}

fn hardest_impact(machine: &Machine) -> Impact {
    machine.contacts().hardest.unwrap_or_default()
}

fn clamp_count(count: u64) -> i32 {
    i32::try_from(count).unwrap_or(i32::MAX)
}

fn impacts(machine: &Machine) -> i32 {
    clamp_count(machine.simulation().impact_count())
}

/// All that decides on the force and the acceleration at the start.
#[rustfmt::skip]
const EVERYTHING: &[&str] = &[
    "mass", "stiffness", "damping", "excitation.amplitude", "excitation.frequency", "excitation.phase",
    "clearance", "contact.damping", "stop.model", "stop.stiffness", "stop.preload", "stop.release",
    "stop.exponent", "stop.dissipation", "stop.loading.count", "stop.loading.from",
    "stop.loading.stiffness", "stop.unloading.count", "stop.unloading.from", "stop.unloading.stiffness",
    "rigid.present", "rigid.travel", "piercing.stiffness", "piercing.friction", "piercing.thickness",
    "piercing.travel", "initial.position", "initial.velocity", "force", "base.acceleration", "drive.amplitude",
    "drive.takes.speed", "drive.takes.amplitude", "material", "material_real", "stop.below.model",
    "stop.below.clearance", "stop.below.stiffness", "stop.below.preload", "stop.below.release",
    "stop.below.exponent", "stop.below.dissipation", "stop.below.loading.count", "stop.below.loading.from",
    "stop.below.loading.stiffness", "stop.below.unloading.count", "stop.below.unloading.from",
    "stop.below.unloading.stiffness",
];

/// What the energy stored at the start depends on.
#[rustfmt::skip]
const STORES: &[&str] = &[
    "mass", "stiffness", "clearance", "stop.model", "stop.stiffness", "stop.preload", "stop.exponent",
    "stop.loading.count", "stop.loading.from", "stop.loading.stiffness", "stop.unloading.count",
    "stop.unloading.from", "stop.unloading.stiffness", "piercing.thickness", "piercing.travel",
    "initial.position", "initial.velocity", "stop.below.model", "stop.below.clearance", "stop.below.stiffness",
    "stop.below.preload", "stop.below.exponent", "stop.below.loading.count", "stop.below.loading.from",
    "stop.below.loading.stiffness", "stop.below.unloading.count", "stop.below.unloading.from",
    "stop.below.unloading.stiffness",
];

/// The clock of impacts.
pub(crate) const IMPACT: Clock<Machine> = Clock {
    reference: 250,
    name: "impact",
    description: "Ticks in the event mode of an impact, until the update of discrete states that brings the state after it",
    count: impacts,
};

/// The outputs.
#[rustfmt::skip]
pub(super) const OUTPUTS: &[Row] = &[
    continuous(203, "contact.force", shown_in(nominal(real(&units::FORCE), 10.0), "kN"), at_once(EVERYTHING),
        (|machine| machine.sample().contact_force, |of, output| of.along(|of| of.exact.contact_force, output)),
        &[|machine| machine.rates().contact_force.0, |machine| machine.rates().contact_force.1],
        "Force of stop and strip on the mass: F in m (x'' + base.acceleration) + b1 x' + k1 x + F = F0 cos(w t + phi) + force. Positive where it presses against positive x, negative where a stop below presses; it includes the additional damping in contact. While the phase is resting it is what holds the mass, while it is chatter the mean over the bounces"),
    discrete(217, "contact.peak", shown_in(nominal(real(&units::FORCE), 10.0), "kN"), (|machine| machine.contacts().peak, |of, output| of.along(|of| of.exact.peak, output)),
        "Largest contact.force in the last step, found between its ends, of a stop below by its size; at least 0, the blow of a rigid stop left out"),
    discrete(218, "contact.impulse", nominal(real(&units::IMPULSE), 10.0), (|machine| machine.contacts().impulse, |of, output| of.along(|of| of.exact.impulse, output)),
        "Integral of contact.force over the last step, the blows of a rigid stop included"),
    continuous(216, "frame.force", shown_in(nominal(real(&units::FORCE), 10.0), "kN"), at_once(EVERYTHING),
        (|machine| machine.frame_force().0, |of, output| of.along(frame_force, output)),
        &[|machine| machine.frame_force().1, |machine| machine.frame_force().2],
        "Force of suspension, dampers, strip and stop on the frame, k1 x + b1 x' + contact.force"),
    continuous(200, "position", nominal(real(&units::LENGTH), 10.0), after(&["initial.position"]),
        (|machine| machine.sample().position, |of, output| of.along(|of| of.exact.position, output)), &[velocity, acceleration],
        "Position of the mass"),
    continuous(201, "velocity", nominal(real(&units::VELOCITY), 10.0), after(&["initial.velocity"]),
        (velocity, |of, output| of.along(|of| of.exact.velocity, output)), &[acceleration, jerk],
        "Velocity of the mass"),
    continuous(202, "acceleration", nominal(real(&units::ACCELERATION), 10.0), at_once(EVERYTHING),
        (acceleration, |of, output| of.along(|of| of.exact.acceleration, output)), &[jerk, |machine| machine.rates().snap],
        "Acceleration of the mass; while the phase is chatter the mean over the bounces, 0"),
    row(204, "phase", Kind::Enumeration(&units::PHASE),
        Access::Integer { value: Machine::phase, depends: at_once(EVERYTHING) },
        "Law that the mass moves under at present"),
    count(205, "impact.count", impacts,
        "Impacts since the start: upward crossings of the clearance with contact, and rebounds at a rigid stop that stands there; and those on a stop below"),
    discrete(207, "impact.time", real(&units::TIME),
        (|machine| machine.last_impact().time, |of, output| of.along(|of| of.exact.impact_time, output)),
        "Time of the last impact, exact whatever the communication step; 0 before the first one"),
    discrete(208, "impact.velocity", nominal(real(&units::VELOCITY), 10.0),
        (|machine| machine.last_impact().velocity, |of, output| of.along(|of| of.exact.impact_velocity, output)),
        "Velocity just before the last impact, towards the stop; 0 before the first one"),
    count(219, "impact.step.count", |machine| clamp_count(machine.contacts().impacts),
        "Impacts in the last step"),
    discrete(220, "impact.step.first.time", real(&units::TIME), (|machine| first_impact(machine).time, |of, output| of.along(|of| of.exact.first.time, output)),
        "Time of the first impact in the last step; 0 without one"),
    discrete(221, "impact.step.first.velocity", nominal(real(&units::VELOCITY), 10.0), (|machine| first_impact(machine).velocity, |of, output| of.along(|of| of.exact.first.velocity, output)),
        "Velocity just before the first impact in the last step; 0 without one"),
    discrete(222, "impact.step.hardest.time", real(&units::TIME), (|machine| hardest_impact(machine).time, |of, output| of.along(|of| of.exact.hardest.time, output)),
        "Time of the impact with the highest velocity in the last step; 0 without one"),
    discrete(223, "impact.step.hardest.velocity", nominal(real(&units::VELOCITY), 10.0), (|machine| hardest_impact(machine).velocity, |of, output| of.along(|of| of.exact.hardest.velocity, output)),
        "Velocity just before the hardest impact in the last step; 0 without one"),
    count(225, "impact.below.count", |machine| clamp_count(machine.simulation().impact_count_below()),
        "Impacts on the stop below since the start, of those that impact.count counts"),
    count(206, "pierce.count", |machine| clamp_count(machine.simulation().pierce_count()),
        "Strips pierced through since the start"),
    count(224, "pierce.step.count", |machine| clamp_count(machine.contacts().pierced),
        "Strips pierced through in the last step"),
    continuous(209, "energy.mechanical", nominal(real(&units::ENERGY), 100.0), after(STORES),
        (|machine| machine.energy().mechanical, |of, output| of.along(|of| of.exact.mechanical, output)),
        &[|machine| machine.rates().mechanical.0, |machine| machine.rates().mechanical.1],
        "Kinetic energy and energy of the springs, that of a loaded stop included"),
    continuous(210, "energy.supplied", nominal(real(&units::ENERGY), 100.0), after(&[]),
        (|machine| machine.energy().supplied, |of, output| of.along(|of| of.exact.supplied, output)),
        &[|machine| machine.rates().supplied.0, |machine| machine.rates().supplied.1],
        "Work of the drive, of the external force, of the moving frame and of tuning since the start"),
    continuous(211, "energy.dissipated", nominal(real(&units::ENERGY), 100.0), after(&[]),
        (|machine| machine.energy().dissipated, |of, output| of.along(|of| of.exact.dissipated, output)),
        &[|machine| machine.rates().dissipated.0, |machine| machine.rates().dissipated.1],
        "Energy lost to damping, friction, forming and impacts on rigid stops since the start"),
];
