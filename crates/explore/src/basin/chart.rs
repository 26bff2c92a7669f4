//! Pictures of basins: cells of colour, the motions' own points, the largest ball inside a basin.

use softstop::{Dimension, Machine};
use softstop_draw::{Axis, Chart, Layer, Mark, Panel, Sign, style};
use softstop_dynamics::attractors::Attractor;
use softstop_dynamics::basin::AxisQuantity;
use softstop_dynamics::motion_kind::MotionClass;
use softstop_dynamics::{Axis as BasinAxis, Basins, Regime};

use crate::palette::distinct_colors;

/// Length of the longer side of a picture, and of both sides of one panel among others; finer grids are longer.
const LONGER: f64 = 720.0;
const SIDE: f64 = 600.0;
/// Radius of the spots of periodic motions, and of the dots of chaos.
const SPOT: f64 = 5.0;
const DOT: f64 = 0.8;

/// The basins of a machine as PNG.
///
/// # Errors
/// Why it cannot be made.
pub fn png(machine: &Machine, basins: &Basins, title: String) -> Result<Vec<u8>, String> {
    let [across, up] = [&basins.grid.across, &basins.grid.up].map(|axis| axis.cells as f64);
    let unit = LONGER / across.max(up);
    let panel = panel(machine, basins, &[]).sized((unit * across, unit * up));
    let chart = Chart {
        letters: 15,
        ..Chart::new(title, [panel])
    };
    chart.png()
}

/// Cells, the largest ball inside the basin of z = 1, motions, places on which chaos moves, and what the colours mean.
pub fn panel(machine: &Machine, basins: &Basins, wandering: &[(f64, f64)]) -> Panel {
    let grid = &basins.grid;
    let classes = || basins.classes.iter();
    let palette = distinct_colors(classes().map(|class| class.motion.class()));
    let colors = basins
        .cells
        .iter()
        .map(|class| palette[usize::from(*class)]);
    let mut layers = vec![Layer::cells(grid.across.cells, colors)];
    layers.extend(classes().zip(&palette).map(|(class, color)| {
        let [low, high] = class.interval.map(|share| 100.0 * share);
        let share = format!("{:.2} % ({low:.2} to {high:.2})", 100.0 * class.share);
        Layer::key(Sign::Patch(color), format!("{}\n{share}", label(class)))
    }));
    let half = |axis: &BasinAxis| 0.5 * (axis.range[1] - axis.range[0]);
    layers.extend(basins.largest_ball_of(Regime::ONE).map(|ball| {
        let half = [&grid.across, &grid.up].map(|axis| ball.radius * half(axis));
        let name = format!("largest ball in z = 1: {:.3}", ball.radius);
        Layer::ring(ball.centre.into(), half.into()).named(name)
    }));
    let shown = (grid.across.quantity, grid.up.quantity);
    if shown == (AxisQuantity::Position, AxisQuantity::Velocity)
        && grid.angle == machine.scene.excitation.phase
    {
        let orbits = classes().filter_map(|class| class.orbit.as_deref());
        let states = orbits.flat_map(|orbit| orbit.states().unwrap_or_default());
        let points = states.map(|state| (state.x, state.y));
        layers.push(Layer::dots(wandering.iter().copied(), DOT, style::PAPER));
        layers.push(Layer::marks(points, Mark::Hollow, style::INK).sized(SPOT));
    }
    let axis = |axis: &BasinAxis| Axis::new(name(machine, axis)).range(axis.range.into());
    Panel::new(axis(&grid.across), axis(&grid.up), layers).sized((SIDE, SIDE))
}

fn name(machine: &Machine, axis: &BasinAxis) -> String {
    match axis.quantity {
        AxisQuantity::Position => machine.label("initial position", "X", Dimension::Length),
        AxisQuantity::Velocity => machine.label("initial velocity", "X′", Dimension::Velocity),
        AxisQuantity::Angle => "initial drive angle φ in rad".to_owned(),
    }
}

/// What a basin is called.
fn label(class: &Attractor) -> String {
    let motion = &class.motion;
    match (motion.order_beyond_regime(), motion.regime()) {
        (Some(order), Some(regime)) if motion.class() == MotionClass::Paired => {
            format!("z = ({regime})B: {order}")
        }
        (Some(order), _) => format!("{motion}: {order}"),
        (None, _) => motion.to_string(),
    }
}
