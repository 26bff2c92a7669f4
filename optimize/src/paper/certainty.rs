//! To be written.

use super::{Detail, Drawn, Figure};
use crate::failure::Failure;

/// Establishing certainty of z = 1.
pub(super) const FIGURE: Figure = Figure {
    title: "Establishing certainty of z = 1",
    files: &["certainty.svg", "certainty.csv"],
    draw,
};

fn draw(_: Detail) -> Result<Drawn, Failure> {
    Err(Failure::usage("not drawn yet"))
}
