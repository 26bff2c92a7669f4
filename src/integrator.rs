//! The exact integrator: from crossing to crossing.

mod advance;
mod bounce_train;
mod checkpoint;
mod clock;
mod contacts;
mod effort;
mod external_force;
mod motion;
mod observer;
mod outputs;
mod phase_tracker;
mod reset;
mod restart;
mod set_state;
mod simulation;
mod snapshot;
mod start;
mod stop_at_crossing;
mod tallies;
mod work;

pub use clock::{Clock, Instant};
pub use contacts::Contacts;
pub(crate) use contacts::contact_peak;
pub use effort::{Effort, Evaluations};
pub(crate) use external_force::force_from_derivatives;
pub use motion::Motion;
pub use observer::{Arc, Crossing, CrossingKind, Impact, Observer};
pub use outputs::{Energy, Rate, Rates, Sample};
pub use phase_tracker::PhaseTracker;
pub use reset::MAX_RESTITUTION;
pub use simulation::Simulation;
pub use snapshot::Snapshot;
pub use start::{InitialConditions, Start};
pub use work::{Work, WorkShares, mechanical_energy, work, work_shares};
