//! Exact simulation of impact oscillators with soft and preloaded stops,
//!
//! ```text
//! m x'' + b1 x' + k1 x + F(x, x') = F0 cos(w t + phi) + f(t)        (Peterka 2003, eq. 8)
//! ```
//!
//! - A machine: [`Scene`] is plain data in SI units, [`CheckedScene`] one that is valid and stays so, [`Ratios`] the
//!   paper's dimensionless figures, [`Machine`] a scene as a file or a command line states it, in its own units.
//!   [`Parameter`] names every number of them.
//! - A motion: [`Scene::trajectory`] keeps it whole ([`Trajectory`]); a [`Simulation`] runs on, takes inputs and
//!   new parameters, and can be kept as a [`Snapshot`]. Both are exact: a closed form in each phase, and a proof
//!   that no crossing is missed.
//! - Whoever watches a motion, and stops it, is an [`Observer`]: [`Tangent`] gathers its Jacobian, [`Effort`] limits
//!   what it may cost. [`Simulation::sensitivity`] and [`Simulation::rates`] say how the outputs change.
//!
//! Enumerations and records that will grow are `non_exhaustive`; [`Stop`], [`PhaseKind`], [`CrossingKind`] and
//! [`UnitSystem`] are not, so that a match says what a new law asks for. Periodic motions and all that follows from
//! them are in the crate `softstop-dynamics`. What this crate's siblings share beyond this page is in
//! `softstop::internals`, hidden and without any promise.
//!
//! ```
//! use softstop::{Ratios, Start};
//!
//! let scene = Ratios::unloaded().scene()?;
//! let motion = scene.trajectory(Start::new(0.0, 14.0), 1000)?;
//! let last = motion.impacts().last().expect("it strikes in every period");
//! assert!((last.before_impact_velocity - 6.494_627_429_363).abs() < 1e-10);
//! assert!(motion.energy_defect().abs() < 1e-11 * motion.work().supplied);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

#[doc(hidden)]
pub mod budget;
mod checked_scene;
mod error;
mod error_message;
mod events;
mod expression;
mod flow;
mod integrator;
#[doc(hidden)]
pub mod internals;
mod largest_value;
mod machine;
mod phases;
mod root_finding;
mod scene;
mod tangent;
mod trajectory;

pub use checked_scene::CheckedScene;
pub use error::{MachineError, MotionError, SceneError};
pub use flow::{DriveAngle, HIGHEST_ORDER};
pub use integrator::{
    Arc, Clock, Contacts, Crossing, CrossingKind, Effort, Energy, Impact, InitialConditions,
    Instant, Observer, Rate, Rates, Sample, Simulation, Snapshot, Start, Work,
};
pub use machine::{Machine, UnitSystem};
pub use phases::PhaseKind;
pub use scene::{
    Allowed, Below, Dimension, Excitation, Parameter, ParameterInfo, Ratios, Release, RigidStop,
    Scene, Slope, Stop, Strip, Ties, Units, Wall,
};
pub use tangent::{Perturbation, Sensitivity, Tangent};
pub use trajectory::{AppliedForce, ImpactEvent, KeptArc, Trajectory};

pub use nalgebra;

/// The README, which runs as printed.
#[cfg(doctest)]
#[doc = include_str!("README.md")]
mod readme {}
