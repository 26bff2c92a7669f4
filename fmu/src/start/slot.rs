//! Where each value is held among the start values, what it is at first, and which parameters of a scene it is.
#![expect(missing_docs, reason = "each is described in the table of variables")]

use softstop::internals::samples::LOADED;
use softstop::{Parameter, Ratios, Strip};
use softstop_fmi::variable::Slot;

use crate::units::number;

/// Slopes that a piecewise linear stop can have for each way.
pub const SLOPES: usize = 8;

/// The loaded machine with m = 1 kg, k1 = 1 N/m and F0 = 1 N, so that SI units and the paper's ratios coincide.
const RATIOS: Ratios = LOADED.ratios;
const STRIP: Strip = RATIOS.piercing.expect("the loaded machine has a strip");

macro_rules! slots {
    ($($name:ident $([$length:expr])? = $value:expr $(=> $($parameter:ident),+)?;)*) => {
        softstop_fmi::slots! { $($name $([$length])? = $value;)* }
        /// Where the parameters of a scene are held.
        pub(super) const PARAMETERS: &[(Parameter, Slot)] =
            &[$($($((Parameter::$parameter, $name),)+)?)*];
    };
}

slots! {
    MASS = 1.0 => Mass;
    STIFFNESS = 1.0 => Suspension;
    DAMPING = 2.0 * RATIOS.damping => Damping;
    AMPLITUDE = 1.0 => Amplitude;
    FREQUENCY = RATIOS.frequency => Frequency;
    DRIVE_PHASE = 0.0 => Phase;
    CLEARANCE = RATIOS.clearance => Clearance;
    CONTACT_DAMPING = 2.0 * RATIOS.contact_damping => ContactDamping;
    STOP_MODEL = number::PRELOADED as f64;
    STOP_STIFFNESS = RATIOS.stiffness => StopStiffness;
    STOP_PRELOAD = RATIOS.preload => Preload;
    STOP_RELEASE = number::CLEARANCE as f64;
    STOP_EXPONENT = 1.5 => Exponent;
    STOP_DISSIPATION = 0.0 => Dissipation;
    STOP_RESTITUTION = 0.6 => Restitution, RigidRestitution;
    LOADING_COUNT = 1.0;
    LOADING_FROM[SLOPES] = 0.0;
    LOADING_STIFFNESS[SLOPES] = RATIOS.stiffness;
    UNLOADING_COUNT = 0.0;
    UNLOADING_FROM[SLOPES] = 0.0;
    UNLOADING_STIFFNESS[SLOPES] = RATIOS.stiffness;
    RIGID_PRESENT = 1.0;
    RIGID_TRAVEL = 5.0 => RigidTravel;
    PIERCING_STIFFNESS = STRIP.stiffness => PiercingStiffness;
    PIERCING_FRICTION = STRIP.friction => PiercingFriction;
    PIERCING_THICKNESS = STRIP.thickness => Thickness;
    PIERCING_TRAVEL = STRIP.travel => Travel;
    INITIAL_POSITION = LOADED.position;
    INITIAL_VELOCITY = LOADED.velocity;
    MATERIAL = 1.0;
    TAKES_SPEED = 0.0;
    TAKES_AMPLITUDE = 0.0;
    MATERIAL_SHARE = 1.0;
    BELOW_MODEL = number::NONE as f64;
    BELOW_CLEARANCE = 10.0 => BelowClearance;
    BELOW_STIFFNESS = RATIOS.stiffness => BelowStiffness;
    BELOW_PRELOAD = RATIOS.preload => BelowPreload;
    BELOW_RELEASE = number::CLEARANCE as f64;
    BELOW_EXPONENT = 1.5 => BelowExponent;
    BELOW_DISSIPATION = 0.0 => BelowDissipation;
    BELOW_RESTITUTION = 0.6 => BelowRestitution;
    BELOW_LOADING_COUNT = 1.0;
    BELOW_LOADING_FROM[SLOPES] = 0.0;
    BELOW_LOADING_STIFFNESS[SLOPES] = RATIOS.stiffness;
    BELOW_UNLOADING_COUNT = 0.0;
    BELOW_UNLOADING_FROM[SLOPES] = 0.0;
    BELOW_UNLOADING_STIFFNESS[SLOPES] = RATIOS.stiffness;
}
