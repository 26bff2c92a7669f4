//! Units, with their base units, and the named types of the variables.

use softstop_fmi::{Enumeration, Quantity, item};

pub(crate) use softstop_fmi::si::*;

/// All quantities in use, each with a unit of its own.
pub(crate) static QUANTITIES: &[&Quantity] = &[
    &MASS,
    &STIFFNESS,
    &DAMPING,
    &FORCE,
    &LENGTH,
    &VELOCITY,
    &ACCELERATION,
    &ANGULAR_FREQUENCY,
    &ANGLE,
    &TIME,
    &DISSIPATION,
    &ENERGY,
    &POWER,
    &IMPULSE,
];

/// Numbers of `stop.model` and `stop.release`.
pub(crate) mod number {
    pub(crate) const NONE: i32 = 1;
    pub(crate) const KELVIN_VOIGT: i32 = 2;
    pub(crate) const PIECEWISE_LINEAR: i32 = 3;
    pub(crate) const HERTZ: i32 = 4;
    pub(crate) const PRELOADED: i32 = 5;
    pub(crate) const RIGID: i32 = 6;

    pub(crate) const CLEARANCE: i32 = 1;
    pub(crate) const ZERO_FORCE: i32 = 2;
}

/// The type of `stop.model`; d is the deflection from the stop's face, v the velocity.
#[rustfmt::skip]
pub(crate) static STOP_MODEL: Enumeration = Enumeration {
    type_name: "StopModel",
    description: "Force law of the stop",
    items: &[
        item(number::NONE, "none", "no stop"),
        item(number::KELVIN_VOIGT, "kelvinVoigt", "spring stop.stiffness * d beside the damper contact.damping"),
        item(number::PIECEWISE_LINEAR, "piecewiseLinear", "chain of the slopes stop.loading, on the way back of the slopes stop.unloading"),
        item(number::HERTZ, "hertz", "stop.stiffness * d^stop.exponent * max(0, 1 + stop.dissipation * v)"),
        item(number::PRELOADED, "preloaded", "linear spring that is preloaded against its seat: the force jumps to the preload at first touch"),
        item(number::RIGID, "rigid", "gives way nowhere: the mass leaves with -stop.restitution times its velocity"),
    ],
};

/// The type of `stop.release`.
#[rustfmt::skip]
pub(crate) static RELEASE: Enumeration = Enumeration {
    type_name: "StopRelease",
    description: "Where a Kelvin-Voigt stop lets go of a mass that moves back",
    items: &[
        item(number::CLEARANCE, "clearance", "at the face of the stop: before, the damper may pull"),
        item(number::ZERO_FORCE, "zeroForce", "where spring and damper together cease to press: contact never pulls"),
    ],
};

/// The type of `phase`.
#[rustfmt::skip]
pub(crate) static PHASE: Enumeration = Enumeration {
    type_name: "Phase",
    description: "Law that the mass moves under",
    items: &[
        item(1, "free", "no contact"),
        item(2, "pierce", "phase I: the strip is pressed and cut into"),
        item(3, "cut", "phase II: travel through the cut strip"),
        item(4, "gap", "beyond the clearance without a strip, before the stop"),
        item(5, "stop", "contact with the stop"),
        item(6, "stuck", "held at rest by dry friction"),
        item(7, "resting", "held at rest at the face of a preloaded or rigid stop"),
        item(8, "released", "beyond the face of the stop, where the stop would have to pull"),
        item(9, "chatter", "ever faster bounces on a rigid stop that end in rest after a finite time"),
    ],
};

/// All enumeration types.
pub(crate) static ENUMERATIONS: &[&Enumeration] = &[&STOP_MODEL, &RELEASE, &PHASE];
