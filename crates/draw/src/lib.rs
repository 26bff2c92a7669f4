//! A picture is data: a [`Chart`] has [`Panel`]s in a grid, a panel has two [`Axis`] and [`Layer`]s between them, the first
//! one at the back. Places are values of the axes. Ranges, round values at the axes, margins and legend follow from what is
//! drawn, so that no caller states lengths on the page. One renderer makes an SVG document ([`Chart::svg`]), PNG
//! ([`Chart::png`]) and an element of an HTML page in its colours, light or dark ([`Chart::inline`]).
//!
//! ```
//! use softstop_draw::{Axis, Chart, Layer, Legend, Mark, Panel, Stroke, style};
//!
//! let curve = [(1.0, 3.0), (1.2, 8.1), (1.37, 17.0)];
//! let layers = [
//!     Layer::boxes([[(1.1, 1.3), (0.0, f64::INFINITY)]], style::ALLOWED, 0.2).named("allowed"),
//!     Layer::line(curve, Stroke::solid(style::DESIGN, 2.4)).named("stable"),
//!     Layer::marks([curve[2]], Mark::Circle, style::OPTIMUM).named("fold (SN)"),
//!     Layer::vertical(1.37, Stroke::dashed(style::ASIDE, 1.0, (5.0, 4.0)), "s_SN"),
//! ];
//! let velocity = Axis::new("before-impact velocity X′₋").from(0.0);
//! let panel = Panel::new(Axis::new("drive frequency η = ω/Ω"), velocity, layers);
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
//!   [`Chart::shares_x`] and [`Chart::shares_y`].
//! - Axes: [`Axis::range`], [`Axis::from`], [`Axis::log`] (values stay what they are), [`Axis::ticks`] (own values and
//!   words, so categories, too), [`Axis::bare`] (nothing written).
//! - Layers: lines, contours, dots, marks, bands, boxes (of infinite ends: whole stripes), cells, shades with their bar, rings,
//!   horizontal and vertical lines with their names, arrows, directions, texts, labels that make room for each other, messages.
//! - Legends: a layer that is [`Layer::named`] has an entry; layers of one name share it; [`Layer::key`] is an entry alone; a
//!   second line of a name stands below the first. [`Panel::legend`] explains the layers of a panel inside it.
//! - Colours are those of [`style`]: each means one thing in all pictures.
//! - `s_SN` is written with SN below the line in all texts.
//!
//! Back end: `layout` places panels by the texts at their axes, `paint` draws what is inside of one, `border` what is around
//! it, on a `canvas` of plain shapes.
#![forbid(unsafe_code)]

mod axis;
mod border;
mod canvas;
mod chart;
mod frame;
mod grid;
mod index;
mod layer;
mod layout;
mod legend;
mod mark;
mod names;
mod paint;
mod render;
mod scale;
mod shade;
mod stroke;
pub mod style;

pub use chart::{Axis, Chart, Corner, Legend, Panel};
pub use index::split_indices;
pub use layer::Layer;
pub use mark::{Align, Mark, Sign};
pub use scale::{around, power_of_ten};
pub use stroke::Stroke;
