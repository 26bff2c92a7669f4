//! An axis of the grid of initial states.

use serde::{Deserialize, Serialize};

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
    /// An axis of positions in m.
    pub const fn position(from: f64, to: f64, cells: usize) -> Self {
        Self {
            quantity: AxisQuantity::Position,
            range: [from, to],
            cells,
        }
    }

    /// An axis of velocities in m/s.
    pub const fn velocity(from: f64, to: f64, cells: usize) -> Self {
        Self {
            quantity: AxisQuantity::Velocity,
            range: [from, to],
            cells,
        }
    }

    /// An axis of drive angles in rad.
    pub const fn angle(from: f64, to: f64, cells: usize) -> Self {
        Self {
            quantity: AxisQuantity::Angle,
            range: [from, to],
            cells,
        }
    }

    /// The value at the middle of a cell of the axis.
    pub fn value_at(&self, cell: usize) -> f64 {
        let [from, to] = self.range;
        from + (cell as f64 + 0.5) / self.cells as f64 * (to - from)
    }

    /// Length of a cell in units of half the axis.
    pub(super) fn cell_length(&self) -> f64 {
        2.0 / self.cells as f64
    }
}
