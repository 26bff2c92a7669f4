//! The outputs.

use super::rows::{after, at_once, continuous, count, discrete, nominal, real};
use crate::units;
use crate::variables::{Access, Kind, Variable, View, phase_number};

fn clamp_count(count: u64) -> i32 {
    i32::try_from(count).unwrap_or(i32::MAX)
}

fn position(view: &View) -> f64 {
    view.sample().position
}

fn velocity(view: &View) -> f64 {
    view.sample().velocity
}

fn acceleration(view: &View) -> f64 {
    view.sample().acceleration
}

fn jerk(view: &View) -> f64 {
    view.sample().jerk
}

/// All that decides on the force and the acceleration at the start.
const EVERYTHING: &[&str] = &[
    "mass",
    "stiffness",
    "damping",
    "excitation.amplitude",
    "excitation.frequency",
    "excitation.phase",
    "clearance",
    "contact.damping",
    "stop.model",
    "stop.stiffness",
    "stop.preload",
    "stop.release",
    "stop.exponent",
    "stop.dissipation",
    "stop.loading.count",
    "stop.loading.from",
    "stop.loading.stiffness",
    "stop.unloading.count",
    "stop.unloading.from",
    "stop.unloading.stiffness",
    "rigid.present",
    "rigid.travel",
    "piercing.stiffness",
    "piercing.friction",
    "piercing.thickness",
    "piercing.travel",
    "initial.position",
    "initial.velocity",
    "force",
    "material",
];

/// What the energy stored at the start depends on.
const STORES: &[&str] = &[
    "mass",
    "stiffness",
    "clearance",
    "stop.model",
    "stop.stiffness",
    "stop.preload",
    "stop.exponent",
    "stop.loading.count",
    "stop.loading.from",
    "stop.loading.stiffness",
    "stop.unloading.count",
    "stop.unloading.from",
    "stop.unloading.stiffness",
    "piercing.thickness",
    "piercing.travel",
    "initial.position",
    "initial.velocity",
];

/// The outputs.
pub(super) const OUTPUTS: &[Variable] = &[
    continuous(
        203,
        "contact.force",
        nominal(real(&units::FORCE), 10.0),
        (|view| view.sample().contact_force, |of| of.contact_force),
        &[
            |view| view.rates().contact_force.0,
            |view| view.rates().contact_force.1,
        ],
        at_once(EVERYTHING),
        "Force of stop and strip on the mass: F in m x'' + b1 x' + k1 x + F = F0 cos(w t + phi) + force. Positive in compression (against positive x); it includes the additional damping in contact. While the phase is resting it is what holds the mass, while it is chatter the mean over the bounces",
    ),
    continuous(
        200,
        "position",
        nominal(real(&units::LENGTH), 10.0),
        (position, |of| of.position),
        &[velocity, acceleration],
        after(&["initial.position"]),
        "Position of the mass",
    ),
    continuous(
        201,
        "velocity",
        nominal(real(&units::VELOCITY), 10.0),
        (velocity, |of| of.velocity),
        &[acceleration, jerk],
        after(&["initial.velocity"]),
        "Velocity of the mass",
    ),
    continuous(
        202,
        "acceleration",
        nominal(real(&units::ACCELERATION), 10.0),
        (acceleration, |of| of.acceleration),
        &[jerk, |view| view.rates().snap],
        at_once(EVERYTHING),
        "Acceleration of the mass; while the phase is chatter the mean over the bounces, 0",
    ),
    Variable {
        reference: 204,
        name: "phase",
        description: "Law that the mass moves under at present",
        kind: Kind::Enumeration(&units::PHASE),
        access: Access::Integer {
            value: |view| phase_number(view.sample().phase),
            depends: at_once(EVERYTHING),
        },
    },
    count(
        205,
        "impact.count",
        |view| clamp_count(view.simulation.impact_count()),
        "Impacts since the start: upward crossings of the clearance with contact, and rebounds at a rigid stop that stands there",
    ),
    discrete(
        207,
        "impact.time",
        real(&units::TIME),
        (
            |view| {
                view.simulation
                    .last_impact()
                    .map_or(0.0, |impact| impact.time)
            },
            |of| of.impact_time,
        ),
        "Time of the last impact, exact whatever the communication step; 0 before the first one",
    ),
    discrete(
        208,
        "impact.velocity",
        nominal(real(&units::VELOCITY), 10.0),
        (
            |view| {
                view.simulation
                    .last_impact()
                    .map_or(0.0, |impact| impact.velocity)
            },
            |of| of.impact_velocity,
        ),
        "Velocity just before the last impact; 0 before the first one",
    ),
    count(
        206,
        "pierce.count",
        |view| clamp_count(view.simulation.pierce_count()),
        "Strips pierced through since the start",
    ),
    continuous(
        209,
        "energy.mechanical",
        nominal(real(&units::ENERGY), 100.0),
        (|view| view.energy().mechanical, |of| of.mechanical),
        &[
            |view| view.rates().mechanical.0,
            |view| view.rates().mechanical.1,
        ],
        after(STORES),
        "Kinetic energy and energy of the springs, that of a loaded stop included",
    ),
    continuous(
        210,
        "energy.supplied",
        nominal(real(&units::ENERGY), 100.0),
        (|view| view.energy().supplied, |of| of.supplied),
        &[
            |view| view.rates().supplied.0,
            |view| view.rates().supplied.1,
        ],
        after(&[]),
        "Work of the drive, of the external force and of tuning since the start",
    ),
    continuous(
        211,
        "energy.dissipated",
        nominal(real(&units::ENERGY), 100.0),
        (|view| view.energy().dissipated, |of| of.dissipated),
        &[
            |view| view.rates().dissipated.0,
            |view| view.rates().dissipated.1,
        ],
        after(&[]),
        "Energy lost to damping, friction, forming and impacts on rigid stops since the start",
    ),
];
