//! Branches of periodic motions and curves of their bifurcations.

use softstop::{Dimension, Machine, Parameter};
use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Pen, Stroke};
use softstop_draw::scale::around;
use softstop_draw::shapes::{Mark, Sign};
use softstop_draw::style;
use softstop_dynamics::continuation::{Curve, SpecialKind, Test};
use softstop_dynamics::{Branch, BranchPoint};

/// Name, mark and line of a kind of special points.
fn sign(kind: &SpecialKind) -> (&'static str, Mark, Stroke) {
    let (solid, dashed) = (Stroke::solid, Stroke::dashed);
    match kind {
        SpecialKind::Critical(Test::Fold) => {
            ("fold (SN)", Mark::Circle, solid(style::OPTIMUM, 2.2))
        }
        SpecialKind::Critical(Test::Flip) => {
            let line = dashed(style::DESIGN, 2.2, (9.0, 5.0));
            ("flip (PD)", Mark::Square, line)
        }
        SpecialKind::Critical(Test::NeimarkSacker) => {
            let line = dashed(style::REFERENCE, 2.2, (9.0, 3.0));
            ("Neimark-Sacker (NS)", Mark::Triangle, line)
        }
        SpecialKind::Grazing(_) => {
            let line = dashed(style::POINT, 2.2, (2.0, 4.0));
            ("grazing (G)", Mark::Diamond, line)
        }
    }
}

/// Room around what is drawn, as a share of it.
const ROOM: f64 = 0.06;
/// Colours of branches by the number of doublings.
const COLOURS: [&str; 4] = [style::DESIGN, style::REFERENCE, "#009E73", "#882255"];
/// The page, and the panel on it.
const PAGE: (f64, f64) = (1040.0, 620.0);
const AREA: (f64, f64, f64, f64) = (92.0, 84.0, 720.0, 460.0);
/// Letters.
const LETTERS: u32 = 14;
/// Half the size of marks.
const MARK: f64 = 6.0;

/// The before-impact velocities of branches over the parameter, as an SVG document.
pub fn branches(machine: &Machine, parameter: Parameter, branches: &[Branch]) -> String {
    let points = || {
        let points = branches.iter().flat_map(|branch| &branch.points);
        points.map(|point| (point.parameter, point.before_impact_velocity()))
    };
    let (_, top) = around(points().map(|point| point.1), ROOM);
    let top = if top > 0.0 { top } else { 1.0 };
    let page = Page {
        title: "Periodic motions: stable solid, unstable dashed",
        x: around(points().map(|point| point.0), ROOM),
        y: (-0.03 * top, top),
        across: machine.label_of(parameter),
        upwards: machine.label("before-impact velocity", "X′₋", Dimension::Velocity),
    };
    page.svg(|pen, panel| {
        let mut entries = Vec::new();
        for branch in branches {
            let order = (branch.periods / branches[0].periods).ilog2() as usize;
            lines(
                pen,
                panel,
                (branch, COLOURS[order % COLOURS.len()]),
                &mut entries,
            );
        }
        for special in branches.iter().flat_map(|branch| &branch.specials) {
            let (name, mark, line) = sign(&special.kind);
            let point = &special.point;
            let place = panel.place((point.parameter, point.before_impact_velocity()));
            pen.mark(place, mark, MARK, line.color);
            enter(&mut entries, Sign::Mark(mark, line.color), name);
        }
        entries
    })
}

/// Curves of special points in the plane of two parameters, as an SVG document.
pub fn curves(machine: &Machine, parameters: [Parameter; 2], curves: &[Curve]) -> String {
    let values = |index: usize| {
        let points = curves.iter().flat_map(|curve| &curve.points);
        around(points.map(|point| point.parameters[index]), ROOM)
    };
    let page = Page {
        title: "Bifurcations of periodic motions",
        x: values(0),
        y: values(1),
        across: machine.label_of(parameters[0]),
        upwards: machine.label_of(parameters[1]),
    };
    page.svg(|pen, panel| {
        let mut entries = Vec::new();
        for curve in curves {
            let (name, _, line) = sign(&curve.kind);
            let points = curve.points.iter().map(|point| point.parameters.into());
            panel.curve(pen, &points.collect::<Vec<_>>(), line);
            enter(&mut entries, Sign::Line(line), name);
        }
        entries
    })
}

/// One panel under a title, with a legend at its right.
struct Page {
    title: &'static str,
    x: (f64, f64),
    y: (f64, f64),
    across: String,
    upwards: String,
}

impl Page {
    /// The page with what is drawn on its panel, which gives the legend.
    fn svg(&self, draw: impl FnOnce(&mut Pen, &Panel) -> Vec<(Sign, String)>) -> String {
        let mut pen = Pen::page(PAGE.0, PAGE.1);
        heading(&mut pen, (AREA.0, 42.0), self.title, "");
        let panel = Panel::new(AREA, self.x, self.y);
        let axes = Axes::new(LETTERS, Some(&self.across), &self.upwards, (7, 7));
        panel.ground(&mut pen, &axes);
        let entries = draw(&mut pen, &panel);
        panel.axes(&mut pen, &axes);
        pen.legend((panel.right() + 18.0, AREA.1 + 14.0), LETTERS, &entries);
        pen.svg()
    }
}

/// Enters a sign into a legend, unless its name is there.
fn enter(entries: &mut Vec<(Sign, String)>, sign: Sign, name: &str) {
    if entries.iter().all(|(_, known)| known != name) {
        entries.push((sign, name.to_owned()));
    }
}

/// Pieces of one stability and one number of impacts, a line for each impact, the hardest first.
fn lines(
    pen: &mut Pen,
    panel: &Panel,
    (branch, colour): (&Branch, &'static str),
    entries: &mut Vec<(Sign, String)>,
) {
    for piece in pieces(branch) {
        let (stroke, word) = if is_stable(&piece) {
            (Stroke::solid(colour, 2.4), "stable")
        } else {
            (Stroke::dashed(colour, 1.4, (6.0, 4.0)), "unstable")
        };
        let ranks = piece.iter().map(|point| point.impacts.len()).max();
        for rank in 0..ranks.unwrap_or(0).max(1) {
            let points = piece.iter();
            let points = points.map(|point| (point.parameter, ranked(point, rank)));
            panel.curve(pen, &points.collect::<Vec<_>>(), stroke);
        }
        let name = format!("period {}, {word}", branch.periods);
        enter(entries, Sign::Line(stroke), &name);
    }
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
    let mut specials = branch.specials.iter();
    specials.any(|special| special.point.state() == point.state())
}

/// By a point inside: the ends of a stretch are on the border.
fn is_stable(piece: &[&BranchPoint]) -> bool {
    match piece {
        [one, other] => one.is_stable() && other.is_stable(),
        _ => piece[piece.len() / 2].is_stable(),
    }
}
