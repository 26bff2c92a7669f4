//! Periodic motions of impact oscillators and what becomes of them: [`orbit`] (z = p/n, Floquet
//! multipliers, exponents) → [`continuation`] (branches, folds, flips, grazings) → [`zone`] (where
//! impacts and rest coexist) → [`settled`], [`attractors`], [`basin`], [`sweep`] (what is seen from many starts),
//! told in one vocabulary ([`motion_kind`]). What a machine does in service: [`figure`] (their names), [`cycle_metrics`]
//! (figures of a period), [`missing_strips`] (strips that fail to come), [`run_up`] (from rest to work).
//!
//! Records and errors that will grow are `non_exhaustive`; options, which a user fills in, and the enumerations that say
//! what a motion or an end is, are not, so that a match says what a new one asks for.
//!
//! What they all speak of stands at the root; the rest is where it is computed. Work that may be long takes a
//! [`monitor::Monitor`], [`monitor::unmonitored`] if nobody looks on.
//!
//! ```
//! use softstop::Ratios;
//! use softstop_dynamics::{Orbit, Zone, orbit, zone};
//!
//! let scene = Ratios::unloaded().scene()?;
//! let orbit: Orbit = orbit::find(&scene)?;
//! assert_eq!(orbit.regime().to_string(), "1");
//! let zone: Zone = zone::hysteresis(&scene)?;
//! assert!((zone.high.frequency - 1.369_036).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

pub mod attractors;
pub mod basin;
pub mod continuation;
pub mod cycle_metrics;
pub mod derivatives;
mod direction;
mod ensemble;
mod extremes;
pub mod figure;
mod memory;
mod missed_strokes;
pub mod missing_strips;
pub mod monitor;
mod monitored_batch;
pub mod motion_kind;
pub mod orbit;
pub mod parallel;
mod record_trajectory;
pub mod run_up;
pub mod settled;
mod solve_linear;
pub mod spread_points;
pub mod sweep;
mod tolerance;
mod wilson_interval;
pub mod zone;

pub use attractors::Survey;
pub use basin::{Axis, Basins, Grid};
pub use continuation::{Branch, BranchLimits, BranchPoint, Continuation, ParameterFamily};
pub use cycle_metrics::CycleMetrics;
pub use derivatives::OrbitDerivatives;
pub use direction::Direction;
pub use motion_kind::MotionKind;
pub use orbit::{LyapunovExponents, Orbit, Regime, StroboscopicMap};
pub use sweep::{Chain, Plan, SweepStep};
pub use zone::Zone;

/// What sibling crates share beyond this page, without any promise.
#[doc(hidden)]
pub mod internals {
    pub use crate::continuation::period_map::advance_in_period;
    pub use crate::cycle_metrics::peak_contact_force;
    pub use crate::ensemble::{Ensemble, HasMember, Member};
    pub use crate::orbit::regime::ImpactCounter;
    pub use crate::spread_points::evenly_spread_point;
    pub use crate::zone::FrequencyFamily;
    pub use crate::zone::end_of_followed_branch::{LONGEST_BRANCH, find_end};
}

pub use nalgebra;
pub use softstop;

/// The tutorial in Rust, which runs as printed.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/tutorials/rust.md")]
mod guide {}

/// The README, which runs as printed.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
