//! What the sibling crates need of the engine's inside: phases, courses, guards. No promise is made of it.

pub mod samples;
pub mod scenes;

pub use crate::budget;
pub use crate::error_message::{did_you_mean, plain_number, rpm_value_hint};
pub use crate::events::{Guard, NextEvent, first_crossing};
pub use crate::expression::{Differentiated, Expression, chain_rule_product};
pub use crate::flow::{
    ArcSolution, Departure, LinearLaw, Modes, Polynomial, PowerLaw, RECIPROCALS,
};
pub use crate::integrator::{
    Evaluations, MAX_RESTITUTION, Motion, PhaseTracker, WorkShares, work, work_shares,
};
pub use crate::largest_value::{highest_point, largest_value};
pub use crate::machine::{nearest_name, with_near_word};
pub use crate::phases::{Beyond, Exit, Mode, Phase, PhaseId, Phases, Surface, SurfaceId};
pub use crate::root_finding::narrow_root;
pub use crate::scene::{MAX_DAMPER_RATE, MAX_SPRING_RATE, MIN_SCALE_STIFFNESS, Scales, force_of};
pub use crate::tangent::{FrequencySensitivity, ParameterSensitivity, PhaseDerivatives, saltation};
pub use crate::trajectory::turning_points;
