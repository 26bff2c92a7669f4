//! Basins of attraction: on which motion each of many initial states settles.
//!
//! The cells of a [`Grid`] lie on a plane of position, velocity and drive angle, any two of them. Each cell's motion is
//! first brought to drive angle phi, then followed in the lanes of the batch engine, a few drive periods at a time. It
//! has arrived once its state lies in a ball about a point of a known stable orbit in which the map contracts: in a
//! norm in which the orbit's own Jacobian does, the Jacobian at all of many points of the ball stays below 1, with the
//! orbit's number of impacts. What is not caught by any ball is looked at one by one: a state that returns is polished
//! by Newton's method and is a new motion; what does not is followed on if its exponents are negative, for as long as ten
//! digits take; what never returns belongs to one set, chaos.
//!
//! The result depends on scene, grid and options alone, not on the number of threads.
//!
//! ```
//! use softstop::Ratios;
//! use softstop_dynamics::basin::{Axis, Grid, BasinOptions, find_basins};
//! use softstop_dynamics::monitor::unmonitored;
//!
//! let scene = Ratios::unloaded().scene()?;
//! let grid = Grid::of_states(Axis::position(-20.0, 10.0, 30), Axis::velocity(-25.0, 25.0, 30), 0.0);
//! let basins = find_basins(&scene, &grid, &BasinOptions::default(), &unmonitored, None)?;
//! // Point A: without impacts, and z = 1.
//! let names: Vec<String> = basins.classes.iter().map(|class| class.motion.to_string()).collect();
//! assert_eq!(names, ["z = 0", "z = 1"]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod basin_test;
mod bring_to_section;
mod certainty;
mod classify_cells;
mod contraction_ball;
mod entropy;
mod erosion_profile;
mod establishment;
mod global_continuation;
mod grid;
mod largest_ball;
mod settle_cells;
mod start_balls;
mod survey;

pub use crate::wilson_interval::wilson_interval;
pub(crate) use basin_test::TestedMotion;
pub use basin_test::{BasinTest, SLOW_DECAY};
pub(crate) use bring_to_section::bring_to_section;
pub use certainty::{CertaintyAtPlace, establishing_certainties};
pub use entropy::BasinEntropy;
pub use erosion_profile::{ErosionProfile, Integrity, zone_box};
pub use establishment::Establishment;
pub use global_continuation::{BasinsAt, follow_attractors};
pub use grid::{Axis, AxisQuantity, Grid};
pub use largest_ball::{BasinBall, find_largest_ball};
pub use survey::find_basins;

use serde::Serialize;

use crate::attractors::Attractor;
use crate::orbit::Regime;

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
