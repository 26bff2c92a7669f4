//! The regimes z = p/n over drive frequency and clearance, as a page of maps.

use std::fmt;

use softstop::basin::{Axis, Grid, clearing};
use softstop::orbit::{Count, Orbit, Regime};

use super::pen::{Align, Pen};
use super::plane::Plane;

/// What moves in one cell of a map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RegimeCell {
    /// It repeats.
    Periodic {
        /// The regime.
        regime: Regime,
        /// True if impacts come in pairs, as in the paper's (2/4)B: 1-1-0-0.
        is_paired: bool,
    },
    /// It does not repeat, and small differences grow.
    Chaos,
    /// It has not settled.
    Unsettled,
    /// It cannot be computed.
    Lost,
}

/// Regimes of one colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RegimeClass {
    /// No impacts.
    Zero,
    /// One impact in each drive period.
    One,
    /// The same number of impacts as drive periods, but two or more.
    Doubled,
    /// z = 2/3 = 4/6 = ...
    TwoThirds,
    /// Other regimes between 1/2 and 1.
    Between,
    /// z = 1/2, (2/4)A and others whose impacts are apart.
    Half,
    /// (2/4)B and others whose impacts are in pairs.
    Paired,
    /// 0 < z < 1/2.
    Few,
    /// z > 1.
    Many,
    /// No regime.
    Chaos,
    /// Not settled.
    Unsettled,
    /// Not computed.
    Lost,
}

impl RegimeClass {
    /// All, in the order of the legend.
    pub const ALL: [Self; 12] = [
        Self::Zero,
        Self::One,
        Self::Doubled,
        Self::Between,
        Self::TwoThirds,
        Self::Half,
        Self::Paired,
        Self::Few,
        Self::Many,
        Self::Chaos,
        Self::Unsettled,
        Self::Lost,
    ];

    /// In a word or two.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Zero => "z = 0",
            Self::One => "z = 1",
            Self::Doubled => "z = n/n, n > 1",
            Self::TwoThirds => "z = 2/3",
            Self::Between => "1/2 < z < 1 but 2/3",
            Self::Half => "z = 1/2, (2/4)A",
            Self::Paired => "z = (2/4)B",
            Self::Few => "0 < z < 1/2",
            Self::Many => "z > 1",
            Self::Chaos => "chaos",
            Self::Unsettled => "not settled",
            Self::Lost => "lost",
        }
    }

    /// Okabe and Ito's colours, and greys.
    pub(super) const fn color(self) -> &'static str {
        match self {
            Self::Zero => "#E4E4E4",
            Self::One => "#56B4E9",
            Self::Doubled => "#0072B2",
            Self::TwoThirds => "#009E73",
            Self::Between => "#9AD6B4",
            Self::Half => "#E69F00",
            Self::Paired => "#D55E00",
            Self::Few => "#CC79A7",
            Self::Many => "#F0E442",
            Self::Chaos => "#000000",
            Self::Unsettled => "#8C8C8C",
            Self::Lost => "#FFFFFF",
        }
    }
}

impl RegimeCell {
    /// That of an orbit.
    #[must_use]
    pub fn of(orbit: &Orbit) -> Self {
        let pattern = orbit.pattern();
        let counts = pattern.counts();
        let next = counts.iter().cycle().skip(1);
        let one = Count::Finite(1);
        let regime = orbit.regime();
        let pairs = counts.iter().zip(next);
        Self::Periodic {
            regime,
            is_paired: 2 * regime.impacts == regime.periods
                && pairs.into_iter().any(|pair| pair == (&one, &one)),
        }
    }

    /// Its colour's class.
    #[must_use]
    pub fn class(&self) -> RegimeClass {
        let (regime, is_paired) = match self {
            Self::Periodic { regime, is_paired } => (regime, *is_paired),
            Self::Chaos => return RegimeClass::Chaos,
            Self::Unsettled => return RegimeClass::Unsettled,
            Self::Lost => return RegimeClass::Lost,
        };
        let (p, n) = (regime.impacts, regime.periods);
        match () {
            () if p == 0 => RegimeClass::Zero,
            () if p == 1 && n == 1 => RegimeClass::One,
            () if p == n => RegimeClass::Doubled,
            () if p > n => RegimeClass::Many,
            () if 3 * p == 2 * n => RegimeClass::TwoThirds,
            () if 2 * p > n => RegimeClass::Between,
            () if 2 * p == n && is_paired => RegimeClass::Paired,
            () if 2 * p == n => RegimeClass::Half,
            () => RegimeClass::Few,
        }
    }
}

