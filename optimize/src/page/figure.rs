//! Pictures of the report, each with its words and the tables of its data.

use softstop_console::row;
use softstop_console::sheet::Sheet;
use softstop_draw::{Chart, Layer, Legend, Panel, Stroke, style};

use super::words::plain;

/// Width and height of a picture that takes a whole line of the page.
pub const WIDE: (f64, f64) = (980.0, 460.0);
/// Width and height of one that takes half of it.
pub const HALF: (f64, f64) = (480.0, 400.0);

/// Room for title, machine and caption in a document.
const HEADINGS: f64 = 120.0;

/// The design's own motion.
pub(super) const DESIGN: Stroke = Stroke::solid(style::DESIGN, 2.5);
/// Another machine, or the same one in other circumstances.
pub(super) const BESIDE: Stroke = Stroke::dashed(style::REFERENCE, 2.5, (9.0, 4.0));
/// A motion that no mass stays on.
pub(super) const UNSTABLE: Stroke = Stroke::dashed(style::ASIDE, 1.6, (3.0, 3.0));
/// What bounds something.
pub(super) const BOUND: Stroke = Stroke::dashed(style::ASIDE, 1.3, (5.0, 4.0));
/// Where the design is.
pub(super) const AT: Stroke = Stroke::dashed(style::OPTIMUM, 1.8, (5.0, 4.0));

/// Part of the page that a picture belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Section {
    /// Where the design stands among others.
    Place,
    /// The machine and its motion.
    Motion,
    /// What more of one good costs of another.
    Cost,
    /// Machines within the tolerances.
    Tolerances,
}

/// A picture with its words and its data.
#[derive(Debug, Clone)]
pub struct Figure {
    /// Where it stands.
    pub section: Section,
    /// What is drawn; its title stands before the caption.
    pub chart: Chart,
    /// What it shows, in a sentence or two.
    pub caption: String,
    /// Its data.
    pub sheets: Vec<Sheet>,
}

impl Figure {
    /// Panels beside each other on a picture of this size, its legend above them.
    pub fn new(
        section: Section,
        size: (f64, f64),
        title: impl Into<String>,
        panels: impl IntoIterator<Item = Panel>,
        caption: impl Into<String>,
    ) -> Self {
        let chart = Chart {
            legend: Legend::Above,
            page: Some(size),
            shares_y: true,
            ..Chart::new(title, panels)
        };
        Self {
            section,
            chart: chart.in_columns(2),
            caption: caption.into(),
            sheets: Vec::new(),
        }
    }

    /// With its data.
    #[must_use]
    pub(super) fn with(mut self, sheets: impl IntoIterator<Item = Sheet>) -> Self {
        self.sheets.extend(sheets);
        self
    }

    /// Whether it takes a whole line of the page.
    pub(super) fn is_wide(&self) -> bool {
        self.chart.page.is_some_and(|(width, _)| width == WIDE.0)
    }

    /// For narrow screens: the panels of a wide picture below each other; none of a sketch, which has no axes.
    pub(super) fn narrow(&self) -> Option<Chart> {
        let (width, height) = HALF;
        let page = Some((width, height * self.chart.panels.len() as f64));
        let chart = self.chart.clone();
        let has_axes = chart.panels.iter().all(|it| !it.x.name.is_empty());
        (self.is_wide() && has_axes).then(|| Chart { page, ..chart }.in_columns(1))
    }

    /// As an SVG document about a machine of this name, with its caption.
    pub fn document(&self, machine: &str) -> String {
        let page = self.chart.page;
        let chart = Chart {
            subtitle: machine.to_owned(),
            notes: vec![plain(&self.caption)],
            page: page.map(|(width, height)| (width, height + HEADINGS)),
            ..self.chart.clone()
        };
        chart.svg()
    }
}

/// A line through points.
#[derive(Debug, Clone)]
pub(super) struct Curve {
    /// What it is called in the legend; curves of one name share an entry.
    pub(super) name: String,
    /// How it is drawn.
    pub(super) stroke: Stroke,
    /// Values across and upwards.
    pub(super) points: Vec<(f64, f64)>,
}

impl Curve {
    /// As it is drawn.
    pub(super) fn layer(&self) -> Layer {
        Layer::line(self.points.iter().copied(), self.stroke).named(&self.name)
    }
}

/// The points of curves as a table: the name of each curve under `what`, its values under the names of the axes.
pub(super) fn lines(name: &str, what: &str, [x, y]: [&str; 2], curves: &[Curve]) -> Sheet {
    let rows = curves.iter().flat_map(|curve| {
        let points = curve.points.iter();
        points.map(|(x, y)| row![&*curve.name, *x, *y])
    });
    Sheet::new(name, [what, x, y], rows)
}

/// The pieces of a row of points between those that are none, of two points at least.
pub(super) fn pieces<T: Copy>(points: &[Option<T>]) -> Vec<Vec<T>> {
    let pieces = points.split(Option::is_none);
    let pieces = pieces.map(|piece| piece.iter().copied().flatten().collect::<Vec<T>>());
    pieces.filter(|piece| piece.len() > 1).collect()
}

/// The middles of the cells of a row or column.
pub(super) fn middles((low, high): (f64, f64), cells: usize) -> impl Fn(usize) -> f64 + Copy {
    move |cell| low + (high - low) * (cell as f64 + 0.5) / cells as f64
}

/// Lines up through a panel at named places.
pub(super) fn bounds(names: &[(&str, f64)], stroke: Stroke) -> impl Iterator<Item = Layer> {
    let line = move |(name, at): &(&str, f64)| Layer::vertical(*at, stroke, *name);
    names.iter().map(line)
}
