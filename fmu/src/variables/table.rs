//! The table itself.

use super::{Access, Dependencies, Kind, RealKind, Variable, View, phase_number};
use crate::start::Slot;
use crate::units::{self, Quantity};

/// A number far above any machine's, below which no intermediate result overflows.
const LARGE: f64 = 1e12;
/// Stands for "greater than zero" in ranges that the standard can only close.
const SMALL: f64 = 1e-12;

const fn real(quantity: &'static Quantity) -> RealKind {
    RealKind {
        quantity,
        display_unit: None,
        min: None,
        max: None,
        nominal: None,
    }
}

const fn within(quantity: &'static Quantity, min: f64, max: f64) -> RealKind {
    RealKind {
        min: Some(min),
        max: Some(max),
        ..real(quantity)
    }
}

const fn nominal(kind: RealKind, nominal: f64) -> RealKind {
    RealKind {
        nominal: Some(nominal),
        ..kind
    }
}

const fn shown_in(kind: RealKind, unit: &'static str) -> RealKind {
    RealKind {
        display_unit: Some(unit),
        ..kind
    }
}

const fn fixed(
    reference: u32,
    name: &'static str,
    slot: Slot,
    kind: RealKind,
    description: &'static str,
) -> Variable {
    Variable {
        reference,
        name,
        description,
        kind: Kind::Real(kind),
        access: Access::Parameter {
            slot,
            tunable: false,
        },
    }
}

const fn tunable(
    reference: u32,
    name: &'static str,
    slot: Slot,
    kind: RealKind,
    description: &'static str,
) -> Variable {
    Variable {
        access: Access::Parameter {
            slot,
            tunable: true,
        },
        ..fixed(reference, name, slot, kind, description)
    }
}

const fn continuous(
    reference: u32,
    name: &'static str,
    kind: RealKind,
    value: fn(&View) -> f64,
    derivatives: &'static [fn(&View) -> f64],
    depends: Dependencies,
    description: &'static str,
) -> Variable {
    Variable {
        reference,
        name,
        description,
        kind: Kind::Real(kind),
        access: Access::Continuous {
            value,
            derivatives,
            depends,
        },
    }
}

const fn discrete(
    reference: u32,
    name: &'static str,
    kind: RealKind,
    value: fn(&View) -> f64,
    description: &'static str,
) -> Variable {
    Variable {
        reference,
        name,
        description,
        kind: Kind::Real(kind),
        access: Access::Discrete(value),
    }
}

const fn count(
    reference: u32,
    name: &'static str,
    value: fn(&View) -> i32,
    description: &'static str,
) -> Variable {
    Variable {
        reference,
        name,
        description,
        kind: Kind::Count,
        access: Access::Integer {
            value,
            depends: after(&[]),
        },
    }
}

/// Dependencies of an output that follows the motion only: no input changes it at once.
const fn after(initial: &'static [&'static str]) -> Dependencies {
    Dependencies {
        inputs: &[],
        initial,
    }
}

/// Dependencies of an output that the external force changes at once.
const fn at_once(initial: &'static [&'static str]) -> Dependencies {
    Dependencies {
        inputs: &["force"],
        initial,
    }
}

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
    "piercing.stiffness",
    "piercing.friction",
    "piercing.thickness",
    "piercing.travel",
    "initial.position",
    "initial.velocity",
    "force",
];

/// What the energy stored at the start depends on.
const STORES: &[&str] = &[
    "mass",
    "stiffness",
    "clearance",
    "stop.model",
    "stop.stiffness",
    "stop.preload",
    "piercing.thickness",
    "piercing.travel",
    "initial.position",
    "initial.velocity",
];

