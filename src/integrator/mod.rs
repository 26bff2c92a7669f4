//! The exact integrator: from crossing to crossing.

mod advance;
mod clock;
mod force;
mod hum;
mod landing;
mod motion;
mod observer;
mod simulation;

pub use clock::{Clock, Instant};
pub use motion::{Motion, Start};
pub use observer::{Arc, Crossing, CrossingKind, Observer};
pub use simulation::{Energy, Impact, Sample, Simulation};
