//! What starts lead to.

use serde::Deserialize;
use softstop::{Machine, Start};

use crate::answer::{Answer, Answered, kind};
use crate::diagram::{Patience, motion_of};

/// Some rows of a plane of starts, which are in the middles of its cells.
#[derive(Debug, Deserialize)]
pub(crate) struct Basin {
    /// Half-size of the plane.
    reach: [f64; 2],
    /// Its columns and rows.
    cells: [usize; 2],
    /// First row, and the one after the last; the lowest velocity is in row 0.
    rows: [usize; 2],
    #[serde(flatten)]
    patience: Patience,
}

impl Basin {
    /// The kind of each motion in three numbers, row by row.
    pub(crate) fn answer(&self, machine: &Machine) -> Answered {
        let scene = &machine.scene;
        let place = |axis: usize, cell: usize| {
            let share = (cell as f64 + 0.5) / self.cells[axis] as f64;
            self.reach[axis] * (2.0 * share - 1.0)
        };
        let row = |row| {
            (0..self.cells[0])
                .map(move |column| (scene, Start::new(place(0, column), place(1, row))))
        };
        let motions: Vec<_> = (self.rows[0]..self.rows[1]).flat_map(row).collect();
        let seen = self.patience.follow(&motions);
        let kinds = seen.iter().flat_map(|seen| kind(&motion_of(scene, seen)));
        Ok(Answer::new(&(), kinds.collect()))
    }
}
