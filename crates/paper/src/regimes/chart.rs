//! The regimes z = p/n over drive frequency and clearance, as a page of maps.

use softstop_dynamics::motion::MotionClass;

use softstop_draw::panel::{Axes, Panel};
use softstop_draw::pen::{Align, Pen};
use softstop_explore::basin::cells::{RegimeMap, color};

/// A boundary over frequency and clearance.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundaryCurve {
    /// The paper's name.
    pub name: &'static str,
    /// Its points.
    pub points: Vec<(f64, f64)>,
}

/// One map of the page.
#[derive(Debug, Clone, PartialEq)]
pub struct RegimePanel {
    /// What it shows.
    pub name: String,
    /// The map.
    pub map: RegimeMap,
    /// The boundaries.
    pub curves: Vec<BoundaryCurve>,
    /// A point and its name.
    pub point: (&'static str, (f64, f64)),
}

/// The page: two maps in a row, and a table of shares.
#[derive(Debug, Clone, PartialEq)]
pub struct RegimePage {
    panels: Vec<RegimePanel>,
}

/// Size of a map; room around: left, above the first row, between columns, right, between rows.
const MAP: (f64, f64) = (600.0, 400.0);
const LEFT: f64 = 78.0;
const TOP: f64 = 96.0;
const BETWEEN: f64 = 86.0;
const RIGHT: f64 = 26.0;
const ROW: f64 = 502.0;
/// Height of a row of the table, and width of its columns: names, shares.
const LINE: f64 = 26.0;
const COLUMNS: (f64, f64) = (270.0, 150.0);
/// Letters: title, headings, text.
const LETTERS: (u32, u32, u32) = (24, 19, 18);
/// The axes of all maps.
const AXES: Axes<'static> = Axes::new(LETTERS.2, Some("frequency η"), "clearance ρ", (6, 6));
/// Pixels for each unit of length.
const SCALE: f32 = 2.0;
/// Where on a map's height the names of curves stand, as a share of it.
const NAMES_AT: f64 = 0.2;

impl RegimePage {
    /// The page of these maps.
    pub fn new(panels: Vec<RegimePanel>) -> Self {
        Self { panels }
    }

    /// As PNG.
    ///
    /// # Errors
    /// Why it cannot be made.
    pub fn png(&self) -> Result<Vec<u8>, String> {
        let classes = self.classes();
        let table = TOP + ROW * self.panels.len().div_ceil(2) as f64;
        let width = LEFT + 2.0 * MAP.0 + BETWEEN + RIGHT;
        let height = table + LINE * (classes.len() as f64 + 2.0);
        let mut pen = Pen::new(width, height);
        pen.fill(&[(0.0, 0.0, width, height)], "#ffffff");
        let title = "Regimes z = p/n: p impacts in n drive periods";
        pen.heading((LEFT, 42.0), LETTERS.0, Align::Left, title);
        for (index, panel) in self.panels.iter().enumerate() {
            let left = LEFT + (MAP.0 + BETWEEN) * (index % 2) as f64;
            let top = TOP + ROW * (index / 2) as f64;
            panel.draw(&mut pen, index, (left, top));
        }
        self.table(&mut pen, table, &classes);
        pen.png_at(SCALE)
    }

    /// The classes that there are.
    fn classes(&self) -> Vec<MotionClass> {
        let is_there = |class: &MotionClass| {
            let mut panels = self.panels.iter();
            panels.any(|panel| panel.map.share(*class) > 0.0)
        };
        MotionClass::ALL.iter().copied().filter(is_there).collect()
    }

    /// Colours, names and shares of each map.
    fn table(&self, pen: &mut Pen, top: f64, classes: &[MotionClass]) {
        pen.heading((LEFT, top), LETTERS.1, Align::Left, "share of the map in %");
        let column = |index: usize| LEFT + COLUMNS.0 + COLUMNS.1 * (index as f64 + 0.6);
        for index in 0..self.panels.len() {
            let place = (column(index), top);
            pen.heading(place, LETTERS.1, Align::Right, &letter(index));
        }
        for (row, class) in classes.iter().enumerate() {
            let line = top + LINE * (row as f64 + 1.2);
            let square = (LEFT, line - 15.0, 30.0, 18.0);
            pen.fill(&[square], color(*class));
            pen.frame(square);
            let place = (LEFT + 42.0, line);
            pen.text(place, LETTERS.2, Align::Left, class.name());
            for (index, panel) in self.panels.iter().enumerate() {
                let share = percent(panel.map.share(*class));
                let place = (column(index), line);
                pen.text(place, LETTERS.2, Align::Right, &share);
            }
        }
    }
}

impl RegimePanel {
    fn draw(&self, pen: &mut Pen, index: usize, (left, top): (f64, f64)) {
        let panel = Panel::new((left, top, MAP.0, MAP.1), self.map.eta, self.map.rho);
        let heading = format!("{} {}", letter(index), self.name);
        pen.heading((left, top - 12.0), LETTERS.1, Align::Left, &heading);
        let cells = self.map.cells.iter();
        let colors: Vec<&str> = cells.map(|cell| color(cell.class())).collect();
        panel.cells(pen, self.map.columns, &colors);
        for curve in &self.curves {
            panel.rimmed(pen, &curve.points, dashes(curve.name));
        }
        panel.axes(pen, &AXES);
        self.names(pen, &panel);
        let (name, point) = self.point;
        if panel.holds(point) {
            let place = panel.place(point);
            pen.spot(place, 6.0);
            pen.label((place.0 + 18.0, place.1 - 10.0), LETTERS.2, name);
        }
    }

    /// Names of wide regimes and of curves.
    fn names(&self, pen: &mut Pen, panel: &Panel) {
        for class in [MotionClass::Zero, MotionClass::One, MotionClass::TwoThirds] {
            if let Some(place) = self.map.widest(class) {
                pen.label(panel.place(place), LETTERS.2, class.name());
            }
        }
        let rho = panel.y.0 + NAMES_AT * (panel.y.1 - panel.y.0);
        for curve in &self.curves {
            for eta in crossings(&curve.points, rho) {
                if panel.holds((eta, rho)) {
                    pen.label(panel.place((eta, rho)), LETTERS.2, curve.name);
                }
            }
        }
    }
}

/// Dashes of a boundary and the gaps between them.
fn dashes(name: &str) -> Option<(f64, f64)> {
    match name {
        "g₀" => Some((3.0, 4.0)),
        "s_PD" => Some((9.0, 5.0)),
        _ => None,
    }
}

/// Where a curve is at this height.
fn crossings(points: &[(f64, f64)], height: f64) -> Vec<f64> {
    let pairs = points.windows(2);
    let crossing = |pair: &[(f64, f64)]| {
        let (from, to) = (pair[0], pair[1]);
        let crosses = (from.1 < height) != (to.1 < height);
        crosses.then(|| from.0 + (to.0 - from.0) * (height - from.1) / (to.1 - from.1))
    };
    pairs.filter_map(crossing).collect()
}

/// (a), (b), ...
fn letter(index: usize) -> String {
    let letter = char::from_u32('a' as u32 + index as u32).unwrap_or('?');
    format!("({letter})")
}

fn percent(share: f64) -> String {
    if share == 0.0 {
        "–".to_owned()
    } else if share < 0.0001 {
        "< 0.01".to_owned()
    } else {
        format!("{:.2}", 100.0 * share)
    }
}
