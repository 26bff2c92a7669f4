//! The exact motion inside one phase.
//!
//! Every linear phase obeys x'' + 2 a x' + b x = p(t) + A cos(angle + w t). [`LinearLaw`] holds a, b, A and w and what
//! can be computed once; a [`ArcSolution`] is one motion along it. Three evaluations share the work, each where it is
//! free of cancellation: a Taylor series for short times, the particular solution plus the free modes for ordinary
//! ones, and zero-state responses by doubling where the particular solution blows up. They answer a forcing p = c + r t.
//! Under a [`Polynomial`] of higher degree, and in a phase with a power law ([`PowerLaw`]), the motion is followed in
//! Taylor steps, each a course of its own.

mod arc_solution;
mod change_near_start;
mod chatter;
mod choose_power_law_step;
mod convergence_reach;
mod departure;
mod doubled_response;
mod drive_angle;
mod free_motion;
mod gauss_quadrature;
mod linear_law;
mod paired_products;
mod parameter_response;
mod particular_solution;
mod polynomial;
mod power_law;
mod scan_nodes;
mod series;
mod slow_manifold;
mod taylor_polynomials;
mod taylor_step;
mod taylor_step_in_regularized_time;
mod taylor_step_in_time;
mod taylor_step_on_sphere;
mod variation;
mod variational_equation;
mod work_integrals;
mod zero_state_responses;

pub use arc_solution::ArcSolution;
pub(crate) use chatter::{Chatter, PressingForces};
pub use departure::Departure;
pub use drive_angle::DriveAngle;
pub use free_motion::Modes;
pub(crate) use gauss_quadrature::integrate;
pub use linear_law::LinearLaw;
pub(crate) use parameter_response::{ForceBasis, ForceCoefficients, StateAndSupply};
pub use polynomial::{HIGHEST_ORDER, Polynomial};
pub use power_law::PowerLaw;
pub use scan_nodes::ScanNode;
pub(crate) use scan_nodes::ScanWindow;
pub(crate) use series::derivative;
pub use taylor_polynomials::RECIPROCALS;
pub(crate) use taylor_polynomials::{DEGREE, TaylorPolynomials, value, value_and_rate};
pub(crate) use taylor_step::{FinePosition, TaylorStep};
pub(crate) use variation::{Transition, Variation};
