//! To be written.

use super::{Detail, Drawn, Figure};
use crate::failure::Failure;

/// Motions (A) to (L).
pub(super) const FIGURE: Figure = Figure {
    title: "Motions (A) to (L)",
    files: &["figure-9.svg", "figure-9.csv"],
    draw,
};

fn draw(_: Detail) -> Result<Drawn, Failure> {
    Err(Failure::usage("not drawn yet"))
}
