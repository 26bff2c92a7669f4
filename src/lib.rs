//! softstop simulates impact oscillators with soft, preloaded and rigid stops exactly.
#![forbid(unsafe_code)]

pub mod continuation;
pub mod error;
pub mod events;
pub mod flow;
pub mod integrator;
pub mod orbit;
pub mod phases;
pub mod samples;
pub mod scene;
pub mod trajectory;
pub mod zone;

pub use error::{MotionError, SceneError};
pub use integrator::{Clock, Energy, Impact, Instant, Motion, Sample, Simulation, Start};
pub use phases::PhaseKind;
pub use scene::{Excitation, Piercing, PiercingRatios, Ratios, Scene, Stop, Units};
pub use trajectory::Trajectory;
