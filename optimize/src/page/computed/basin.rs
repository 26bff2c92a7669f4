//! Which initial state leads to which motion of a design's machine.

use softstop::Dimension;
use softstop_console::interrupt;
use softstop_dynamics::attractors::{SurveyError, starting_box};
use softstop_dynamics::basin::{Options, basins};
use softstop_dynamics::{Axis, Grid, Orbit};
use softstop_explore::basin::cells::color;

use super::label;
use crate::design::Design;
use crate::page::data::{Basin, BasinMotion};

/// Cells on each side.
const CELLS: usize = 64;

/// Colours of motions whose own colour is taken.
const OTHERS: [&str; 5] = ["#E69F00", "#009E73", "#AA4499", "#F0E442", "#D55E00"];
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
    let mut motions: Vec<BasinMotion> = Vec::new();
    for (index, class) in found.classes.iter().enumerate() {
        let is_free = |color: &&str| motions.iter().all(|other| other.color != *color);
        let color = [color(class.motion.class())]
            .into_iter()
            .chain(OTHERS)
            .find(is_free);
        let whose = if own == Some(index) {
            ", the design"
        } else {
            ""
        };
        motions.push(BasinMotion {
            name: format!("{}{whose}", class.motion),
            color: color.unwrap_or(OTHERS[0]),
            share: class.share,
            interval: class.interval,
        });
    }
    let ball = own.and_then(|own| found.largest_ball(own));
    Ok(Basin {
        x: label(machine, "initial position", "X", Dimension::Length),
        y: label(machine, "initial velocity", "X′", Dimension::Velocity),
        x_range: region.position,
        y_range: region.velocity,
        columns: CELLS,
        cells: found.cells.clone(),
        motions,
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
