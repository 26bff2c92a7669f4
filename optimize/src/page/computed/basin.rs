//! Which initial state leads to which motion of a design's machine.

use softstop::Dimension;
use softstop_console::interrupt;
use softstop_dynamics::attractors::{SurveyError, starting_box};
use softstop_dynamics::basin::{Options, basins};
use softstop_dynamics::{Axis, Grid, Orbit};
use softstop_explore::palette::distinct_colors;

use super::label;
use crate::design::Design;
use crate::page::data::{Basin, BasinMotion};

/// Cells on each side.
const CELLS: usize = 64;

/// Distance of states of one motion, in units of their size.
const SAME: f64 = 1e-6;

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
    let own = found
        .classes
        .iter()
        .position(|class| is_own(class.orbit.as_deref(), &design.orbit));
    let colors = distinct_colors(found.classes.iter().map(|class| class.motion.class()));
    let classes = found.classes.iter().zip(colors).enumerate();
    let motions = classes.map(|(index, (class, color))| {
        let whose = match own == Some(index) {
            true => ", the design",
            false => "",
        };
        BasinMotion {
            name: format!("{}{whose}", class.motion),
            color,
            share: class.share,
            interval: class.interval,
        }
    });
    let ball = own.and_then(|own| found.largest_ball(own));
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

/// Whether an orbit is the design's.
fn is_own(orbit: Option<&Orbit>, design: &Orbit) -> bool {
    orbit.is_some_and(|orbit| {
        let away = orbit.state() - design.state();
        orbit.periods == design.periods && away.norm() <= SAME * design.state().norm()
    })
}
