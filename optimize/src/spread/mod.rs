//! Machines spread about a nominal one, as makers and wear leave them: does the z = 1 motion that goes on from the
//! nominal machine's still exist there, is it stable, and how hard does it strike?
//!
//! [`Tolerances`] make machines from coordinates: 0 is the nominal one, -1 and 1 are the bounds of each. [`along`]
//! follows the motion on a straight way out from the nominal machine, to the first fold, flip or grazing; that is what
//! it means to go on. A [`Surrogate`] knows some of these motions and tells in a step or two of Newton's method what
//! becomes of any other machine between the bounds.

mod distribution;
mod homotopy;
mod normal;
mod polynomial_model;
mod return_map;
mod surrogate;
mod tolerances;

pub use distribution::{Distribution, EVEN, FITTED, normal_quantile};
pub use homotopy::{HomotopyEnd, along, motion_of};
pub use normal::{critical_normal, free_normal, in_coordinates, varied};
pub use polynomial_model::PolynomialModel;
pub use return_map::StableMotion;
pub use surrogate::{Surrogate, is_inside};
pub use tolerances::{AbsoluteTolerance, Tolerances};
