//! Inputs and the parameters of oscillator, strip and start.

use softstop_fmi::variable::{Access, Kind};

use super::rows::{LARGE, Row, SMALL, bare, fixed, nominal, row, shown_in, tunable, within};
use crate::signal;
use crate::start::slot;
use crate::units;

/// The inputs.
#[rustfmt::skip]
pub(super) const INPUTS: &[Row] = &[
    row(100, "force", within(&units::FORCE, -LARGE, LARGE), Access::Signal(signal::FORCE),
        "Further external force on the mass; with its derivatives of order 1 to 7 it goes on as a polynomial until it is set anew, which sets them to zero"),
    row(101, "material", Kind::Boolean, Access::Input(slot::MATERIAL),
        "A strip is fed; taken over when the mass next crosses the clearance upward. Without it the piercing phases fall away, the stop stays where it is"),
    row(106, "material_real", bare(0.0, 1.0), Access::Input(slot::MATERIAL_SHARE),
        "The same for masters that know Real inputs only: without a strip below 0.5. A strip is fed if neither of both says no"),
    row(102, "base.acceleration", within(&units::ACCELERATION, -LARGE, LARGE), Access::Signal(signal::BASE),
        "Acceleration of the frame: position, velocity and acceleration of the mass are those beside the frame. With derivatives as for force"),
];

/// The oscillator and its drive.
#[rustfmt::skip]
pub(super) const OSCILLATOR: &[Row] = &[
    fixed(0, "mass", slot::MASS, within(&units::MASS, SMALL, LARGE),
        "Mass m"),
    fixed(1, "stiffness", slot::STIFFNESS, within(&units::STIFFNESS, 0.0, LARGE),
        "Stiffness k1 of the suspension"),
    fixed(2, "damping", slot::DAMPING, within(&units::DAMPING, 0.0, LARGE),
        "Viscous damping b1 of the motion without contact"),
    tunable(fixed(3, "excitation.amplitude", slot::AMPLITUDE, within(&units::FORCE, 0.0, LARGE),
        "Amplitude F0 of the drive F0 cos(w t + phi)")),
    tunable(fixed(4, "excitation.frequency", slot::FREQUENCY, shown_in(within(&units::ANGULAR_FREQUENCY, SMALL, LARGE), "Hz"),
        "Angular frequency w of the drive; when it is tuned, the drive angle goes on without a jump")),
    fixed(5, "excitation.phase", slot::DRIVE_PHASE, shown_in(within(&units::ANGLE, -LARGE, LARGE), "deg"),
        "Drive angle phi at time 0"),
    tunable(fixed(6, "clearance", slot::CLEARANCE, nominal(within(&units::LENGTH, -LARGE, LARGE), 10.0),
        "Clearance r: contact begins at this position; negative means interference. It cannot be tuned such that a rigid stop would stand before the mass")),
];

/// The strip, the state at the start, and the damping that both stop and strip bring.
#[rustfmt::skip]
pub(super) const STRIP_AND_START: &[Row] = &[
    fixed(11, "piercing.stiffness", slot::PIERCING_STIFFNESS, within(&units::STIFFNESS, 0.0, LARGE),
        "Stiffness k2 of the forming force in the strip"),
    fixed(12, "piercing.friction", slot::PIERCING_FRICTION, within(&units::STIFFNESS, 0.0, LARGE),
        "Stiffness k3 of the dry friction in the strip"),
    fixed(13, "piercing.thickness", slot::PIERCING_THICKNESS, shown_in(within(&units::LENGTH, 0.0, LARGE), "mm"),
        "Thickness s of the strip; with piercing.travel = 0 as well there is no piercing at all"),
    fixed(14, "piercing.travel", slot::PIERCING_TRAVEL, shown_in(within(&units::LENGTH, 0.0, LARGE), "mm"),
        "Travel v from the pierced strip to the stop"),
    fixed(15, "initial.position", slot::INITIAL_POSITION, nominal(within(&units::LENGTH, -LARGE, LARGE), 10.0),
        "Position at the start time; not beyond a rigid stop"),
    fixed(16, "initial.velocity", slot::INITIAL_VELOCITY, nominal(within(&units::VELOCITY, -LARGE, LARGE), 10.0),
        "Velocity at the start time"),
    fixed(7, "contact.damping", slot::CONTACT_DAMPING, within(&units::DAMPING, 0.0, LARGE),
        "Total viscous damping b while bodies touch (position above the clearance); it replaces the damping b1 there"),
];
