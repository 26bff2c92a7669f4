//! Machines spread about a nominal one, as makers and wear leave them: does the z = 1 motion that goes on from the
//! nominal machine's still exist there, is it stable, and how hard does it strike?
//!
//! A [`ToleranceBox`] makes machines from coordinates: 0 is the nominal one, -1 and 1 are the bounds of each. [`along`]
//! follows the motion on a straight way out from the nominal machine, to the first fold, flip or grazing; that is what
//! it means to go on. A [`Surrogate`] knows some of these motions and tells in a step or two of Newton's method what
//! becomes of any other machine between the bounds.

mod homotopy;
mod normal;
mod polynomial_model;
mod return_map;
mod surrogate;

pub use homotopy::{Reached, along};
pub use normal::{critical_normal, free_normal, in_coordinates, varied};
pub use polynomial_model::PolynomialModel;
pub use return_map::Settled;
pub use surrogate::{MotionOutcome, Surrogate, is_inside};

use std::fmt::Debug;

use softstop::Scene;

/// Machines spread about a nominal one.
pub trait ToleranceBox: Debug + Sync {
    /// How many coordinates there are.
    fn dimensions(&self) -> usize;

    /// The machine at some coordinates, its drive included: the nominal one at 0; between -1 and 1 in each lie those that
    /// are within the bounds. It need not be valid.
    fn scene(&self, at: &[f64]) -> Scene;

    /// The coordinates of a machine that is built, from ones that are spread evenly between -1 and 1: these, unless the
    /// spread says otherwise.
    fn draw(&self, even: &[f64]) -> Vec<f64> {
        even.to_vec()
    }
}
