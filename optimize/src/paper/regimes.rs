//! To be written.

use super::{Detail, Drawn, Figure};
use crate::failure::Failure;

/// Regimes over eta and rho.
pub(super) const FIGURE: Figure = Figure {
    title: "Regimes over eta and rho",
    files: &["regimes.png", "regimes.csv"],
    draw,
};

fn draw(_: Detail) -> Result<Drawn, Failure> {
    Err(Failure::usage("not drawn yet"))
}
