//! Branches of periodic motions and curves of their bifurcations.

use softstop::{Dimension, Machine, Parameter};
use softstop_draw::style::{self, bifurcation};
use softstop_draw::{Axis, Chart, Layer, Legend, Mark, Panel, Stroke};
use softstop_dynamics::continuation::{CodimensionTwo, Curve, SpecialKind, TestFunction};
use softstop_dynamics::{Branch, BranchPoint};

/// Name, mark and line of a kind of special points.
fn sign(kind: &SpecialKind) -> (&'static str, Mark, Stroke) {
    let dashed = |color, dashes| Stroke::dashed(color, 2.2, dashes);
    match kind {
        SpecialKind::Critical(TestFunction::Fold) => {
            let line = Stroke::solid(bifurcation::FOLD, 2.2);
            ("fold (SN)", Mark::Circle, line)
        }
        SpecialKind::Critical(TestFunction::Flip) => {
            let line = dashed(bifurcation::FLIP, (9.0, 5.0));
            ("flip (PD)", Mark::Square, line)
        }
        SpecialKind::Critical(TestFunction::NeimarkSacker) => {
            let line = dashed(bifurcation::NEIMARK_SACKER, (9.0, 3.0));
            ("Neimark-Sacker (NS)", Mark::Triangle, line)
        }
        SpecialKind::Pitchfork => {
            let line = dashed(bifurcation::FOLD, (9.0, 3.0));
            ("pitchfork (PF)", Mark::Triangle, line)
        }
        SpecialKind::Grazing(_) => {
            let line = dashed(bifurcation::GRAZING, (2.0, 4.0));
            ("grazing (G)", Mark::Diamond, line)
        }
    }
}

/// The before-impact velocities of branches over the parameter, as an SVG document.
pub fn branches(machine: &Machine, parameter: Parameter, branches: &[Branch]) -> String {
    let (stable, unstable): (Vec<_>, Vec<_>) = branches
        .iter()
        .flat_map(pieces)
        .partition(|piece| is_stable(&piece.1));
    let lines = stable.iter().chain(&unstable).flat_map(|(branch, piece)| {
        let order = (branch.periods / branches[0].periods).ilog2() as usize;
        lines(branch, piece, style::SERIES[order % style::SERIES.len()])
    });
    let specials = branches.iter().flat_map(|branch| &branch.specials);
    let specials = specials.map(|special| {
        let (name, mark, line) = sign(&special.kind);
        let point = &special.point;
        let place = (point.parameter, point.before_impact_velocity());
        Layer::marks([place], mark, line.color).named(name)
    });
    let points = branches.iter().flat_map(|branch| &branch.points);
    let highest = points.map(BranchPoint::before_impact_velocity);
    let highest = highest.filter(|it| it.is_finite()).fold(0.0, f64::max);
    let velocity = machine.label("before-impact velocity", "X′₋", Dimension::Velocity);
    let up = Axis::new(velocity).from(-0.03 * highest);
    let across = Axis::new(machine.label_of(parameter));
    let panel = Panel::new(across, up, lines.chain(specials));
    chart("Periodic motions: stable solid, unstable dashed", panel)
}

/// Curves of special points in the plane of two parameters, as an SVG document.
pub fn curves(machine: &Machine, parameters: [Parameter; 2], curves: &[Curve]) -> String {
    let lines = curves.iter().map(|curve| {
        let (name, _, line) = sign(&curve.kind);
        let points = curve.points.iter().map(|point| point.parameters.into());
        Layer::line(points, line).named(name)
    });
    let specials = curves.iter().flat_map(|curve| &curve.specials);
    let specials = specials.map(|(kind, point)| {
        let (name, mark) = match kind {
            CodimensionTwo::Cusp => ("cusp (CP)", Mark::Triangle),
            CodimensionTwo::GeneralisedFlip => ("generalised flip (GPD)", Mark::Square),
            _ => ("resonant grazing (RG)", Mark::Diamond),
        };
        Layer::marks(
            [point.parameters.into()],
            mark,
            bifurcation::CODIMENSION_TWO,
        )
        .named(name)
    });
    let [across, upwards] = parameters.map(|it| Axis::new(machine.label_of(it)));
    let panel = Panel::new(across, upwards, lines.chain(specials));
    chart("Bifurcations of periodic motions", panel)
}

fn chart(title: &str, panel: Panel) -> String {
    let chart = Chart {
        legend: Legend::Below,
        ..Chart::new(title, [panel.sized((600.0, 420.0))])
    };
    chart.svg()
}

/// A line for each impact of a piece, the hardest first.
fn lines<'a>(
    branch: &Branch,
    piece: &'a BranchPiece<'_>,
    color: &'static str,
) -> impl Iterator<Item = Layer> + 'a {
    let (stroke, word) = match is_stable(piece) {
        true => (Stroke::solid(color, 2.4), "stable"),
        false => (Stroke::dashed(color, 1.4, (6.0, 4.0)), "unstable"),
    };
    let name = format!("period {}, {word}", branch.periods);
    let ranks = piece.iter().map(|point| point.impacts.len()).max();
    (0..ranks.unwrap_or(0).max(1)).map(move |rank| {
        let points = piece.iter();
        let points = points.map(|point| (point.parameter, ranked(point, rank)));
        Layer::line(points, stroke).named(&name)
    })
}

/// The velocity of an orbit's impact of this rank; 0 where it has none.
fn ranked(point: &BranchPoint, rank: usize) -> f64 {
    let mut velocities = point.impacts.clone();
    velocities.sort_by(|a, b| b.total_cmp(a));
    velocities.get(rank).copied().unwrap_or(0.0)
}

/// Points of one stability and one number of impacts.
type BranchPiece<'a> = [&'a BranchPoint];

/// The parts of a branch between special points.
fn pieces(branch: &Branch) -> impl Iterator<Item = (&Branch, Vec<&BranchPoint>)> {
    let mut pieces = vec![Vec::new()];
    for point in &branch.points {
        let last = pieces.len() - 1;
        pieces[last].push(point);
        if branch.special_at(point).is_some() {
            pieces.push(vec![point]);
        }
    }
    pieces.retain(|piece| piece.len() > 1);
    pieces.into_iter().map(move |piece| (branch, piece))
}

/// By a point inside: the ends of a piece are on the border.
fn is_stable(piece: &BranchPiece<'_>) -> bool {
    match piece {
        [one, other] => one.is_stable() && other.is_stable(),
        _ => piece[piece.len() / 2].is_stable(),
    }
}
