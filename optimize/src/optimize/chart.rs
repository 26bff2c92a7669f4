//! The chart of a design: before-impact velocity over drive frequency, in the paper's symbols.

use kuva::backend::svg::SvgBackend;
use kuva::plot::scatter::MarkerShape;
use kuva::plot::{LinePlot, LineStyle, ScatterPlot};
use kuva::render::annotations::{ReferenceLine, ShadedRegion, TextAnnotation};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::{collect_legend_entries, render_multiple};
use softstop_dynamics::orbit::Orbit;
use softstop_dynamics::zone::{self, ZoneError};

use super::branch::Branch;
use crate::design::Design;
use softstop_console::machine::Regime;
use softstop_draw::style::{self, Frame};

/// What the chart shows.
#[derive(Debug, Clone)]
pub struct Chart {
    /// The motions of the design's zone.
    branch: Branch,
    /// Frequencies that the margin leaves.
    allowed: (f64, f64),
    /// eta and X'- of the design.
    design: (f64, f64),
    /// The motions of the zone of the paper's point.
    reference_branch: Branch,
    /// eta and X'- of the paper's point.
    reference: (f64, f64),
    /// The paper's name of its point.
    reference_name: &'static str,
    /// What the band of allowed frequencies is called.
    allowance: String,
    title: String,
    subtitle: String,
}

impl Chart {
    /// The chart of a design with margin M, beside the paper's point of the same regime.
    ///
    /// # Errors
    /// [`ZoneError`] if the paper's point has no zone.
    pub fn new(
        design: &Design,
        margin: f64,
        regime: Regime,
        reference: &Orbit,
    ) -> Result<Self, ZoneError> {
        let paper = regime.ratios();
        let name = regime.point();
        let ratios = &design.ratios;
        Ok(Self {
            branch: Branch::new(
                &design.zone,
                label("design", ratios.stiffness, ratios.clearance),
            ),
            allowed: (
                design.zone.frequency_at(margin),
                design.zone.frequency_at(1.0 - margin),
            ),
            design: (ratios.frequency, design.before_impact_velocity()),
            reference_branch: Branch::new(
                &zone::hysteresis(&paper.scene()?)?,
                label(&format!("paper's {name}"), paper.stiffness, paper.clearance),
            ),
            reference: (paper.frequency, reference.before_impact_velocity()),
            reference_name: name,
            allowance: format!("allowed by margin M = {margin}"),
            title: format!("Hardest impact of the {} machine", regime.name()),
            subtitle: "before-impact velocity of the stable z = 1 motion in its hysteresis zone"
                .into(),
        })
    }

    /// The chart as an SVG document.
    #[must_use]
    pub fn svg(&self) -> String {
        let frame = self.frame();
        let plots = self.plots();
        let layout = style::layout(&frame, &self.title, &self.subtitle)
            .with_legend_entries(collect_legend_entries(&plots));
        let scene = render_multiple(plots, self.annotations(layout, &frame));
        SvgBackend::new().with_pretty(true).render_scene(&scene)
    }

    fn frame(&self) -> Frame {
        let branches = [&self.branch, &self.reference_branch];
        let curves = branches
            .into_iter()
            .flat_map(|branch| branch.pieces.iter().flatten().copied());
        Frame::around(
            &curves
                .chain([self.design, self.reference])
                .collect::<Vec<_>>(),
        )
    }

    fn plots(&self) -> Vec<Plot> {
        let mark = |point: (f64, f64), color: &str, shape, size, label: String| {
            ScatterPlot::new()
                .with_data([point])
                .with_color(color)
                .with_marker(shape)
                .with_size(size)
                .with_legend(label)
        };
        let (eta, velocity) = self.reference;
        let name = self.reference_name;
        let point = mark(
            self.reference,
            style::POINT,
            MarkerShape::Circle,
            6.0,
            format!("point {name}: η = {eta:.3}, X′₋ = {velocity:.2}"),
        );
        let (eta, velocity) = self.design;
        let optimum = mark(
            self.design,
            style::OPTIMUM,
            MarkerShape::Star,
            10.0,
            format!("optimum: η = {eta:.3}, X′₋ = {velocity:.2}"),
        );
        let mut plots = lines(&self.branch, style::DESIGN, LineStyle::Solid);
        plots.push(Plot::Scatter(optimum));
        plots.extend(lines(
            &self.reference_branch,
            style::REFERENCE,
            LineStyle::Dashed,
        ));
        plots.push(Plot::Scatter(point));
        plots
    }

    fn annotations(&self, layout: Layout, frame: &Frame) -> Layout {
        let end = |frequency: f64, name: &str| {
            ReferenceLine::vertical(frequency)
                .with_color(style::DESIGN)
                .with_stroke_width(1.2)
                .with_dasharray("5 4")
                .with_label(name)
        };
        let (low, high) = self.allowed;
        let middle = f64::midpoint(low, high);
        layout
            .with_shaded_region(
                ShadedRegion::vertical(low, high)
                    .with_color(style::ALLOWED)
                    .with_opacity(0.18),
            )
            .with_reference_line(end(self.branch.frequency_g0, "g₀"))
            .with_reference_line(end(self.branch.frequency_sn, "s_SN"))
            .with_annotation(TextAnnotation::new(
                &self.allowance,
                middle,
                frame.near_top(),
            ))
            .with_annotation(frame.beside(self.reference, self.reference_name))
    }
}

/// The pieces of a branch, the first one named in the legend.
fn lines(branch: &Branch, color: &str, line: LineStyle) -> Vec<Plot> {
    let plot = |piece: &Vec<(f64, f64)>| {
        LinePlot::new()
            .with_data(piece.clone())
            .with_color(color)
            .with_stroke_width(2.5)
            .with_line_style(line.clone())
    };
    let mut pieces = branch.pieces.iter().map(plot);
    let first = pieces
        .next()
        .map(|piece| piece.with_legend(branch.label.clone()));
    first.into_iter().chain(pieces).map(Plot::Line).collect()
}

fn label(name: &str, stiffness: f64, clearance: f64) -> String {
    format!("{name}: k₄/k₁ = {stiffness:.2}, ρ = {clearance:.2}")
}
