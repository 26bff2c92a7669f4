//! To be written.

use super::{Detail, Drawn, Figure};
use crate::failure::Failure;

/// Bifurcation diagram of rho = 10 with zooms.
pub(super) const FIGURE: Figure = Figure {
    title: "Bifurcation diagram of rho = 10 with zooms",
    files: &["figure-8.png", "figure-8.csv"],
    draw,
};

fn draw(_: Detail) -> Result<Drawn, Failure> {
    Err(Failure::usage("not drawn yet"))
}
