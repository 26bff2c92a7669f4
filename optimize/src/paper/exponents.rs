//! To be written.

use super::{Detail, Drawn, Figure};
use crate::failure::Failure;

/// Lyapunov exponent under the diagram.
pub(super) const FIGURE: Figure = Figure {
    title: "Lyapunov exponent under the diagram",
    files: &["exponents.svg", "exponents.csv"],
    draw,
};

fn draw(_: Detail) -> Result<Drawn, Failure> {
    Err(Failure::usage("not drawn yet"))
}
