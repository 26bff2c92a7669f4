//! To be written.

use super::{Detail, Drawn, Figure};
use crate::failure::Failure;

/// From a soft to a rigid stop.
pub(super) const FIGURE: Figure = Figure {
    title: "From a soft to a rigid stop",
    files: &["hardening.svg", "hardening.csv"],
    draw,
};

fn draw(_: Detail) -> Result<Drawn, Failure> {
    Err(Failure::usage("not drawn yet"))
}
