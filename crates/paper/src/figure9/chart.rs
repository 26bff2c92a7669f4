//! The pictures of figure 9: for each motion its time series, phase trajectory and section (Peterka 2003).

use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Area, Pen, Stroke};
use softstop_draw::style;

/// One motion.
#[derive(Debug, Clone)]
pub struct MotionRow {
    /// Its letter.
    pub letter: char,
    /// What it is.
    pub title: String,
    /// What else there is to say.
    pub remark: String,
    /// Whether it never repeats.
    pub is_chaotic: bool,
    /// The clearance ρ.
    pub clearance: f64,
    /// Drive periods after which it repeats, if it does.
    pub repeats: Option<u64>,
    /// X over time in drive periods.
    pub series: Vec<(f64, f64)>,
    /// Times of its impacts in drive periods.
    pub impacts: Vec<f64>,
    /// X' over X.
    pub trajectory: Vec<(f64, f64)>,
    /// The part of it near the stop, more finely.
    pub near: Vec<(f64, f64)>,
    /// States at drive angle 0.
    pub section: Vec<(f64, f64)>,
    /// Those of each other motion of the same machine.
    pub others: Vec<Vec<(f64, f64)>>,
}

/// A page of motions.
#[derive(Debug, Clone)]
pub struct MotionPage {
    /// Its title.
    pub title: String,
    /// How to read it.
    pub explanation: String,
    /// Drive periods of the time series.
    pub shown: f64,
    /// The motions.
    pub rows: Vec<MotionRow>,
}

const WIDTH: f64 = 1520.0;
/// Room above the first row, of a row, and below the last.
const HEIGHTS: (f64, f64, f64) = (84.0, 236.0, 52.0);
/// Room of a row above its panels, and height of these.
const PANEL: (f64, f64) = (34.0, 166.0);
/// Left end and width of the panels.
const PLACES: [(f64, f64); 4] = [
    (82.0, 560.0),
    (720.0, 200.0),
    (1002.0, 200.0),
    (1292.0, 200.0),
];
const LETTERS: u32 = 14;
/// Colours of motions that repeat, of those that do not, and of others.
const COLORS: (&str, &str, &str) = (style::DESIGN, style::OPTIMUM, "#b4b4b4");
const FACE: Stroke = Stroke::dashed(style::ASIDE, 1.1, (6.0, 4.0));
/// Every other drive period.
const BAND: &str = "#f3f3f3";
/// Size of a dot of few, and of many.
const DOTS: (f64, f64) = (4.2, 1.0);
/// Room before the stop near it, in units of the depth beyond it.
const NEAR: f64 = 5.0;
/// Least depth beyond the clearance, as a share of it, that is shown.
const SHALLOW: f64 = 0.002;
/// More dots than this are many.
const MANY: usize = 64;

impl MotionPage {
    /// The picture as an SVG document.
    pub fn svg(&self) -> String {
        let (top, height, foot) = HEIGHTS;
        let mut pen = Pen::new(WIDTH, top + height * self.rows.len() as f64 + foot);
        heading(&mut pen, (28.0, 38.0), &self.title, &self.explanation);
        for (index, row) in self.rows.iter().enumerate() {
            let place = Place {
                top: top + height * index as f64,
                is_last: index + 1 == self.rows.len(),
                shown: self.shown,
            };
            row.draw(&mut pen, &place);
        }
        pen.svg()
    }
}

/// Where a row is.
struct Place {
    top: f64,
    is_last: bool,
    shown: f64,
}

impl Place {
    fn area(&self, panel: usize) -> Area {
        let (left, width) = PLACES[panel];
        (left, self.top + PANEL.0, width, PANEL.1)
    }

    /// The name of an axis across, in the last row only.
    fn axes<'a>(&self, across: &'a str, upwards: &'a str, ticks: (usize, usize)) -> Axes<'a> {
        Axes::new(
            LETTERS,
            Some(if self.is_last { across } else { "" }),
            upwards,
            ticks,
        )
    }
}

impl MotionRow {
    fn draw(&self, pen: &mut Pen, place: &Place) {
        let line = place.top + PANEL.0 - 10.0;
        let letter = format!("({})", self.letter);
        pen.heading((PLACES[0].0, line), 16, Align::Left, &letter);
        pen.text((PLACES[0].0 + 38.0, line), 15, Align::Left, &self.title);
        let right = PLACES[3].0 + PLACES[3].1;
        let grey = (style::ASIDE, false);
        pen.words((right, line), 13, Align::Right, grey, &self.remark);
        self.time(pen, place);
        self.plane(pen, place);
        self.zoom(pen, place);
        self.poincare(pen, place);
    }

