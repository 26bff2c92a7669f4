//! The chart of a motion: position, velocity and contact force over time with its phases shaded,
//! and the phase plane.

use kuva::backend::svg::SvgBackend;
use kuva::plot::LinePlot;
use kuva::plot::legend::{LegendEntry, LegendShape};
use kuva::render::annotations::{ReferenceLine, ShadedRegion};
use kuva::render::figure::Figure;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use softstop::{Dimension, Machine, PhaseKind};

use softstop_draw::style;

/// A motion as it is drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drawing {
    /// Time in s, position in m, velocity in m/s, contact force in N.
    pub points: Vec<[f64; 4]>,
    /// Phase, begin and end in s, in order of time.
    pub phases: Vec<(PhaseKind, f64, f64)>,
}

/// The chart of a motion.
#[derive(Debug, Clone)]
pub struct MotionChart {
    /// What is drawn.
    pub drawing: Drawing,
    /// Its title.
    pub title: String,
    /// The names of its quantities.
    pub names: [String; 4],
    /// The positions in m at which laws change.
    pub faces: Vec<f64>,
}

/// Names of the quantities of [`Drawing::points`] in a machine's units.
#[must_use]
pub fn names(machine: &Machine) -> [String; 4] {
    [
        machine.label("time t", "", Dimension::Time),
        machine.label("position x", "", Dimension::Length),
        machine.label("velocity v", "", Dimension::Velocity),
        machine.label("contact force F", "", Dimension::Force),
    ]
}

impl MotionChart {
    /// The chart as an SVG document.
    #[must_use]
    pub fn svg(&self) -> String {
        let [position, velocity, force] = [1, 2, 3].map(|row| (self.line(0, row), row));
        let mut figure = Figure::new(3, 2)
            .with_structure(vec![vec![0], vec![2], vec![4], vec![1, 3, 5]])
            .with_plots(vec![
                vec![position.0],
                vec![velocity.0],
                vec![force.0],
                vec![self.line(1, 2)],
            ])
            .with_layouts(vec![
                self.series(position.1),
                self.series(velocity.1),
                self.series(force.1),
                self.plane(),
            ])
            .with_title(self.title.clone())
            .with_cell_size(560.0, 240.0)
            .with_col_width(0, 720.0);
        let legend = self.legend();
        if !legend.is_empty() {
            figure = figure
                .with_shared_legend_bottom()
                .with_shared_legend_entries(legend);
        }
        SvgBackend::new()
            .with_pretty(true)
            .render_scene(&figure.render())
    }

    fn line(&self, across: usize, up: usize) -> Plot {
        let points = self.drawing.points.iter();
        Plot::Line(
            LinePlot::new()
                .with_data(points.map(|point| (point[across], point[up])))
                .with_color(style::POINT)
                .with_stroke_width(1.3),
        )
    }

    /// A time series.
    fn series(&self, row: usize) -> Layout {
        let (left, right) = self.exact(0);
        let mut layout = style::plain((left, right), self.padded(row))
            .with_x_label(self.names[0].clone())
            .with_y_label(self.names[row].clone())
            .with_ticks(5);
        for &(kind, begin, end) in &self.drawing.phases {
            if let Some(color) = color(kind) {
                let region = ShadedRegion::vertical(begin.max(left), end.min(right));
                layout = layout.with_shaded_region(region.with_color(color).with_opacity(1.0));
            }
        }
        if row == 1 {
            layout = self.with_faces(layout, ReferenceLine::horizontal);
        }
        layout
    }

    fn plane(&self) -> Layout {
        let layout = style::plain(self.padded(1), self.padded(2))
            .with_x_label(self.names[1].clone())
            .with_y_label(self.names[2].clone())
            .with_ticks(6);
        self.with_faces(layout, ReferenceLine::vertical)
    }

    fn with_faces(&self, layout: Layout, line: fn(f64) -> ReferenceLine) -> Layout {
        self.faces.iter().fold(layout, |layout, &face| {
            layout.with_reference_line(
                line(face)
                    .with_color(style::ASIDE)
                    .with_stroke_width(1.0)
                    .with_dasharray("5 4"),
            )
        })
    }

    /// Range of a quantity.
    fn exact(&self, row: usize) -> (f64, f64) {
        let values = self.drawing.points.iter().map(|point| point[row]);
        let low = values.clone().fold(f64::INFINITY, f64::min);
        let high = values.fold(f64::NEG_INFINITY, f64::max);
        (low, high)
    }

    fn padded(&self, row: usize) -> (f64, f64) {
        let (low, high) = self.exact(row);
        let room = if high > low { 0.06 * (high - low) } else { 1.0 };
        (low - room, high + room)
    }

    /// The phases that are shaded.
    fn legend(&self) -> Vec<LegendEntry> {
        let mut kinds: Vec<PhaseKind> = Vec::new();
        for &(kind, _, _) in &self.drawing.phases {
            if !kinds.contains(&kind) {
                kinds.push(kind);
            }
        }
        let entry = |kind: PhaseKind| {
            Some(LegendEntry {
                label: crate::simulate::name(kind).to_owned(),
                color: color(kind)?.to_owned(),
                shape: LegendShape::Rect,
                dasharray: None,
            })
        };
        kinds.into_iter().filter_map(entry).collect()
    }
}

/// Tints of Okabe and Ito's colours for the phases, grey for a mass at rest; free flight stays
/// white.
pub const fn color(kind: PhaseKind) -> Option<&'static str> {
    match kind {
        PhaseKind::Free => None,
        PhaseKind::Pierce => Some("#F4D48C"),
        PhaseKind::Cut => Some("#F8F3AA"),
        PhaseKind::Gap => Some("#E0E0E0"),
        PhaseKind::Stop => Some("#B3DDF5"),
        PhaseKind::Released => Some("#8CD3C0"),
        PhaseKind::Chatter => Some("#E8C3D7"),
        PhaseKind::Stuck => Some("#E28E4D"),
        PhaseKind::Resting => Some("#A9A9A9"),
    }
}
