//! The exact integrator: from crossing to crossing.

mod advance;
mod clock;
mod effort;
mod energy;
mod evaluations;
mod force;
mod hum;
mod landing;
mod mark;
mod motion;
mod observer;
mod outputs;
mod rates;
mod resume;
mod simulation;
mod snapshot;
mod start;
mod stretch;
mod tallies;
mod walk;
mod work;

pub use clock::{Clock, Instant};
pub use effort::Effort;
pub use energy::mechanical_energy;
pub use evaluations::Evaluations;
pub use motion::Motion;
pub use observer::{Arc, Crossing, CrossingKind, Observer};
pub use outputs::{Energy, Impact, Sample};
pub use rates::{Rate, Rates};
pub use simulation::{Begin, Simulation};
pub use snapshot::Snapshot;
pub use start::Start;
pub use walk::Walk;
pub use work::{Shares, Work, shares, work};
