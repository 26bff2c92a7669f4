//! Pictures inside the page, with their words.

use softstop_draw::{Chart, Layer, Legend, Panel, Stroke, style};

use super::words::plain;

/// Width and height of a picture that takes a whole line of the page, and of one that takes half of it.
pub(super) const WIDE: (f64, f64) = (980.0, 460.0);
pub(super) const HALF: (f64, f64) = (480.0, 400.0);
/// The line of what bounds something.
pub(super) const BOUND: Stroke = Stroke::dashed(style::ASIDE, 1.3, (5.0, 4.0));

/// A picture with its words.
#[derive(Debug, Clone, serde::Serialize)]
pub(super) struct Figure {
    /// Above it.
    pub(super) title: String,
    /// The picture as SVG elements.
    pub(super) svg: String,
    /// What it shows, in a sentence or two.
    pub(super) caption: String,
    /// Whether it takes a whole line.
    pub(super) is_wide: bool,
}

impl Figure {
    /// Panels beside each other on a picture of this size, its legend above them.
    pub(super) fn new(
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
        let chart = chart.in_columns(2);
        Self {
            svg: chart.inline(plain),
            title: chart.title,
            caption: caption.into(),
            is_wide: size == WIDE,
        }
    }
}

/// Lines up through a panel at named places.
pub(super) fn bounds(names: &[(String, f64)], stroke: Stroke) -> impl Iterator<Item = Layer> {
    let line = move |(name, at): &(String, f64)| Layer::vertical(*at, stroke, name);
    names.iter().map(line)
}

/// Pairs of numbers as points.
pub(super) fn points(pairs: &[[f64; 2]]) -> impl Iterator<Item = (f64, f64)> {
    pairs.iter().map(|[x, y]| (*x, *y))
}
