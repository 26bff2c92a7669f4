//! What moves where: motions in the cells of a map.

use softstop_dynamics::basin::find_largest_ball;
use softstop_dynamics::motion::MotionClass;
use softstop_dynamics::{Axis, Grid, MotionKind};

use super::Map;

/// Radius of a place, in units of half the map, that has room for its name.
const WIDE: f64 = 0.09;

/// Cells over frequency and clearance.
pub(super) struct RegimeMap<'a> {
    /// What was asked for.
    pub(super) asked: &'a Map,
    /// Cells in a row.
    pub(super) columns: usize,
    /// The cells, row by row, the lowest row first.
    pub(super) cells: Vec<MotionKind>,
}

impl RegimeMap<'_> {
    /// Share of the cells that belong to a class.
    pub(super) fn share(&self, class: MotionClass) -> f64 {
        let own = self.cells.iter().filter(|cell| cell.class() == class);
        own.count() as f64 / self.cells.len() as f64
    }

    /// The middle of the widest place of a class, if that is wide.
    pub(super) fn widest(&self, class: MotionClass) -> Option<(f64, f64)> {
        let rows = self.cells.len() / self.columns;
        let [eta, rho] = self.asked.window;
        let grid = Grid::of_states(
            Axis::position(eta.0, eta.1, self.columns),
            Axis::velocity(rho.0, rho.1, rows),
            0.0,
        );
        let ball = find_largest_ball(&grid, |cell| self.cells[cell].class() == class)?;
        (ball.radius > WIDE).then_some((ball.centre[0], ball.centre[1]))
    }
}