    fn color(&self) -> &'static str {
        if self.is_chaotic { COLORS.1 } else { COLORS.0 }
    }

    fn time(&self, pen: &mut Pen, place: &Place) {
        let (low, high) = ends(self.series.iter().map(|point| point.1));
        let panel = Panel::new(
            place.area(0),
            (0.0, place.shown),
            (1.1 * low, 1.42 * high.max(self.clearance)),
        );
        for period in (0..place.shown as u32).step_by(2) {
            let left = panel.across(f64::from(period));
            let width = panel.across(f64::from(period) + 1.0) - left;
            pen.tint((left, panel.area.1, width, panel.area.3), BAND, 1.0);
        }
        let face = [(0.0, self.clearance), (place.shown, self.clearance)];
        panel.curve(pen, &face, FACE);
        panel.curve(pen, &self.series, Stroke::solid(self.color(), 1.3));
        let arrow = Stroke::solid(style::INK, 1.2);
        for &time in &self.impacts {
            let x = panel.across(time);
            let tip = panel.height(self.clearance) - 4.0;
            pen.arrow((x, tip - 13.0), (x, tip), arrow);
        }
        self.span(pen, &panel);
        panel.axes(pen, &place.axes("time τ/T", "X", (12, 4)));
    }

    /// Marks how long it takes to repeat.
    fn span(&self, pen: &mut Pen, panel: &Panel) {
        let Some(periods) = self.repeats.filter(|periods| *periods > 1) else {
            return;
        };
        let y = panel.bottom() - 9.0;
        let (left, right) = (panel.across(0.0), panel.across(periods as f64));
        let middle = 0.5 * (left + right);
        let line = Stroke::solid(style::INK, 1.1);
        pen.arrow((middle, y), (left, y), line);
        pen.arrow((middle, y), (right, y), line);
        let name = format!("{periods} T");
        pen.words(
            (middle, y + 5.0),
            LETTERS,
            Align::Middle,
            (style::INK, true),
            &name,
        );
    }

    fn plane(&self, pen: &mut Pen, place: &Place) {
        let panel = Panel::new(
            place.area(1),
            wide(ends(self.trajectory.iter().map(|point| point.0)), 0.1),
            wide(ends(self.trajectory.iter().map(|point| point.1)), 0.1),
        );
        let face = [(self.clearance, panel.y.0), (self.clearance, panel.y.1)];
        panel.curve(pen, &face, FACE);
        let width = if self.is_chaotic { 0.45 } else { 1.3 };
        panel.curve(pen, &self.trajectory, Stroke::solid(self.color(), width));
        panel.axes(pen, &place.axes("X", "X′", (4, 4)));
    }

    /// The phase trajectory near the stop.
    fn zoom(&self, pen: &mut Pen, place: &Place) {
        let (_, high) = ends(self.near.iter().map(|point| point.0));
        let depth = (high - self.clearance).max(SHALLOW * self.clearance);
        let x = (self.clearance - NEAR * depth, self.clearance + 1.6 * depth);
        let shown = self.near.iter().filter(|point| point.0 > x.0);
        let panel = Panel::new(
            place.area(2),
            x,
            wide(ends(shown.map(|point| point.1)), 0.1),
        );
        let face = [(self.clearance, panel.y.0), (self.clearance, panel.y.1)];
        panel.curve(pen, &face, FACE);
        let width = if self.is_chaotic { 0.45 } else { 1.1 };
        panel.curve(pen, &self.near, Stroke::solid(self.color(), width));
        panel.axes(pen, &place.axes("X near the stop", "X′", (3, 5)));
    }

    fn poincare(&self, pen: &mut Pen, place: &Place) {
        let all = || self.section.iter().chain(self.others.iter().flatten());
        let panel = Panel::new(
            place.area(3),
            wide(ends(all().map(|point| point.0)), 0.08),
            wide(ends(all().map(|point| point.1)), 0.08),
        );
        let radius = |count: usize| if count > MANY { DOTS.1 } else { DOTS.0 };
        for other in &self.others {
            let points = other.iter().copied();
            panel.dots(pen, points, radius(other.len()), COLORS.2);
        }
        let own = self.section.iter().copied();
        panel.dots(pen, own, radius(self.section.len()), self.color());
        panel.axes(pen, &place.axes("X at drive angle 0", "X′", (5, 4)));
    }
}

/// Least and largest.
fn ends(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    })
}

/// A range with some room on both sides; one about a single value too.
fn wide((low, high): (f64, f64), room: f64) -> (f64, f64) {
    let room = if high > low { room * (high - low) } else { 0.5 };
    (low - room, high + room)
}