impl fmt::Display for RegimeCell {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Periodic { regime, is_paired } if *is_paired => write!(formatter, "({regime})B"),
            Self::Periodic { regime, .. } => write!(formatter, "{regime}"),
            Self::Chaos => formatter.write_str("chaos"),
            Self::Unsettled => formatter.write_str("unsettled"),
            Self::Lost => formatter.write_str("lost"),
        }
    }
}

/// Cells over frequency and clearance.
#[derive(Debug, Clone, PartialEq)]
pub struct RegimeMap {
    /// Where the first column begins and the last one ends.
    pub eta: (f64, f64),
    /// Where the lowest row begins and the highest one ends.
    pub rho: (f64, f64),
    /// Cells in a row.
    pub columns: usize,
    /// The cells, row by row, the lowest row first.
    pub cells: Vec<RegimeCell>,
}

impl RegimeMap {
    /// Share of the cells that belong to a class.
    #[must_use]
    pub fn share(&self, class: RegimeClass) -> f64 {
        let own = self.cells.iter().filter(|cell| cell.class() == class);
        own.count() as f64 / self.cells.len() as f64
    }

    /// The middle of the widest place of a class, if that is wide.
    fn widest(&self, class: RegimeClass) -> Option<(f64, f64)> {
        let rows = self.cells.len() / self.columns;
        let grid = Grid::states(
            Axis::position(self.eta.0, self.eta.1, self.columns),
            Axis::velocity(self.rho.0, self.rho.1, rows),
            0.0,
        );
        let ball = clearing(&grid, |cell| self.cells[cell].class() == class)?;
        (ball.radius > WIDE).then_some((ball.centre[0], ball.centre[1]))
    }
}

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

/// Radius of a place, in units of half the map, that has room for its name.
const WIDE: f64 = 0.09;
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
/// Pixels for each unit of length.
const SCALE: f32 = 2.0;
/// Where on a map's height the names of curves stand, as a share of it.
const NAMES_AT: f64 = 0.2;

impl RegimePage {
    /// The page of these maps.
    #[must_use]
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
    fn classes(&self) -> Vec<RegimeClass> {
        let is_there = |class: &RegimeClass| {
            let mut panels = self.panels.iter();
            panels.any(|panel| panel.map.share(*class) > 0.0)
        };
        RegimeClass::ALL.into_iter().filter(is_there).collect()
    }

    /// Colours, names and shares of each map.
    fn table(&self, pen: &mut Pen, top: f64, classes: &[RegimeClass]) {
        pen.heading((LEFT, top), LETTERS.1, Align::Left, "share of the map in %");
        let column = |index: usize| LEFT + COLUMNS.0 + COLUMNS.1 * (index as f64 + 0.6);
        for index in 0..self.panels.len() {
            let place = (column(index), top);
            pen.heading(place, LETTERS.1, Align::Right, &letter(index));
        }
        for (row, class) in classes.iter().enumerate() {
            let line = top + LINE * (row as f64 + 1.2);
            let square = (LEFT, line - 15.0, 30.0, 18.0);
            pen.fill(&[square], class.color());
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
        let plane = Plane {
            area: (left, top, MAP.0, MAP.1),
            x: self.map.eta,
            y: self.map.rho,
            letters: LETTERS.2,
        };
        let heading = format!("{} {}", letter(index), self.name);
        pen.heading((left, top - 12.0), LETTERS.1, Align::Left, &heading);
        let cells = self.map.cells.iter();
        let colors: Vec<&str> = cells.map(|cell| cell.class().color()).collect();
        plane.cells(pen, self.map.columns, &colors);
        for curve in &self.curves {
            plane.curve(pen, &curve.points, dashes(curve.name));
        }
        plane.axes(pen, "frequency η", "clearance ρ");
        self.names(pen, &plane);
        let (name, point) = self.point;
        if plane.holds(point) {
            let place = plane.place(point);
            pen.spot(place, 6.0);
            pen.label((place.0 + 18.0, place.1 - 10.0), LETTERS.2, name);
        }
    }

    /// Names of wide regimes and of curves.
    fn names(&self, pen: &mut Pen, plane: &Plane) {
        for class in [RegimeClass::Zero, RegimeClass::One, RegimeClass::TwoThirds] {
            if let Some(place) = self.map.widest(class) {
                pen.label(plane.place(place), LETTERS.2, class.name());
            }
        }
        let rho = plane.y.0 + NAMES_AT * (plane.y.1 - plane.y.0);
        for curve in &self.curves {
            for eta in crossings(&curve.points, rho) {
                if plane.holds((eta, rho)) {
                    pen.label(plane.place((eta, rho)), LETTERS.2, curve.name);
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
