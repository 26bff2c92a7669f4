//! The grid of initial states whose basins are found.

use serde::{Deserialize, Serialize};

use super::axis::{Axis, AxisQuantity};
use softstop::Start;

/// A grid of cells in a plane of initial states; cell `row * across.cells + column`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    /// The axis of the columns.
    pub across: Axis,
    /// The axis of the rows.
    pub up: Axis,
    /// State at all cells, as far as no axis says otherwise.
    pub state: Start,
    /// Drive angle in rad at time 0, as far as no axis says otherwise.
    pub angle: f64,
}

impl Grid {
    /// A grid of positions and velocities at a drive angle in rad.
    pub const fn of_states(across: Axis, up: Axis, angle: f64) -> Self {
        let state = Start::REST;
        Self {
            across,
            up,
            state,
            angle,
        }
    }

    /// Number of cells of the grid.
    pub fn cell_count(&self) -> usize {
        self.across.cells * self.up.cells
    }

    /// The initial state of a cell of the grid, and its drive angle in rad.
    pub fn start_of_cell(&self, cell: usize) -> (Start, f64) {
        let (mut state, mut angle) = (self.state, self.angle);
        let places = [
            (&self.across, cell % self.across.cells),
            (&self.up, cell / self.across.cells),
        ];
        for (axis, place) in places {
            let value = axis.value_at(place);
            match axis.quantity {
                AxisQuantity::Position => state.position = value,
                AxisQuantity::Velocity => state.velocity = value,
                AxisQuantity::Angle => angle = value,
            }
        }
        (state, angle)
    }
}
