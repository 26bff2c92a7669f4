//! A picture is data: a [`Chart`] has [`Panel`]s in a grid, a panel has two [`Axis`] and [`Layer`]s between them, the first
//! one at the back. Places are values of the axes. Ranges, round values at the axes, margins and legend follow from what is
//! drawn, so that no caller states lengths on the page. One renderer makes an SVG document ([`Chart::svg`]), PNG
//! ([`Chart::png`]) and an element of an HTML page in its colours, light or dark ([`Chart::inline`]).
//!
//! ```
//! use softstop_draw::{Axis, Chart, Layer, Legend, Mark, Panel, Stroke, style};
//!
//! let curve = [(1.0, 3.0), (1.2, 8.1), (1.37, 17.0)];
//! let panel = Panel {
//!     x: Axis::new("drive frequency η = ω/Ω"),
//!     y: Axis::new("before-impact velocity X′₋").from(0.0),
//!     layers: vec![
//!         Layer::boxes([[(1.1, 1.3), (0.0, f64::INFINITY)]], style::ALLOWED, 0.2).named("allowed"),
//!         Layer::line(curve, Stroke::solid(style::DESIGN, 2.4)).named("stable"),
//!         Layer::marks([curve[2]], Mark::Circle, style::OPTIMUM).named("fold (SN)"),
//!         Layer::upwards(1.37, Stroke::dashed(style::ASIDE, 1.0, (5.0, 4.0)), "s_SN"),
//!     ],
//!     ..Panel::default()
//! };
//! let chart = Chart {
//!     subtitle: "the branch from grazing to the fold".to_owned(),
//!     legend: Legend::Right,
//!     ..Chart::new("Hardest impact", [panel])
//! };
//! assert!(chart.svg().starts_with("<svg"));
//! assert!(chart.inline(str::to_owned).contains("var(--design)"));
//! ```
//!
//! - Panels: [`Chart::in_columns`] places them row by row; [`Panel::at`] and [`Panel::span`] say it one by one;
//!   [`Panel::size`] is the room between the axes in pixels, or a weight where [`Chart::page`] is fixed; panels share axes by
//!   [`Chart::shares_across`] and [`Chart::shares_upwards`].
//! - Axes: [`Axis::range`], [`Axis::from`], [`Axis::log`] (values stay what they are), [`Axis::ticks`] (own values and
//!   words, so categories, too), [`Axis::bare`] (nothing written).
//! - Layers: lines, contours, dots, marks, bands, boxes (of infinite ends: whole stripes), cells, shades with their bar, rings,
//!   lines across and upwards with their names, arrows, directions, texts, labels that make room for each other, messages.
//! - Legends: a layer that is [`Layer::named`] has an entry; layers of one name share it; [`Layer::key`] is an entry alone; a
//!   second line of a name stands below the first. [`Panel::legend`] explains the layers of a panel inside it.
//! - Colours are those of [`style`]: each means one thing in all pictures.
//! - `s_SN` is written with SN below the line in all texts.
//!
//! Back end: [`pen`] (plain shapes), [`shapes`] (made of others), [`stroke`] (lines), [`panel`] (a frame and what is cut at
//! it), [`scale`] (ranges and round values), [`shade`] (colours of numbers), [`index`] (indices below the line), [`table`] (a
//! table as a picture).
#![forbid(unsafe_code)]

mod axes;
mod between;
mod chart;
pub mod index;
mod layer;
mod layout;
mod legend;
pub mod panel;
pub mod pen;
mod render;
pub mod scale;
pub mod shade;
pub mod shapes;
pub mod stroke;
pub mod style;
pub mod table;

pub use chart::{Axis, Chart, Corner, Legend, Panel};
pub use layer::Layer;
pub use pen::Align;
pub use shapes::{Mark, Sign};
pub use stroke::Stroke;
