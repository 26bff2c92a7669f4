//! What starts lead to.

use serde::Deserialize;
use softstop::Machine;
use softstop_dynamics::basin::{BasinOptions, find_basins};
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::{Axis, Grid};

use crate::answer::{Answer, Answered, kind};
use crate::diagram::WATCHED;

/// Some rows of a plane of starts, which are in the middles of its cells.
#[derive(Debug, Deserialize)]
pub(crate) struct Basin {
    /// Half-size of the plane.
    reach: [f64; 2],
    /// Its columns and rows.
    cells: [usize; 2],
    /// First row, and the one after the last; the lowest velocity is in row 0.
    rows: [usize; 2],
    /// Drive periods after which a motion that has not settled is looked at, and followed on if it settles slowly.
    periods: u64,
}

impl Basin {
    /// The kind of each motion in three numbers, row by row.
    pub(crate) fn answer(&self, machine: &Machine) -> Answered {
        let [x, v] = self.reach;
        let edge = |row: usize| v * (2.0 * row as f64 / self.cells[1] as f64 - 1.0);
        let [first, end] = self.rows;
        let grid = Grid::of_states(
            Axis::position(-x, x, self.cells[0]),
            Axis::velocity(edge(first), edge(end), end - first),
            machine.scene.excitation.phase,
        );
        let options = BasinOptions {
            transient: self.periods,
            longest: WATCHED as usize / 2,
        };
        let basins = find_basins(&machine.scene, &grid, &options, &unmonitored, None);
        let basins = basins.map_err(|error| error.to_string())?;
        let kinds = basins.classes.iter().map(|class| kind(&class.motion));
        let kinds: Vec<[f64; 3]> = kinds.collect();
        let cells = basins.cells.iter();
        let numbers = cells.flat_map(|class| kinds[usize::from(*class)]);
        Ok(Answer::new(&(), numbers.collect()))
    }
}