/// All variables, in the order of the XML.
pub static VARIABLES: &[Variable] = &[
    fixed(
        0,
        "mass",
        Slot::Mass,
        within(&units::MASS, SMALL, LARGE),
        "Mass m",
    ),
    fixed(
        1,
        "stiffness",
        Slot::Stiffness,
        within(&units::STIFFNESS, 0.0, LARGE),
        "Stiffness k1 of the suspension",
    ),
    fixed(
        2,
        "damping",
        Slot::Damping,
        within(&units::DAMPING, 0.0, LARGE),
        "Viscous damping b1 of the motion without contact",
    ),
    tunable(
        3,
        "excitation.amplitude",
        Slot::Amplitude,
        within(&units::FORCE, 0.0, LARGE),
        "Amplitude F0 of the drive F0 cos(w t + phi)",
    ),
    tunable(
        4,
        "excitation.frequency",
        Slot::Frequency,
        within(&units::ANGULAR_FREQUENCY, SMALL, LARGE),
        "Angular frequency w of the drive; when it is tuned, the drive angle goes on without a jump",
    ),
    fixed(
        5,
        "excitation.phase",
        Slot::DrivePhase,
        shown_in(within(&units::ANGLE, -LARGE, LARGE), "deg"),
        "Drive angle phi at time 0",
    ),
    tunable(
        6,
        "clearance",
        Slot::Clearance,
        nominal(within(&units::LENGTH, -LARGE, LARGE), 10.0),
        "Clearance r: contact begins at this position; negative means interference",
    ),
    fixed(
        7,
        "contact.damping",
        Slot::ContactDamping,
        within(&units::DAMPING, 0.0, LARGE),
        "Total viscous damping b while bodies touch (position above the clearance); it replaces the damping b1 there",
    ),
    Variable {
        reference: 8,
        name: "stop.model",
        description: "Force law of the stop, which stands at clearance + piercing.thickness + piercing.travel",
        kind: Kind::Enumeration(&units::STOP_MODEL),
        access: Access::Parameter {
            slot: Slot::StopModel,
            tunable: false,
        },
    },
    tunable(
        9,
        "stop.stiffness",
        Slot::StopStiffness,
        within(&units::STIFFNESS, 0.0, LARGE),
        "Stiffness k4 of the stop",
    ),
    tunable(
        10,
        "stop.preload",
        Slot::StopPreload,
        nominal(within(&units::FORCE, 0.0, LARGE), 70.0),
        "Force of the preloaded stop at first touch",
    ),
    fixed(
        11,
        "piercing.stiffness",
        Slot::PiercingStiffness,
        within(&units::STIFFNESS, 0.0, LARGE),
        "Stiffness k2 of the forming force in the strip",
    ),
    fixed(
        12,
        "piercing.friction",
        Slot::PiercingFriction,
        within(&units::STIFFNESS, 0.0, LARGE),
        "Stiffness k3 of the dry friction in the strip",
    ),
    fixed(
        13,
        "piercing.thickness",
        Slot::PiercingThickness,
        within(&units::LENGTH, 0.0, LARGE),
        "Thickness s of the strip; with piercing.travel = 0 as well there is no piercing at all",
    ),
    fixed(
        14,
        "piercing.travel",
        Slot::PiercingTravel,
        within(&units::LENGTH, 0.0, LARGE),
        "Travel v from the pierced strip to the stop",
    ),
    fixed(
        15,
        "initial.position",
        Slot::InitialPosition,
        nominal(within(&units::LENGTH, -LARGE, LARGE), 10.0),
        "Position at the start time",
    ),
    fixed(
        16,
        "initial.velocity",
        Slot::InitialVelocity,
        nominal(within(&units::VELOCITY, -LARGE, LARGE), 10.0),
        "Velocity at the start time",
    ),
    Variable {
        reference: 100,
        name: "force",
        description: "Further external force on the mass; with its derivative of order 1 it goes on linearly until it is set anew",
        kind: Kind::Real(within(&units::FORCE, -LARGE, LARGE)),
        access: Access::Force,
    },
    Variable {
        reference: 101,
        name: "material",
        description: "A strip is fed; taken over when the mass next crosses the clearance upward. Without it the piercing phases fall away, the stop stays where it is",
        kind: Kind::Boolean,
        access: Access::Material,
    },
    continuous(
        200,
        "position",
        nominal(real(&units::LENGTH), 10.0),
        position,
        &[velocity, acceleration],
        after(&["initial.position"]),
        "Position of the mass",
    ),
    continuous(
        201,
        "velocity",
        nominal(real(&units::VELOCITY), 10.0),
        velocity,
        &[acceleration, jerk],
        after(&["initial.velocity"]),
        "Velocity of the mass",
    ),
    continuous(
        202,
        "acceleration",
        nominal(real(&units::ACCELERATION), 10.0),
        acceleration,
        &[jerk],
        at_once(EVERYTHING),
        "Acceleration of the mass",
    ),
    continuous(
        203,
        "contact.force",
        nominal(real(&units::FORCE), 10.0),
        |view| view.sample().contact_force,
        &[],
        at_once(EVERYTHING),
        "Force of stop and strip on the mass: F in m x'' + b1 x' + k1 x + F = F0 cos(w t + phi) + force. Positive in compression (against positive x); it includes the additional damping in contact",
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
        "Upward crossings of the clearance with contact since the start",
    ),
    count(
        206,
        "pierce.count",
        |view| clamp_count(view.simulation.pierce_count()),
        "Strips pierced through since the start",
    ),
    discrete(
        207,
        "impact.time",
        real(&units::TIME),
        |view| {
            view.simulation
                .last_impact()
                .map_or(0.0, |impact| impact.time)
        },
        "Time of the last impact, exact whatever the communication step; 0 before the first one",
    ),
    discrete(
        208,
        "impact.velocity",
        nominal(real(&units::VELOCITY), 10.0),
        |view| {
            view.simulation
                .last_impact()
                .map_or(0.0, |impact| impact.velocity)
        },
        "Velocity just before the last impact; 0 before the first one",
    ),
    continuous(
        209,
        "energy.mechanical",
        nominal(real(&units::ENERGY), 100.0),
        |view| view.energy().mechanical,
        &[],
        after(STORES),
        "Kinetic energy and energy of the springs, that of a loaded stop included",
    ),
    continuous(
        210,
        "energy.supplied",
        nominal(real(&units::ENERGY), 100.0),
        |view| view.energy().supplied,
        &[],
        after(&[]),
        "Work of the drive, of the external force and of tuning since the start",
    ),
    continuous(
        211,
        "energy.dissipated",
        nominal(real(&units::ENERGY), 100.0),
        |view| view.energy().dissipated,
        &[],
        after(&[]),
        "Energy lost to damping, friction and forming since the start",
    ),
];
