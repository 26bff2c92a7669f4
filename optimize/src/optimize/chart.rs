//! The chart of a design: before-impact velocity over drive frequency, in the paper's symbols.

use kuva::backend::svg::SvgBackend;
use kuva::plot::scatter::MarkerShape;
use kuva::plot::{LinePlot, LineStyle, ScatterPlot};
use kuva::render::annotations::{ReferenceLine, ShadedRegion, TextAnnotation};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::{collect_legend_entries, render_multiple};
use softstop_dynamics::zone;

use softstop::{Dimension, Language, Machine, Parameter};
use softstop_draw::style::{self, Frame};

use super::branch::Branch;
use super::reference::Reference;
use crate::design::Design;

/// What the chart shows, in the machine's own units.
#[derive(Debug, Clone)]
pub struct Chart {
    machine: Machine,
    /// The motions of the design's zone.
    branch: Branch,
    /// Frequencies that the margin leaves.
    allowed: (f64, f64),
    /// Frequency and before-impact velocity of the design.
    design: (f64, f64),
    reference: Option<Beside>,
    /// What the band of allowed frequencies is called.
    allowance: String,
    title: String,
}

/// The motion beside which the design stands.
#[derive(Debug, Clone)]
struct Beside {
    name: String,
    /// Frequency and before-impact velocity.
    point: (f64, f64),
    /// The motions of its zone.
    branch: Option<Branch>,
}

const SUBTITLE: &str = "before-impact velocity of the stable z = 1 motion in its hysteresis zone";

impl Chart {
    /// The chart of a design with margin M, beside a motion.
    pub(super) fn new(design: &Design, margin: f64, reference: Option<&Reference>) -> Self {
        let machine = &design.machine;
        let own = |frequency| machine.to_own(Dimension::Frequency, frequency);
        let name = machine.name.as_deref().unwrap_or("given");
        Self {
            branch: Branch::new(machine, &design.zone, label("design", machine)),
            allowed: (
                own(design.zone.frequency_at(margin)),
                own(design.zone.frequency_at(1.0 - margin)),
            ),
            design: (design.frequency(), design.before_impact_velocity()),
            reference: reference.map(Beside::new),
            allowance: format!("allowed by margin M = {margin}"),
            title: format!("Hardest impact of the {name} machine"),
            machine: machine.clone(),
        }
    }

    /// The chart as an SVG document.
    #[must_use]
    pub fn svg(&self) -> String {
        let frame = self.frame();
        let plots = self.plots();
        let frequency = self.machine.label_of(Parameter::Frequency);
        let velocity = self.velocity_label();
        let layout = style::layout(&frame, &self.title, SUBTITLE)
            .with_x_label(frequency)
            .with_y_label(velocity)
            .with_legend_entries(collect_legend_entries(&plots));
        let scene = render_multiple(plots, self.annotations(layout, &frame));
        SvgBackend::new().with_pretty(true).render_scene(&scene)
    }

    fn velocity_label(&self) -> String {
        self.machine
            .label("before-impact velocity", "X′₋", Dimension::Velocity)
    }

    fn frame(&self) -> Frame {
        let beside = self
            .reference
            .iter()
            .filter_map(|beside| beside.branch.as_ref());
        let curves = beside
            .chain([&self.branch])
            .flat_map(|branch| branch.pieces.iter().flatten().copied());
        let points = self.reference.iter().map(|beside| beside.point);
        Frame::around(
            &curves
                .chain(points)
                .chain([self.design])
                .collect::<Vec<_>>(),
        )
    }

    fn plots(&self) -> Vec<Plot> {
        let mark = |point: (f64, f64), color: &str, shape, size, name: &str| {
            ScatterPlot::new()
                .with_data([point])
                .with_color(color)
                .with_marker(shape)
                .with_size(size)
                .with_legend(self.legend(name, point))
        };
        let optimum = mark(
            self.design,
            style::OPTIMUM,
            MarkerShape::Star,
            10.0,
            "optimum",
        );
        let mut plots = lines(&self.branch, style::DESIGN, LineStyle::Solid);
        plots.push(Plot::Scatter(optimum));
        if let Some(beside) = &self.reference {
            if let Some(branch) = &beside.branch {
                plots.extend(lines(branch, style::REFERENCE, LineStyle::Dashed));
            }
            let name = format!("point {}", beside.name);
            plots.push(Plot::Scatter(mark(
                beside.point,
                style::POINT,
                MarkerShape::Circle,
                6.0,
                &name,
            )));
        }
        plots
    }

    fn legend(&self, name: &str, (frequency, velocity): (f64, f64)) -> String {
        match self.machine.speaks {
            Language::Ratios => format!("{name}: η = {frequency:.3}, X′₋ = {velocity:.2}"),
            _ => {
                let unit = self.machine.unit(Dimension::Frequency);
                let (frequency, velocity) = (digits(frequency), digits(velocity));
                format!("{name}: {frequency} {unit}, {velocity} m/s")
            }
        }
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
        let layout = layout
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
            ));
        self.reference.iter().fold(layout, |layout, beside| {
            layout.with_annotation(frame.beside(beside.point, &beside.name))
        })
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

impl Beside {
    fn new(reference: &Reference) -> Self {
        let machine = &reference.machine;
        let zone = zone::hysteresis(&machine.scene).ok();
        let named = match reference.name {
            "given" => "as given".to_owned(),
            point => format!("paper's {point}"),
        };
        Self {
            name: reference.name.to_owned(),
            point: (
                machine.value(Parameter::Frequency).unwrap_or(f64::NAN),
                reference.orbit.before_impact_velocity(),
            ),
            branch: zone.map(|zone| Branch::new(machine, &zone, label(&named, machine))),
        }
    }
}

/// What it is, with the stop and the clearance that it has.
fn label(name: &str, machine: &Machine) -> String {
    let value = |parameter| machine.value(parameter);
    let stiffness = value(Parameter::StopStiffness);
    let clearance = value(Parameter::Clearance).unwrap_or(f64::NAN);
    match (machine.speaks, stiffness) {
        (Language::Ratios, Some(stiffness)) => {
            format!("{name}: k₄/k₁ = {stiffness:.2}, ρ = {clearance:.2}")
        }
        (Language::Ratios, None) => format!("{name}: ρ = {clearance:.2}"),
        (_, Some(stiffness)) => {
            let (stiffness, clearance) = (digits(stiffness), digits(clearance));
            format!("{name}: stop {stiffness} N/m, clearance {clearance} m")
        }
        (_, None) => format!("{name}: clearance {} m", digits(clearance)),
    }
}

/// A number with four digits.
fn digits(value: f64) -> String {
    if value == 0.0 || (1e-3..1e5).contains(&value.abs()) {
        let places = 3 - value.abs().max(1e-3).log10().floor() as i32;
        format!("{value:.*}", places.max(0) as usize)
    } else {
        format!("{value:.3e}")
    }
}
