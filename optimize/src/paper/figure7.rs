//! To be written.

use super::{Detail, Drawn, Figure};
use crate::failure::Failure;

/// Point A: the unloaded machine.
pub(super) const POINT_A: Figure = Figure {
    title: "Point A: the unloaded machine",
    files: &["figure-7a.svg", "figure-7a.csv"],
    draw,
};

/// Point B: the loaded machine.
pub(super) const POINT_B: Figure = Figure {
    title: "Point B: the loaded machine",
    files: &["figure-7b.svg", "figure-7b.csv"],
    draw,
};

fn draw(_: Detail) -> Result<Drawn, Failure> {
    Err(Failure::usage("not drawn yet"))
}
