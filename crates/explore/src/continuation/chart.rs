//! Branches of periodic motions and curves of their bifurcations.

use kuva::backend::svg::SvgBackend;
use kuva::plot::legend::LegendPosition;
use kuva::plot::scatter::MarkerShape;
use kuva::plot::{LinePlot, LineStyle, ScatterPlot};
use kuva::render::plots::Plot;
use kuva::render::render::{collect_legend_entries, render_multiple};
use softstop::{Dimension, Machine, Parameter};
use softstop_dynamics::continuation::{Branch, BranchPoint, Curve, Special, SpecialKind, Test};

use softstop_draw::scale::around;
use softstop_draw::style;

/// The impact velocities of branches over the parameter.
#[derive(Debug, Clone)]
pub struct BranchChart<'a> {
    machine: &'a Machine,
    parameter: Parameter,
    branches: &'a [Branch],
}

/// Curves of special points in the plane of two parameters.
#[derive(Debug, Clone)]
pub struct CurveChart<'a> {
    machine: &'a Machine,
    parameters: [Parameter; 2],
    curves: &'a [Curve],
}

/// Symbol, name, colour, marker and line of a kind of special points.
type Sign = (
    &'static str,
    &'static str,
    &'static str,
    MarkerShape,
    LineStyle,
);

fn sign(kind: &SpecialKind) -> Sign {
    match kind {
        SpecialKind::Critical(Test::Fold) => (
            "SN",
            "fold (SN)",
            style::OPTIMUM,
            MarkerShape::Circle,
            LineStyle::Solid,
        ),
        SpecialKind::Critical(Test::Flip) => (
            "PD",
            "flip (PD)",
            style::DESIGN,
            MarkerShape::Square,
            LineStyle::Dashed,
        ),
        SpecialKind::Critical(Test::NeimarkSacker) => (
            "NS",
            "Neimark-Sacker (NS)",
            style::REFERENCE,
            MarkerShape::Triangle,
            LineStyle::DashDot,
        ),
        SpecialKind::Grazing(_) => (
            "G",
            "grazing (G)",
            style::POINT,
            MarkerShape::Diamond,
            LineStyle::Dotted,
        ),
    }
}

/// Room around what is drawn, as a share of it.
const ROOM: f64 = 0.06;
/// Colours of branches by the number of doublings.
const COLOURS: [&str; 4] = [style::DESIGN, style::REFERENCE, "#009E73", "#CC79A7"];

impl<'a> BranchChart<'a> {
    /// The chart of branches along a parameter.
    #[must_use]
    pub fn new(machine: &'a Machine, parameter: Parameter, branches: &'a [Branch]) -> Self {
        Self {
            machine,
            parameter,
            branches,
        }
    }

    /// The picture as an SVG document.
    #[must_use]
    pub fn svg(&self) -> String {
        let mut plots = Vec::new();
        let mut named: Vec<(u64, bool)> = Vec::new();
        for branch in self.branches {
            let order = (branch.periods / self.branches[0].periods).ilog2() as usize;
            plots.extend(lines(branch, COLOURS[order % COLOURS.len()], &mut named));
        }
        plots.extend(marks(self.branches));
        let points = || {
            let points = self.branches.iter().flat_map(|branch| &branch.points);
            points.map(|point| (point.parameter, point.before_impact_velocity()))
        };
        let x = around(points().map(|point| point.0), ROOM);
        let (_, top) = around(points().map(|point| point.1), ROOM);
        let top = if top > 0.0 { top } else { 1.0 };
        render(
            plots,
            (x, (-0.03 * top, top)),
            &self.machine.label_of(self.parameter),
            &self
                .machine
                .label("before-impact velocity", "X′₋", Dimension::Velocity),
            "Periodic motions: stable solid, unstable dashed",
        )
    }
}

impl<'a> CurveChart<'a> {
    /// The chart of curves in two parameters.
    #[must_use]
    pub fn new(machine: &'a Machine, parameters: [Parameter; 2], curves: &'a [Curve]) -> Self {
        Self {
            machine,
            parameters,
            curves,
        }
    }

