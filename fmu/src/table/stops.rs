//! The parameters of the stops.

use softstop_fmi::variable::Kind;

use super::rows::{
    LARGE, Row, bare, count_of_slopes, fixed, nominal, shown_in, slopes, tunable, within,
};
use crate::start::slot::{self, SLOPES};
use crate::units;

pub(super) const DEFLECTION: Kind = within(&units::LENGTH, 0.0, LARGE);
pub(super) const SLOPE: Kind = within(&units::STIFFNESS, 0.0, LARGE);

/// The force laws, up to the number of slopes.
#[rustfmt::skip]
pub(super) const LAWS: &[Row] = &[
    fixed(8, "stop.model", slot::STOP_MODEL, Kind::Enumeration(&units::STOP_MODEL),
        "Force law of the stop, which stands at clearance + piercing.thickness + piercing.travel"),
    tunable(fixed(9, "stop.stiffness", slot::STOP_STIFFNESS, within(&units::STIFFNESS, 0.0, LARGE),
        "Stiffness k4 of the stop (kelvinVoigt, hertz, preloaded); with hertz its unit is N/m^stop.exponent")),
    tunable(fixed(10, "stop.preload", slot::STOP_PRELOAD, shown_in(nominal(within(&units::FORCE, 0.0, LARGE), 70.0), "kN"),
        "Force of the preloaded stop at first touch")),
    fixed(17, "stop.restitution", slot::STOP_RESTITUTION, bare(0.0, 1.0),
        "Newton's coefficient of restitution R of the rigid stop, and of the one behind another stop"),
    fixed(18, "stop.release", slot::STOP_RELEASE, Kind::Enumeration(&units::RELEASE),
        "Where the Kelvin-Voigt stop lets go of a mass that moves back"),
    fixed(19, "stop.exponent", slot::STOP_EXPONENT, bare(1.0, 20.0),
        "Exponent of the Hertz stop, 3/2 for a sphere"),
    fixed(20, "stop.dissipation", slot::STOP_DISSIPATION, within(&units::DISSIPATION, 0.0, LARGE),
        "Hunt and Crossley's dissipation factor of the Hertz stop"),
    fixed(23, "stop.loading.count", slot::LOADING_COUNT, count_of_slopes(1),
        "Number of slopes of the piecewise linear stop on the way forward; further elements are ignored"),
];

/// Where the slopes of the way forward begin.
#[rustfmt::skip]
pub(super) const LOADING_FROM: &[Row] = slopes!(32, "stop.loading.from", slot::LOADING_FROM, DEFLECTION,
    "Deflection of the piecewise linear stop from which this slope holds on the way forward; 0 for the first, rising");

/// The slopes of the way forward.
#[rustfmt::skip]
pub(super) const LOADING_STIFFNESS: &[Row] = slopes!(40, "stop.loading.stiffness", slot::LOADING_STIFFNESS, SLOPE,
    "Stiffness of the piecewise linear stop in this slope on the way forward");

/// How many slopes the way back has.
#[rustfmt::skip]
pub(super) const UNLOADING_COUNT: &[Row] = &[
    fixed(24, "stop.unloading.count", slot::UNLOADING_COUNT, count_of_slopes(0),
        "Number of slopes of the piecewise linear stop on the way back; 0: the same as on the way forward"),
];

/// Where the slopes of the way back begin.
#[rustfmt::skip]
pub(super) const UNLOADING_FROM: &[Row] = slopes!(48, "stop.unloading.from", slot::UNLOADING_FROM, DEFLECTION,
    "Deflection of the piecewise linear stop from which this slope holds on the way back; 0 for the first, rising");

/// The slopes of the way back.
#[rustfmt::skip]
pub(super) const UNLOADING_STIFFNESS: &[Row] = slopes!(56, "stop.unloading.stiffness", slot::UNLOADING_STIFFNESS, SLOPE,
    "Stiffness of the piecewise linear stop in this slope on the way back; nowhere with a higher force than on the way forward");

/// The rigid stop behind another one.
#[rustfmt::skip]
pub(super) const RIGID: &[Row] = &[
    fixed(21, "rigid.present", slot::RIGID_PRESENT, Kind::Boolean,
        "A rigid stop stands behind the stop; ignored if stop.model is none or rigid"),
    fixed(22, "rigid.travel", slot::RIGID_TRAVEL, within(&units::LENGTH, 0.0, LARGE),
        "Travel e from the stop to the rigid one behind it"),
];
