//! The parameters of the stop below.

use softstop_fmi::variable::Kind;

use super::rows::{LARGE, Row, bare, count_of_slopes, fixed, slopes, tunable, within};
use super::stops::{DEFLECTION, SLOPE};
use crate::start::slot::{self, SLOPES};
use crate::units;

/// The force laws, up to the number of slopes.
#[rustfmt::skip]
pub(super) const LAWS: &[Row] = &[
    fixed(110, "stop.below.model", slot::BELOW_MODEL, Kind::Enumeration(&units::STOP_MODEL),
        "Force law of the stop on the other side, which is met downwards at -stop.below.clearance"),
    tunable(fixed(111, "stop.below.clearance", slot::BELOW_CLEARANCE, within(&units::LENGTH, -LARGE, LARGE),
        "Clearance of the stop below, measured downwards; the sum of both clearances must be > 0")),
    tunable(fixed(112, "stop.below.stiffness", slot::BELOW_STIFFNESS, within(&units::STIFFNESS, 0.0, LARGE),
        "Stiffness of the stop below (kelvinVoigt, hertz, preloaded); with hertz its unit is N/m^stop.below.exponent")),
    tunable(fixed(113, "stop.below.preload", slot::BELOW_PRELOAD, within(&units::FORCE, 0.0, LARGE),
        "Force of the preloaded stop below at first touch")),
    fixed(114, "stop.below.restitution", slot::BELOW_RESTITUTION, bare(0.0, 1.0),
        "Newton's coefficient of restitution of the rigid stop below"),
    fixed(115, "stop.below.release", slot::BELOW_RELEASE, Kind::Enumeration(&units::RELEASE),
        "Where the Kelvin-Voigt stop below lets go of a mass that moves back"),
    fixed(116, "stop.below.exponent", slot::BELOW_EXPONENT, bare(1.0, 20.0),
        "Exponent of the Hertz stop below, 3/2 for a sphere"),
    fixed(117, "stop.below.dissipation", slot::BELOW_DISSIPATION, within(&units::DISSIPATION, 0.0, LARGE),
        "Hunt and Crossley's dissipation factor of the Hertz stop below"),
    fixed(118, "stop.below.loading.count", slot::BELOW_LOADING_COUNT, count_of_slopes(1),
        "Number of slopes of the piecewise linear stop below on the way forward; further elements are ignored"),
];

/// Where the slopes of the way forward begin.
#[rustfmt::skip]
pub(super) const LOADING_FROM: &[Row] = slopes!(120, "stop.below.loading.from", slot::BELOW_LOADING_FROM, DEFLECTION,
    "Deflection of the piecewise linear stop below from which this slope holds on the way forward; 0 for the first, rising");

/// The slopes of the way forward.
#[rustfmt::skip]
pub(super) const LOADING_STIFFNESS: &[Row] = slopes!(128, "stop.below.loading.stiffness", slot::BELOW_LOADING_STIFFNESS, SLOPE,
    "Stiffness of the piecewise linear stop below in this slope on the way forward");

/// How many slopes the way back has.
#[rustfmt::skip]
pub(super) const UNLOADING_COUNT: &[Row] = &[
    fixed(119, "stop.below.unloading.count", slot::BELOW_UNLOADING_COUNT, count_of_slopes(0),
        "Number of slopes of the piecewise linear stop below on the way back; 0: the same as on the way forward"),
];

/// Where the slopes of the way back begin.
#[rustfmt::skip]
pub(super) const UNLOADING_FROM: &[Row] = slopes!(136, "stop.below.unloading.from", slot::BELOW_UNLOADING_FROM, DEFLECTION,
    "Deflection of the piecewise linear stop below from which this slope holds on the way back; 0 for the first, rising");

/// The slopes of the way back.
#[rustfmt::skip]
pub(super) const UNLOADING_STIFFNESS: &[Row] = slopes!(144, "stop.below.unloading.stiffness", slot::BELOW_UNLOADING_STIFFNESS, SLOPE,
    "Stiffness of the piecewise linear stop below in this slope on the way back; nowhere with a higher force than on the way forward");
