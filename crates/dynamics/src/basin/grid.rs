//! The grid of initial states whose basins are found, and its axes.

use serde::{Deserialize, Serialize};

use softstop::Start;

/// A grid of cells in a plane of initial states; the cells are numbered row by row, `row * across.cells + column`.
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

    /// The initial state in the middle of a cell, and its drive angle in rad.
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

/// The quantity along an axis of the grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AxisQuantity {
    /// Position in m.
    Position,
    /// Velocity in m/s.
    Velocity,
    /// Drive angle in rad.
    Angle,
}

/// An axis of the grid, cut into cells of equal length.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// The quantity along the axis.
    pub quantity: AxisQuantity,
    /// Where the first cell begins and the last one ends.
    pub range: [f64; 2],
    /// Number of cells.
    pub cells: usize,
}

impl Axis {
    const fn along(quantity: AxisQuantity, range: [f64; 2], cells: usize) -> Self {
        Self {
            quantity,
            range,
            cells,
        }
    }

    /// An axis of positions in m.
    pub const fn position(from: f64, to: f64, cells: usize) -> Self {
        Self::along(AxisQuantity::Position, [from, to], cells)
    }

    /// An axis of velocities in m/s.
    pub const fn velocity(from: f64, to: f64, cells: usize) -> Self {
        Self::along(AxisQuantity::Velocity, [from, to], cells)
    }

    /// An axis of drive angles in rad.
    pub const fn angle(from: f64, to: f64, cells: usize) -> Self {
        Self::along(AxisQuantity::Angle, [from, to], cells)
    }

    /// The value at the middle of a cell of the axis.
    pub fn value_at(&self, cell: usize) -> f64 {
        let [from, to] = self.range;
        from + (cell as f64 + 0.5) / self.cells as f64 * (to - from)
    }

    /// Length of a cell of the axis, in units of half the axis.
    pub(super) fn cell_length(&self) -> f64 {
        2.0 / self.cells as f64
    }
}
