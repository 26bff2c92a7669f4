//! All basins on a grid, and for how long its motions are followed.

use serde::Serialize;

use super::Grid;
use crate::attractors::Attractor;
use crate::orbit::Regime;
use crate::wilson_interval::wilson_interval;

/// All basins on a grid: the attractors, and which of them each cell settles on.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Basins {
    /// Where the cells lie.
    pub grid: Grid,
    /// The attractors on which the cells' motions settle: periodic motions by period, impacts and hardest impact; then rest,
    /// chaos (nothing that returns, with a positive exponent), what is unsettled, and what is lost.
    pub classes: Vec<Attractor>,
    /// The basin of each cell, row by row.
    pub cells: Vec<u16>,
    /// Why the first of the cells that are lost could not be computed.
    pub lost: Option<String>,
}

impl Basins {
    /// Share of the grid's cells whose motions settle in a regime, and its 95 % interval.
    pub fn regime_share(&self, regime: Regime) -> (f64, [f64; 2]) {
        let classes = self.classes.iter();
        let own = classes.filter(|class| class.motion.regime() == Some(regime));
        let cells = own.map(|class| class.starts).sum();
        let all = self.cells.len();
        (cells as f64 / all as f64, wilson_interval(cells, all))
    }
}

/// Options of a survey of basins: how long the motions of a grid's cells are followed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BasinOptions {
    /// Drive periods after which a motion that no ball holds is classified by its log, or followed on if it settles slowly.
    pub transient: u64,
    /// Longest period looked for, in drive periods.
    pub longest: usize,
}

impl Default for BasinOptions {
    fn default() -> Self {
        Self {
            transient: 512,
            longest: 64,
        }
    }
}
