//! Which initial state leads to which motion of a design's machine.

use softstop::Dimension;
use softstop_console::interrupt;
use softstop_dynamics::attractors::{SurveyError, starting_box};
use softstop_dynamics::basin::{Options, basins};
use softstop_dynamics::{Axis, Grid, Regime};
use softstop_explore::basin::cells::color;

use super::label;
use crate::design::Design;
use crate::page::data::{Basin, BasinMotion};

/// Cells on each side.
const CELLS: usize = 64;

/// The basins over the box of starts that all commands take.
///
/// # Errors
/// [`SurveyError`] if motions cannot be computed, or the user wants to stop.
pub fn basin(design: &Design) -> Result<Basin, SurveyError> {
    let machine = &design.machine;
    let scene = &machine.scene;
    let region = starting_box(scene, &interrupt::watch)?;
    let ([left, right], [low, high]) = (region.position, region.velocity);
    let across = Axis::position(left, right, CELLS);
    let grid = Grid::states(
        across,
        Axis::velocity(low, high, CELLS),
        scene.excitation.phase,
    );
    let found = basins(scene, &grid, &Options::default(), &interrupt::watch, None)?;
    let motions = found.classes.iter().map(|class| BasinMotion {
        name: class.motion.to_string(),
        color: color(class.motion.class()).to_owned(),
        share: class.share,
        interval: class.interval,
    });
    let ball = found.largest_ball_of(Regime::ONE);
    Ok(Basin {
        x: label(machine, "initial position", "X", Dimension::Length),
        y: label(machine, "initial velocity", "X′", Dimension::Velocity),
        x_range: region.position,
        y_range: region.velocity,
        columns: CELLS,
        cells: found.cells.clone(),
        motions: motions.collect(),
        ball: ball.map(|ball| (ball.radius, ball.centre)),
        spots: vec![[design.orbit.position, design.orbit.velocity]],
    })
}
