//! To be written.

use super::{Detail, Drawn, Figure};
use crate::failure::Failure;

/// Basins of attraction.
pub(super) const FIGURE: Figure = Figure {
    title: "Basins of attraction",
    files: &["basins.png", "basins.csv"],
    draw,
};

fn draw(_: Detail) -> Result<Drawn, Failure> {
    Err(Failure::usage("not drawn yet"))
}
