//! Inputs and the parameters of oscillator, strip and start.

use super::rows::{LARGE, SMALL, fixed, nominal, shown_in, tunable, within};
use crate::start::Slot;
use crate::units;
use crate::variables::{Access, Kind, Variable};

/// The inputs.
pub(super) const INPUTS: &[Variable] = &[
    Variable {
        reference: 100,
        name: "force",
        description: "Further external force on the mass; with its derivatives of order 1 to 7 it goes on as a polynomial until it is set anew, which sets them to zero",
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
];

/// The oscillator and its drive.
pub(super) const OSCILLATOR: &[Variable] = &[
    fixed(
        0,
        "mass",
        Slot::MASS,
        within(&units::MASS, SMALL, LARGE),
        "Mass m",
    ),
    fixed(
        1,
        "stiffness",
        Slot::STIFFNESS,
        within(&units::STIFFNESS, 0.0, LARGE),
        "Stiffness k1 of the suspension",
    ),
    fixed(
        2,
        "damping",
        Slot::DAMPING,
        within(&units::DAMPING, 0.0, LARGE),
        "Viscous damping b1 of the motion without contact",
    ),
    tunable(
        3,
        "excitation.amplitude",
        Slot::AMPLITUDE,
        within(&units::FORCE, 0.0, LARGE),
        "Amplitude F0 of the drive F0 cos(w t + phi)",
    ),
    tunable(
        4,
        "excitation.frequency",
        Slot::FREQUENCY,
        within(&units::ANGULAR_FREQUENCY, SMALL, LARGE),
        "Angular frequency w of the drive; when it is tuned, the drive angle goes on without a jump",
    ),
    fixed(
        5,
        "excitation.phase",
        Slot::DRIVE_PHASE,
        shown_in(within(&units::ANGLE, -LARGE, LARGE), "deg"),
        "Drive angle phi at time 0",
    ),
    tunable(
        6,
        "clearance",
        Slot::CLEARANCE,
        nominal(within(&units::LENGTH, -LARGE, LARGE), 10.0),
        "Clearance r: contact begins at this position; negative means interference. It cannot be tuned such that a rigid stop would stand before the mass",
    ),
];

/// The strip, the state at the start, and the damping that both stop and strip bring.
pub(super) const STRIP_AND_START: &[Variable] = &[
    fixed(
        11,
        "piercing.stiffness",
        Slot::PIERCING_STIFFNESS,
        within(&units::STIFFNESS, 0.0, LARGE),
        "Stiffness k2 of the forming force in the strip",
    ),
    fixed(
        12,
        "piercing.friction",
        Slot::PIERCING_FRICTION,
        within(&units::STIFFNESS, 0.0, LARGE),
        "Stiffness k3 of the dry friction in the strip",
    ),
    fixed(
        13,
        "piercing.thickness",
        Slot::PIERCING_THICKNESS,
        within(&units::LENGTH, 0.0, LARGE),
        "Thickness s of the strip; with piercing.travel = 0 as well there is no piercing at all",
    ),
    fixed(
        14,
        "piercing.travel",
        Slot::PIERCING_TRAVEL,
        within(&units::LENGTH, 0.0, LARGE),
        "Travel v from the pierced strip to the stop",
    ),
    fixed(
        15,
        "initial.position",
        Slot::INITIAL_POSITION,
        nominal(within(&units::LENGTH, -LARGE, LARGE), 10.0),
        "Position at the start time; not beyond a rigid stop",
    ),
    fixed(
        16,
        "initial.velocity",
        Slot::INITIAL_VELOCITY,
        nominal(within(&units::VELOCITY, -LARGE, LARGE), 10.0),
        "Velocity at the start time",
    ),
    fixed(
        7,
        "contact.damping",
        Slot::CONTACT_DAMPING,
        within(&units::DAMPING, 0.0, LARGE),
        "Total viscous damping b while bodies touch (position above the clearance); it replaces the damping b1 there",
    ),
];