    /// The picture as an SVG document.
    #[must_use]
    pub fn svg(&self) -> String {
        let mut named = Vec::new();
        let mut plots = Vec::new();
        for curve in self.curves {
            let (symbol, name, colour, _, line) = sign(&curve.kind);
            let data: Vec<_> = curve
                .points
                .iter()
                .map(|point| point.parameters.into())
                .collect();
            let data: Vec<(f64, f64)> = data;
            let plot = LinePlot::new()
                .with_data(data)
                .with_color(colour)
                .with_stroke_width(2.2)
                .with_line_style(line);
            plots.push(Plot::Line(if named.contains(&symbol) {
                plot
            } else {
                named.push(symbol);
                plot.with_legend(name)
            }));
        }
        let values = |index: usize| {
            let points = self.curves.iter().flat_map(|curve| &curve.points);
            around(points.map(|point| point.parameters[index]), ROOM)
        };
        render(
            plots,
            (values(0), values(1)),
            &self.machine.label_of(self.parameters[0]),
            &self.machine.label_of(self.parameters[1]),
            "Bifurcations of periodic motions",
        )
    }
}

fn render(
    plots: Vec<Plot>,
    (x, y): ((f64, f64), (f64, f64)),
    x_label: &str,
    y_label: &str,
    title: &str,
) -> String {
    let layout = style::plain(x, y)
        .with_width(1040.0)
        .with_height(620.0)
        .with_title(title)
        .with_x_label(x_label)
        .with_y_label(y_label)
        .with_legend_entries(collect_legend_entries(&plots))
        .with_legend_position(LegendPosition::OutsideRightTop);
    SvgBackend::new()
        .with_pretty(true)
        .render_scene(&render_multiple(plots, layout))
}

/// Pieces of one stability and one number of impacts, a line for each impact, the hardest first; the name
/// of each kind but once.
fn lines(branch: &Branch, colour: &str, named: &mut Vec<(u64, bool)>) -> Vec<Plot> {
    let mut plots = Vec::new();
    for piece in pieces(branch) {
        let stable = is_stable(&piece);
        let ranks = piece.iter().map(|point| point.impacts.len()).max();
        for rank in 0..ranks.unwrap_or(0).max(1) {
            let data: Vec<_> = piece
                .iter()
                .map(|point| (point.parameter, ranked(point, rank)))
                .collect();
            let plot = LinePlot::new()
                .with_data(data)
                .with_color(colour)
                .with_stroke_width(if stable { 2.4 } else { 1.4 })
                .with_line_style(if stable {
                    LineStyle::Solid
                } else {
                    LineStyle::Dashed
                });
            let kind = (branch.periods, stable);
            plots.push(Plot::Line(if named.contains(&kind) {
                plot
            } else {
                named.push(kind);
                let word = if stable { "stable" } else { "unstable" };
                plot.with_legend(format!("period {}, {word}", branch.periods))
            }));
        }
    }
    plots
}

/// The velocity of an orbit's impact of this rank; 0 where it has none.
fn ranked(point: &BranchPoint, rank: usize) -> f64 {
    let mut velocities = point.impacts.clone();
    velocities.sort_by(|a, b| b.total_cmp(a));
    velocities.get(rank).copied().unwrap_or(0.0)
}

/// Stretches between special points.
fn pieces(branch: &Branch) -> Vec<Vec<&BranchPoint>> {
    let mut pieces = vec![Vec::new()];
    for point in &branch.points {
        let last = pieces.len() - 1;
        pieces[last].push(point);
        if is_special(branch, point) {
            pieces.push(vec![point]);
        }
    }
    pieces.retain(|piece| piece.len() > 1);
    pieces
}

fn is_special(branch: &Branch, point: &BranchPoint) -> bool {
    branch
        .specials
        .iter()
        .any(|special| special.point.state() == point.state())
}

/// By a point inside: the ends of a stretch are on the border.
fn is_stable(piece: &[&BranchPoint]) -> bool {
    match piece {
        [one, other] => one.is_stable() && other.is_stable(),
        _ => piece[piece.len() / 2].is_stable(),
    }
}

/// The special points, a mark for each kind.
fn marks(branches: &[Branch]) -> Vec<Plot> {
    let specials: Vec<&Special> = branches
        .iter()
        .flat_map(|branch| &branch.specials)
        .collect();
    let mut plots = Vec::new();
    for symbol in ["SN", "PD", "NS", "G"] {
        let of_kind = specials
            .iter()
            .filter(|special| special.kind.symbol() == symbol);
        let data: Vec<_> = of_kind
            .clone()
            .map(|special| {
                let point = &special.point;
                (point.parameter, point.before_impact_velocity())
            })
            .collect();
        let Some(first) = of_kind.clone().next() else {
            continue;
        };
        let (_, name, colour, shape, _) = sign(&first.kind);
        plots.push(Plot::Scatter(
            ScatterPlot::new()
                .with_data(data)
                .with_color(colour)
                .with_marker(shape)
                .with_size(6.0)
                .with_legend(name),
        ));
    }
    plots
}
