//! Exact simulation of impact oscillators with soft and preloaded stops,
//!
//! ```text
//! m x'' + b1 x' + k1 x + F(x, x') = F0 cos(w t + phi) + f(t)        (Peterka 2003, eq. 8)
//! ```
//!
//! The data flows through the modules in this order: [`scene`] (plain data) → [`phases`] (the few
//! smooth laws that a scene can reach) → [`flow`] (closed form per phase) → [`events`] (first
//! crossing, guaranteed) → [`integrator`] (the loop) → [`trajectory`], with its derivatives in [`tangent`].
//! Periodic motions and all that follows from them are in the crate `softstop-dynamics`.
//!
//! ```
//! use softstop::{Ratios, Start};
//!
//! let scene = Ratios::unloaded().scene()?;
//! let motion = scene.trajectory(Start { position: 0.0, velocity: 14.0 }, 1000)?;
//! let last = motion.impacts().last().expect("it strikes in every period");
//! assert!((last.before_impact_velocity - 6.494_627_429_363).abs() < 1e-10);
//! assert!(motion.energy_defect().abs() < 1e-11 * motion.work.supplied);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

pub mod error;
pub mod events;
pub mod flow;
pub mod integrator;
pub mod machine;
pub mod phases;
pub mod root;
pub mod samples;
pub mod scene;
pub mod tangent;
pub mod trajectory;

pub use error::{MachineError, MotionError, SceneError};
pub use integrator::{Clock, Energy, Impact, Instant, Motion, Sample, Simulation, Snapshot, Start};
pub use machine::{Language, Machine};
pub use phases::PhaseKind;
pub use scene::{
    Dimension, Excitation, Parameter, Piercing, PiercingRatios, Ratios, Scene, Stop, Units,
};
pub use trajectory::Trajectory;

pub use nalgebra;
