//! Pictures of basins: cells of colour, the motions' own points, the largest ball inside a basin.

use softstop::{Dimension, Machine};
use softstop_dynamics::basin::{Class, Quantity};
use softstop_dynamics::motion::MotionClass;
use softstop_dynamics::{Axis as BasinAxis, Basins, Regime};

use super::cells::color;
use softstop_draw::{Axis, Chart, Layer, Legend, Mark, Panel, Sign, style};

/// Basins as cells of colour.
#[derive(Debug, Clone, Copy)]
pub struct BasinPicture<'a> {
    basins: &'a Basins,
    title: &'a str,
    machine: &'a Machine,
    /// Places of the plane on which chaos moves.
    wandering: &'a [(f64, f64)],
}

/// Colours of motions whose class has its colour from another motion.
const OTHERS: [&str; 6] = [
    "#AA4499", "#F0E442", "#0072B2", "#009E73", "#E69F00", "#D55E00",
];
/// Length that the longer side of the grid has about; finer grids are longer.
const SIDE: f64 = 720.0;
/// Radius of the spots of periodic motions, and of the dots of chaos.
const SPOT: f64 = 5.0;
const DOT: f64 = 0.8;

impl<'a> BasinPicture<'a> {
    /// The picture of a machine's basins.
    pub fn new(machine: &'a Machine, basins: &'a Basins, title: &'a str) -> Self {
        Self {
            basins,
            title,
            machine,
            wandering: &[],
        }
    }

    /// With dots where chaos moves.
    pub fn with_wandering(self, wandering: &'a [(f64, f64)]) -> Self {
        Self { wandering, ..self }
    }

    /// As PNG.
    ///
    /// # Errors
    /// Why it cannot be made.
    pub fn png(&self) -> Result<Vec<u8>, String> {
        let grid = &self.basins.grid;
        let longest = grid.across.cells.max(grid.up.cells) as f64;
        let side = |cells: usize| SIDE * cells as f64 / longest;
        let panel = Panel {
            title: String::new(),
            size: (side(grid.across.cells), side(grid.up.cells)),
            ..self.panel()
        };
        let chart = Chart {
            letters: 15,
            ..Chart::new(self.title, [panel])
        };
        chart.png()
    }

    /// Cells, the largest ball inside the basin of z = 1, motions, and what the colours mean.
    fn panel(&self) -> Panel {
        let grid = &self.basins.grid;
        let palette = self.colors();
        let cells = self.basins.cells.iter();
        let colors = cells.map(|class| palette[usize::from(*class)]);
        let mut layers = vec![Layer::cells(grid.across.cells, colors)];
        let classes = self.basins.classes.iter().zip(&palette);
        layers.extend(classes.map(|(class, color)| {
            let [low, high] = class.interval.map(|share| 100.0 * share);
            let share = format!("{:.2} % ({low:.2} to {high:.2})", 100.0 * class.share);
            Layer::key(Sign::Patch(color), format!("{}\n{share}", label(class)))
        }));
        let half = |axis: &BasinAxis| 0.5 * (axis.range[1] - axis.range[0]);
        layers.extend(self.basins.largest_ball_of(Regime::ONE).map(|ball| {
            let half = (
                ball.radius * half(&grid.across),
                ball.radius * half(&grid.up),
            );
            let name = format!("largest ball in z = 1: {:.3}", ball.radius);
            Layer::ring((ball.centre[0], ball.centre[1]), half).named(name)
        }));
        layers.extend(self.motions());
        let axis = |axis: &BasinAxis| Axis::new(self.name(axis)).range(axis.range.into());
        Panel {
            title: self.title.to_owned(),
            size: (600.0, 600.0),
            x: axis(&grid.across),
            y: axis(&grid.up),
            layers,
            ..Panel::default()
        }
    }

    /// The points of the motions, where the plane shows them.
    fn motions(&self) -> Vec<Layer> {
        let grid = &self.basins.grid;
        let shown = (grid.across.quantity, grid.up.quantity);
        if shown != (Quantity::Position, Quantity::Velocity)
            || grid.angle != self.machine.scene.excitation.phase
        {
            return Vec::new();
        }
        let classes = self.basins.classes.iter();
        let orbits = classes.filter_map(|class| class.orbit.as_deref());
        let states = orbits.flat_map(|orbit| orbit.states().unwrap_or_default());
        let points = states.map(|state| (state.x, state.y));
        vec![
            Layer::dots(self.wandering.iter().copied(), DOT, "#ffffff"),
            Layer::marks(points, Mark::Hollow, style::INK).sized(SPOT),
        ]
    }

    /// The colour of each basin: that of its regime; if it is taken, another one.
    fn colors(&self) -> Vec<&'static str> {
        let mut taken: Vec<&'static str> = Vec::new();
        for class in &self.basins.classes {
            let own = color(class.motion.class());
            let mut others = OTHERS.into_iter().filter(|color| !taken.contains(color));
            let color = if taken.contains(&own) {
                others.next().unwrap_or(own)
            } else {
                own
            };
            taken.push(color);
        }
        taken
    }

    fn name(&self, axis: &BasinAxis) -> String {
        let label = |what, symbol, dimension| self.machine.label(what, symbol, dimension);
        match axis.quantity {
            Quantity::Position => label("initial position", "X", Dimension::Length),
            Quantity::Velocity => label("initial velocity", "X′", Dimension::Velocity),
            Quantity::Angle => "initial drive angle φ in rad".to_owned(),
        }
    }
}

/// What a basin is called.
fn label(class: &Class) -> String {
    let motion = &class.motion;
    match (motion.told_order(), motion.regime()) {
        (Some(order), Some(regime)) if motion.class() == MotionClass::Paired => {
            format!("z = ({regime})B: {order}")
        }
        (Some(order), _) => format!("{motion}: {order}"),
        (None, _) => motion.to_string(),
    }
}

/// Four pictures of basins on a page.
#[derive(Debug, Clone)]
pub struct BasinPage<'a> {
    /// The pictures.
    pub pictures: Vec<BasinPicture<'a>>,
}

impl BasinPage<'_> {
    /// As PNG.
    ///
    /// # Errors
    /// Why it cannot be made.
    pub fn png(&self) -> Result<Vec<u8>, String> {
        let panels = self.pictures.iter().map(|picture| Panel {
            legend: Some(Legend::Right),
            ..picture.panel()
        });
        let title = "Basins of attraction: which start leads to which motion";
        let chart = Chart {
            letters: 17,
            ..Chart::new(title, panels)
        };
        chart.in_columns(2).png()
    }
}
