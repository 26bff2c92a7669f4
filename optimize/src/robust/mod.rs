//! Robust design: what tolerances do to a z = 1 motion.
//!
//! A machine is made with [`AbsoluteTolerance`]s about its design; together they are a box about it ([`Tolerances`]), in which
//! coordinates run from -1 to 1. [`nearest`] finds the nearest machine that loses the motion, [`worst`] the one with
//! the worst value of a figure, and [`verify`] looks at a million others; [`sensitivities`] and [`scatter`] tell whose
//! tolerance it is.

mod corners;
mod indices;
mod meeting;
mod nearest;
mod neighbours;
mod rates;
mod scatter;
mod screen;
mod verify;
mod worst;

pub use indices::{Estimate, SampleSize, SobolIndex, indices};
pub use meeting::{Manifold, Norm};
pub use nearest::{Nearest, nearest};
pub use scatter::{Scatter, Sensitivities, scatter, sensitivities};
pub use verify::{CaseVerdict, Verdict, VerifySettings, verify, verify_in_cases};
pub use worst::{Worst, worst};

pub use crate::spread::{
    AbsoluteTolerance, Distribution, EVEN, FITTED, Tolerances, normal_quantile,
};

pub(crate) use corners::corners;
pub(crate) use meeting::{dot, is_loss};
pub(crate) use nearest::first_losses;
pub(crate) use neighbours::Neighbours;
pub use rates::rates;
