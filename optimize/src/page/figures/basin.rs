//! Which initial state leads to which motion of a design's machine.

use softstop::Dimension;
use softstop_console::interrupt;
use softstop_console::row;
use softstop_console::sheet::Sheet;
use softstop_draw::{Axis, Layer, Mark, Panel, Sign, style};
use softstop_dynamics::attractors::{Attractor, starting_box};
use softstop_dynamics::basin::{BasinOptions, find_basins};
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::{self as dynamics, Grid, Orbit};
use softstop_explore::palette::distinct_colors;

use crate::design::Design;
use crate::page::figure::{Figure, HALF, Section, middles};

/// Cells on each side.
const CELLS: usize = 64;
/// Distance of states of one motion, in units of their size.
const SAME: f64 = 1e-6;
/// Radius of the spot where a motion passes the plane.
const SPOT: f64 = 4.5;

/// The basins over the box of starts that all commands take.
///
/// # Errors
/// [`OrbitError`] if motions cannot be computed, or the user wants to stop.
pub(super) fn basin(design: &Design) -> Result<Figure, OrbitError> {
    let machine = &design.machine;
    let scene = &machine.scene;
    let region = starting_box(scene, &interrupt::watch)?;
    let ends: [(f64, f64); 2] = [region.position.into(), region.velocity.into()];
    let grid = Grid::of_states(
        dynamics::Axis::position(ends[0].0, ends[0].1, CELLS),
        dynamics::Axis::velocity(ends[1].0, ends[1].1, CELLS),
        scene.excitation.phase,
    );
    let found = find_basins(
        scene,
        &grid,
        &BasinOptions::default(),
        &interrupt::watch,
        None,
    )?;
    let classes = || found.classes.iter();
    let own = classes().position(|it| is_own(it.orbit.as_deref(), &design.orbit));
    let name = |(index, class): (usize, &Attractor)| match own == Some(index) {
        true => format!("{}, the design", class.motion),
        false => class.motion.to_string(),
    };
    let names: Vec<String> = classes().enumerate().map(name).collect();
    let colors = distinct_colors(classes().map(|it| it.motion.class()));
    let labels = [
        machine.label("initial position", "X", Dimension::Length),
        machine.label("initial velocity", "X′", Dimension::Velocity),
    ];
    let [x, y] = labels.each_ref();

    let cells = found.cells.iter().map(|it| colors[usize::from(*it)]);
    let mut layers = vec![Layer::cells(CELLS, cells)];
    let keys = colors.iter().zip(&names);
    layers.extend(keys.map(|(color, name)| Layer::key(Sign::Patch(color), name)));
    let ball = own.and_then(|own| found.largest_ball(own));
    layers.extend(ball.as_ref().map(|ball| {
        let half = ends.map(|(low, high)| 0.5 * ball.radius * (high - low));
        Layer::ring(ball.centre.into(), half.into())
    }));
    let spot = (design.orbit.position, design.orbit.velocity);
    layers.push(Layer::marks([spot], Mark::Hollow, style::INK).sized(SPOT));
    let [across, up] = [(x, ends[0]), (y, ends[1])].map(|(name, ends)| Axis::new(name).range(ends));
    let panel = Panel::new(across, up, layers);
    let shares = classes().zip(&names).map(|(class, name)| {
        let [low, high] = class.interval.map(|share| 100.0 * share);
        format!(
            "{name} {:.1} % ({low:.1} to {high:.1})",
            100.0 * class.share
        )
    });
    let ball = ball.map_or(String::new(), |ball| {
        let radius = ball.radius;
        format!(" The ring is the largest ball inside the basin of the design: {radius:.3} of half of each axis.")
    });
    let caption = format!(
        "Shares of the initial states, with 95 % intervals: {}. The spot is the design at drive angle φ.{ball}",
        shares.collect::<Vec<String>>().join("; ")
    );
    let [across, up] = ends.map(|ends| middles(ends, CELLS));
    let rows = found.cells.iter().enumerate().map(|(index, class)| {
        let name = &*names[usize::from(*class)];
        row![across(index % CELLS), up(index / CELLS), name]
    });
    let sheet = Sheet::new("basin", [x, y, "motion"], rows);
    let title = "Which start leads to which motion";
    Ok(Figure::new(Section::Motion, HALF, title, [panel], caption).with([sheet]))
}

/// Whether an orbit is the design's.
fn is_own(orbit: Option<&Orbit>, design: &Orbit) -> bool {
    orbit.is_some_and(|orbit| {
        let away = orbit.state() - design.state();
        orbit.periods == design.periods && away.norm() <= SAME * design.state().norm()
    })
}
