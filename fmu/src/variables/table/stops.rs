//! The parameters of the stops.

use super::rows::{
    LARGE, bare, choice, fixed, flag, nominal, slope_count, slopes, tunable, within,
};
use crate::start::{SLOPES, Slot};
use crate::units;
use crate::variables::{RealKind, Variable};

const DEFLECTION: RealKind = within(&units::LENGTH, 0.0, LARGE);
const SLOPE: RealKind = within(&units::STIFFNESS, 0.0, LARGE);

/// The force laws, up to the number of slopes.
pub(super) const LAWS: &[Variable] = &[
    choice(
        8,
        "stop.model",
        Slot::STOP_MODEL,
        &units::STOP_MODEL,
        "Force law of the stop, which stands at clearance + piercing.thickness + piercing.travel",
    ),
    tunable(
        9,
        "stop.stiffness",
        Slot::STOP_STIFFNESS,
        within(&units::STIFFNESS, 0.0, LARGE),
        "Stiffness k4 of the stop (kelvinVoigt, hertz, preloaded); with hertz its unit is N/m^stop.exponent",
    ),
    tunable(
        10,
        "stop.preload",
        Slot::STOP_PRELOAD,
        nominal(within(&units::FORCE, 0.0, LARGE), 70.0),
        "Force of the preloaded stop at first touch",
    ),
    fixed(
        17,
        "stop.restitution",
        Slot::STOP_RESTITUTION,
        bare(0.0, 1.0),
        "Newton's coefficient of restitution R of the rigid stop, and of the one behind another stop",
    ),
    choice(
        18,
        "stop.release",
        Slot::STOP_RELEASE,
        &units::RELEASE,
        "Where the Kelvin-Voigt stop lets go of a mass that moves back",
    ),
    fixed(
        19,
        "stop.exponent",
        Slot::STOP_EXPONENT,
        bare(1.0, LARGE),
        "Exponent of the Hertz stop, 3/2 for a sphere",
    ),
    fixed(
        20,
        "stop.dissipation",
        Slot::STOP_DISSIPATION,
        within(&units::DISSIPATION, 0.0, LARGE),
        "Hunt and Crossley's dissipation factor of the Hertz stop",
    ),
    slope_count(
        23,
        "stop.loading.count",
        Slot::LOADING_COUNT,
        1,
        "Number of slopes of the piecewise linear stop on the way forward; further elements are ignored",
    ),
];

/// Where the slopes of the way forward begin.
pub(super) const LOADING_FROM: &[Variable] = slopes!(
    32,
    "stop.loading.from",
    Slot::LOADING_FROM,
    DEFLECTION,
    "Deflection of the piecewise linear stop from which this slope holds on the way forward; 0 for the first, rising"
);

/// The slopes of the way forward.
pub(super) const LOADING_STIFFNESS: &[Variable] = slopes!(
    40,
    "stop.loading.stiffness",
    Slot::LOADING_STIFFNESS,
    SLOPE,
    "Stiffness of the piecewise linear stop in this slope on the way forward"
);

/// How many slopes the way back has.
pub(super) const UNLOADING_COUNT: &[Variable] = &[slope_count(
    24,
    "stop.unloading.count",
    Slot::UNLOADING_COUNT,
    0,
    "Number of slopes of the piecewise linear stop on the way back; 0: the same as on the way forward",
)];

/// Where the slopes of the way back begin.
pub(super) const UNLOADING_FROM: &[Variable] = slopes!(
    48,
    "stop.unloading.from",
    Slot::UNLOADING_FROM,
    DEFLECTION,
    "Deflection of the piecewise linear stop from which this slope holds on the way back; 0 for the first, rising"
);

/// The slopes of the way back.
pub(super) const UNLOADING_STIFFNESS: &[Variable] = slopes!(
    56,
    "stop.unloading.stiffness",
    Slot::UNLOADING_STIFFNESS,
    SLOPE,
    "Stiffness of the piecewise linear stop in this slope on the way back; nowhere with a higher force than on the way forward"
);

/// The rigid stop behind another one.
pub(super) const RIGID: &[Variable] = &[
    flag(
        21,
        "rigid.present",
        Slot::RIGID_PRESENT,
        "A rigid stop stands behind the stop; ignored if stop.model is none or rigid",
    ),
    fixed(
        22,
        "rigid.travel",
        Slot::RIGID_TRAVEL,
        within(&units::LENGTH, 0.0, LARGE),
        "Travel e from the stop to the rigid one behind it",
    ),
];
