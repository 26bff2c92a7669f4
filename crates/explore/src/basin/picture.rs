//! Pictures of basins: cells of colour, the motions' own points, the largest ball inside a basin.

use softstop::{Dimension, Machine};
use softstop_dynamics::basin::{Class, Clearing, Quantity};
use softstop_dynamics::motion::MotionClass;
use softstop_dynamics::{Axis, Basins, Orbit, Regime};

use super::cells::color;
use softstop_draw::panel::{Axes, Panel};
use softstop_draw::pen::{Align, Area, Pen};

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
const SIDE: usize = 720;
/// Pixels for each unit of length: the least side of a cell is half a unit.
const SCALE: f32 = 2.0;
/// Margins around the grid: left, top, right, bottom.
const MARGINS: (f64, f64, f64, f64) = (86.0, 56.0, 340.0, 66.0);
/// Size of letters.
const LETTERS: u32 = 15;
/// Numbers along each axis.
const TICKS: (usize, usize) = (6, 6);
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
        let (width, height) = self.size();
        let page = (
            width + MARGINS.0 + MARGINS.2,
            height.max(200.0) + MARGINS.1 + MARGINS.3,
        );
        let mut pen = Pen::page(page.0, page.1);
        pen.heading((MARGINS.0, 34.0), 19, Align::Left, self.title);
        self.draw(&mut pen, (MARGINS.0, MARGINS.1, width, height), LETTERS);
        let place = (MARGINS.0 + width + 24.0, MARGINS.1 + 12.0);
        self.legend(&mut pen, place, LETTERS);
        pen.png_at(SCALE)
    }

    pub(super) fn title(&self) -> &str {
        self.title
    }

    /// Width and height: whole pixels for each cell.
    fn size(&self) -> (f64, f64) {
        let grid = &self.basins.grid;
        let cells = grid.across.cells.max(grid.up.cells);
        let cell = 0.5 * (2 * SIDE / cells).max(1) as f64;
        (cell * grid.across.cells as f64, cell * grid.up.cells as f64)
    }

    /// Cells, axes, motions and the largest ball inside the basin of z = 1.
    pub(super) fn draw(&self, pen: &mut Pen, area: Area, letters: u32) {
        let grid = &self.basins.grid;
        let panel = Panel::new(area, grid.across.range.into(), grid.up.range.into());
        let palette = self.colors();
        let cells = self.basins.cells.iter();
        let colors: Vec<&str> = cells.map(|class| palette[usize::from(*class)]).collect();
        panel.cells(pen, grid.across.cells, &colors);
        if let Some(ball) = self.ball() {
            let center = panel.place((ball.centre[0], ball.centre[1]));
            let radius = (0.5 * ball.radius * area.2, 0.5 * ball.radius * area.3);
            pen.ring(center, radius);
        }
        let (across, up) = (self.name(&grid.across), self.name(&grid.up));
        panel.axes(pen, &Axes::new(letters, Some(&across), &up, TICKS));
        self.motions(pen, &panel);
    }

    /// The points of the motions, where the plane shows them.
    fn motions(&self, pen: &mut Pen, panel: &Panel) {
        let grid = &self.basins.grid;
        let shown = (grid.across.quantity, grid.up.quantity);
        if shown != (Quantity::Position, Quantity::Velocity)
            || grid.angle != self.machine.scene.excitation.phase
        {
            return;
        }
        let inside = |point: &(f64, f64)| panel.holds(*point);
        let wandering = self.wandering.iter().copied().filter(inside);
        let dots: Vec<(f64, f64)> = wandering.map(|point| panel.place(point)).collect();
        pen.dots(&dots, DOT, "#ffffff");
        for orbit in self.orbits() {
            let states = orbit.states().unwrap_or_default().into_iter();
            for point in states.map(|state| (state.x, state.y)).filter(inside) {
                pen.spot(panel.place(point), SPOT);
            }
        }
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

    fn name(&self, axis: &Axis) -> String {
        let label = |what, symbol, dimension| self.machine.label(what, symbol, dimension);
        match axis.quantity {
            Quantity::Position => label("initial position", "X", Dimension::Length),
            Quantity::Velocity => label("initial velocity", "X′", Dimension::Velocity),
            Quantity::Angle => "initial drive angle φ in rad".to_owned(),
        }
    }

    fn orbits(&self) -> impl Iterator<Item = &Orbit> {
        let classes = self.basins.classes.iter();
        classes.filter_map(|class| class.orbit.as_deref())
    }

    /// The largest ball inside the basin of z = 1.
    fn ball(&self) -> Option<Clearing> {
        self.basins.largest_ball_of(Regime::ONE)
    }

    /// Colours, names and shares, downwards from a place.
    pub(super) fn legend(&self, pen: &mut Pen, (left, top): (f64, f64), letters: u32) {
        let size = f64::from(letters);
        let lines = self.basins.classes.iter().zip(self.colors());
        for (index, (class, color)) in lines.enumerate() {
            let line = top + 3.4 * size * index as f64;
            let square = (left, line - size, 1.5 * size, 1.5 * size);
            pen.fill(&[square], color);
            pen.frame(square);
            let place = (left + 2.2 * size, line);
            pen.heading(place, letters, Align::Left, &label(class));
            let [low, high] = class.interval.map(|share| 100.0 * share);
            let share = format!("{:.2} % ({low:.2} to {high:.2})", 100.0 * class.share);
            let place = (left + 2.2 * size, line + 1.3 * size);
            pen.text(place, letters, Align::Left, &share);
        }
        if let Some(ball) = self.ball() {
            let line = top + 3.4 * size * self.basins.classes.len() as f64;
            let radius = (0.6 * size, 0.6 * size);
            pen.ring((left + 0.75 * size, line - 0.35 * size), radius);
            let place = (left + 2.2 * size, line);
            let text = format!("largest ball in z = 1: {:.3}", ball.radius);
            pen.text(place, letters, Align::Left, &text);
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

/// Sizes on the page: a grid, what is left of it and right, above it and below.
const GRID: f64 = 600.0;
const COLUMN: f64 = GRID + 96.0 + 290.0;
const ROW: f64 = GRID + 60.0 + 78.0;
const HEAD: f64 = 66.0;
/// Letters.
const PAGE_LETTERS: u32 = 17;

impl BasinPage<'_> {
    /// As PNG.
    ///
    /// # Errors
    /// Why it cannot be made.
    pub fn png(&self) -> Result<Vec<u8>, String> {
        let rows = self.pictures.len().div_ceil(2) as f64;
        let (width, height) = (2.0 * COLUMN, HEAD + rows * ROW);
        let mut pen = Pen::page(width, height);
        let title = "Basins of attraction: which start leads to which motion";
        pen.heading((92.0, 42.0), 24, Align::Left, title);
        for (index, picture) in self.pictures.iter().enumerate() {
            let left = 92.0 + COLUMN * (index % 2) as f64;
            let top = HEAD + 46.0 + ROW * (index / 2) as f64;
            let place = (left, top - 14.0);
            pen.heading(place, PAGE_LETTERS + 2, Align::Left, picture.title());
            picture.draw(&mut pen, (left, top, GRID, GRID), PAGE_LETTERS);
            let place = (left + GRID + 22.0, top + 16.0);
            picture.legend(&mut pen, place, PAGE_LETTERS);
        }
        pen.png_at(SCALE)
    }
}
