//! The pictures of figure 9: for each motion its time series, phase trajectory and section (Peterka 2003).

use anyhow::Result;

use super::CLEARANCE;
use super::found::Found;
use super::path::{Path, SHALLOW};
use crate::figure::ends;
use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Pen, Stroke};
use softstop_draw::style;

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
/// Points for each drive period, of all of a motion and of what is near the stop.
const FINENESS: (u32, u32) = (72, 1440);
/// Room before the stop near it, in units of the depth beyond it.
const NEAR: f64 = 5.0;
/// More dots than this are many; size of a dot of few, and of many.
const MANY: usize = 64;
const DOTS: (f64, f64) = (4.2, 1.0);

/// A motion as it is drawn.
pub struct Row<'a> {
    pub motion: &'a Found,
    /// Drive periods of the time series.
    shown: u64,
    pub path: Path,
    /// Its phase trajectory, and the part of it near the stop, more finely.
    plane: Vec<(f64, f64)>,
    near: Vec<(f64, f64)>,
    /// States of the other motions of the same machine.
    others: Vec<&'a [(f64, f64)]>,
}

/// A page of motions as an SVG document.
pub fn svg(rows: &[Row<'_>]) -> String {
    let (top, height, foot) = HEIGHTS;
    let mut pen = Pen::new(WIDTH, top + height * rows.len() as f64 + foot);
    let letter = |row: Option<&Row<'_>>| row.map_or(' ', |row| row.motion.asked.letter);
    let (first, last) = (letter(rows.first()), letter(rows.last()));
    let title = format!("Fig. 9({first})–({last}): motions of the unloaded machine, ρ = 10");
    let explanation = "▼ impacts · right: states at drive angle 0, in grey those of the motions above or below \
                       that coexist at the same η";
    heading(&mut pen, (28.0, 38.0), &title, explanation);
    for (index, row) in rows.iter().enumerate() {
        let is_last = index + 1 == rows.len();
        row.draw(&mut pen, top + height * index as f64, is_last);
    }
    pen.svg()
}

impl<'a> Row<'a> {
    /// A motion among all, its time series over so many drive periods.
    pub fn new(motion: &'a Found, all: &'a [Found], shown: u64) -> Result<Self> {
        let asked = motion.asked;
        let others = all.iter().filter(|other| {
            other.asked.letter != asked.letter && other.asked.frequency == asked.frequency
        });
        Ok(Self {
            motion,
            shown,
            path: motion.path(Some(shown), FINENESS.0)?,
            plane: motion.path(None, FINENESS.0)?.states(),
            near: motion.path(None, FINENESS.1)?.near(),
            others: others.map(|other| &other.section.states[..]).collect(),
        })
    }

    fn draw(&self, pen: &mut Pen, top: f64, is_last: bool) {
        let (motion, line) = (self.motion, top + PANEL.0 - 10.0);
        let letter = format!("({})", motion.asked.letter);
        pen.heading((PLACES[0].0, line), 16, Align::Left, &letter);
        pen.text((PLACES[0].0 + 38.0, line), 15, Align::Left, &motion.title());
        let place = (PLACES[3].0 + PLACES[3].1, line);
        let grey = (style::ASIDE, false);
        pen.words(place, 13, Align::Right, grey, &motion.remark());
        let panel = |index: usize, x: (f64, f64), y: (f64, f64)| {
            let (left, width) = PLACES[index];
            Panel::new((left, top + PANEL.0, width, PANEL.1), x, y)
        };
        // The name of an axis across stands in the last row only.
        let across = |name| Some(if is_last { name } else { "" });
        let axes = |name, up, ticks| Axes::new(LETTERS, across(name), up, ticks);

        let (low, high) = ends(self.path.points.iter().map(|at| at[1]));
        let y = (1.1 * low, 1.42 * high.max(CLEARANCE));
        let time = panel(0, (0.0, self.shown as f64), y);
        self.time(pen, &time);
        time.axes(pen, &axes("time τ/T", "X", (12, 4)));

        let [x, y] = around(self.plane.iter(), 0.1);
        let plane = panel(1, x, y);
        self.trajectory(pen, &plane, &self.plane, 1.3);
        plane.axes(pen, &axes("X", "X′", (4, 4)));

        let (_, high) = ends(self.near.iter().map(|point| point.0));
        let depth = (high - CLEARANCE).max(SHALLOW * CLEARANCE);
        let x = (CLEARANCE - NEAR * depth, CLEARANCE + 1.6 * depth);
        let [_, y] = around(self.near.iter().filter(|point| point.0 > x.0), 0.1);
        let zoom = panel(2, x, y);
        self.trajectory(pen, &zoom, &self.near, 1.1);
        zoom.axes(pen, &axes("X near the stop", "X′", (3, 5)));

        let own = &motion.section.states;
        let others = self.others.iter().copied().flatten();
        let [x, y] = around(own.iter().chain(others), 0.08);
        let section = panel(3, x, y);
        let others = self.others.iter().map(|other| (*other, COLORS.2));
        for (states, color) in others.chain([(&own[..], self.color())]) {
            let radius = if states.len() > MANY { DOTS.1 } else { DOTS.0 };
            section.dots(pen, states.iter().copied(), radius, color);
        }
        section.axes(pen, &axes("X at drive angle 0", "X′", (5, 4)));
    }

    fn color(&self) -> &'static str {
        match self.motion.is_chaotic() {
            true => COLORS.1,
            false => COLORS.0,
        }
    }

    /// The time series, its impacts, and how long it takes to repeat.
    fn time(&self, pen: &mut Pen, panel: &Panel) {
        for period in (0..self.shown as u32).step_by(2) {
            let left = panel.across(f64::from(period));
            let width = panel.across(f64::from(period) + 1.0) - left;
            pen.tint((left, panel.area.1, width, panel.area.3), BAND, 1.0);
        }
        panel.curve(pen, &[(0.0, CLEARANCE), (panel.x.1, CLEARANCE)], FACE);
        let line = Stroke::solid(self.color(), 1.3);
        panel.curve(pen, &self.path.positions(), line);
        for &time in &self.path.impacts {
            let (x, tip) = (panel.across(time), panel.height(CLEARANCE) - 4.0);
            pen.arrow((x, tip - 13.0), (x, tip), Stroke::solid(style::INK, 1.2));
        }
        let Some(periods) = self.motion.period().filter(|periods| *periods > 1) else {
            return;
        };
        let y = panel.bottom() - 9.0;
        let (left, right) = (panel.across(0.0), panel.across(periods as f64));
        let middle = 0.5 * (left + right);
        let line = Stroke::solid(style::INK, 1.1);
        pen.arrow((middle, y), (left, y), line);
        pen.arrow((middle, y), (right, y), line);
        let (name, ink) = (format!("{periods} T"), (style::INK, true));
        pen.words((middle, y + 5.0), LETTERS, Align::Middle, ink, &name);
    }

    fn trajectory(&self, pen: &mut Pen, panel: &Panel, points: &[(f64, f64)], width: f64) {
        let face = [(CLEARANCE, panel.y.0), (CLEARANCE, panel.y.1)];
        panel.curve(pen, &face, FACE);
        let width = if self.motion.is_chaotic() {
            0.45
        } else {
            width
        };
        panel.curve(pen, points, Stroke::solid(self.color(), width));
    }
}

/// The ranges of points with some room on all sides; about a single value too.
fn around<'a>(points: impl Iterator<Item = &'a (f64, f64)> + Clone, room: f64) -> [(f64, f64); 2] {
    let ranges = [
        ends(points.clone().map(|it| it.0)),
        ends(points.map(|it| it.1)),
    ];
    ranges.map(|(low, high)| {
        let room = if high > low { room * (high - low) } else { 0.5 };
        (low - room, high + room)
    })
}
