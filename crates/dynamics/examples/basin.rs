//! Which starts lead to z = 1 and which to rest.

use softstop::Ratios;
use softstop_dynamics::basin::{BasinOptions, find_basins};
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::{Axis, Grid, Regime};

/// Runs the example.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = Ratios::unloaded().scene()?;
    let grid = Grid::of_states(
        Axis::position(-20.0, 10.0, 24),
        Axis::velocity(-20.0, 20.0, 24),
        0.0,
    );
    let basins = find_basins(&scene, &grid, &BasinOptions::default(), &unmonitored, None)?;
    for class in &basins.classes {
        println!("{}: {:.1} %", class.motion, 100.0 * class.share);
    }
    let (share, [low, high]) = basins.regime_share(Regime::ONE);
    assert!(0.0 < low && low < share && share < high && high < 1.0);
    Ok(())
}
