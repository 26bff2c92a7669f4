//! The parameters of the stops.

use softstop_fmi::variable::Kind;

use super::rows::{LARGE, Row, bare, fixed, nominal, shown_in, tunable, within};
use crate::start::slot::{self, SLOPES};
use crate::units;

const DEFLECTION: Kind = within(&units::LENGTH, 0.0, LARGE);
const SLOPE: Kind = within(&units::STIFFNESS, 0.0, LARGE);

/// How many elements of the arrays of slopes are in use.
const fn count(min: i32) -> Kind {
    let max = Some(SLOPES as i32);
    Kind::Count { min, max }
}

/// The force laws.
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
];

/// The force laws of the stop below.
#[rustfmt::skip]
pub(super) const LAWS_BELOW: &[Row] = &[
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
];

/// The slopes of a stop: its name and words, the references of the first number of slopes and of the first of the four lists of
/// eight, the slots of both numbers.
macro_rules! slopes {
    ($stop:literal, $words:literal, $counts:expr, $first:expr, $loading:expr, $unloading:expr) => {
        slopes!(1 2 3 4 5 6 7 8; $stop, $words, $counts, $first, $loading, $unloading)
    };
    ($($number:literal)*; $stop:literal, $words:literal, $counts:expr, $first:expr, $loading:expr, $unloading:expr) => { &[
        fixed($counts, concat!($stop, ".loading.count"), $loading, count(1),
            concat!("Number of slopes of the ", $words, " on the way forward; further elements are ignored")),
        $(fixed($first - 1 + $number, concat!($stop, ".loading.from[", $number, "]"), $loading.element($number), DEFLECTION,
            concat!("Deflection of the ", $words, " from which this slope holds on the way forward; 0 for the first, rising")),)*
        $(fixed($first + 7 + $number, concat!($stop, ".loading.stiffness[", $number, "]"), $loading.element(SLOPES + $number), SLOPE,
            concat!("Stiffness of the ", $words, " in this slope on the way forward")),)*
        fixed($counts + 1, concat!($stop, ".unloading.count"), $unloading, count(0),
            concat!("Number of slopes of the ", $words, " on the way back; 0: the same as on the way forward")),
        $(fixed($first + 15 + $number, concat!($stop, ".unloading.from[", $number, "]"), $unloading.element($number), DEFLECTION,
            concat!("Deflection of the ", $words, " from which this slope holds on the way back; 0 for the first, rising")),)*
        $(fixed($first + 23 + $number, concat!($stop, ".unloading.stiffness[", $number, "]"), $unloading.element(SLOPES + $number), SLOPE,
            concat!("Stiffness of the ", $words, " in this slope on the way back; nowhere with a higher force than on the way forward")),)*
    ] };
}

/// The slopes of the stop.
#[rustfmt::skip]
pub(super) const SLOPES_ABOVE: &[Row] =
    slopes!("stop", "piecewise linear stop", 23, 32, slot::LOADING_COUNT, slot::UNLOADING_COUNT);

/// The slopes of the stop below.
#[rustfmt::skip]
pub(super) const SLOPES_BELOW: &[Row] = slopes!(
    "stop.below", "piecewise linear stop below", 118, 120, slot::BELOW_LOADING_COUNT, slot::BELOW_UNLOADING_COUNT
);

/// The rigid stop behind another one.
#[rustfmt::skip]
pub(super) const RIGID: &[Row] = &[
    fixed(21, "rigid.present", slot::RIGID_PRESENT, Kind::Boolean,
        "A rigid stop stands behind the stop; ignored if stop.model is none or rigid"),
    fixed(22, "rigid.travel", slot::RIGID_TRAVEL, within(&units::LENGTH, 0.0, LARGE),
        "Travel e from the stop to the rigid one behind it"),
];
