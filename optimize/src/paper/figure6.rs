//! To be written.

use super::{Detail, Drawn, Figure};
use crate::failure::Failure;

/// Bifurcation diagrams of the unloaded machine over six clearances.
pub(super) const UNLOADED: Figure = Figure {
    title: "Bifurcation diagrams of the unloaded machine over six clearances",
    files: &["figure-6a.png", "figure-6a.csv"],
    draw,
};

/// Bifurcation diagrams of the loaded machine over six clearances.
pub(super) const LOADED: Figure = Figure {
    title: "Bifurcation diagrams of the loaded machine over six clearances",
    files: &["figure-6b.png", "figure-6b.csv"],
    draw,
};

fn draw(_: Detail) -> Result<Drawn, Failure> {
    Err(Failure::usage("not drawn yet"))
}
