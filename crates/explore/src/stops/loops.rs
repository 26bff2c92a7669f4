//! The picture of a law: contact force over deflection for a stroke in and out, as in the
//! paper's figure 2.

use softstop::PhaseKind;
use softstop_draw::{Align, Axis, Chart, Corner, Layer, Legend, Panel, Stroke, style};

use crate::stops::stroke::{ContactStroke, Rebound, StrokePiece};

/// The lines of the first law and of the second.
const LINES: [Stroke; 2] = [
    Stroke::solid(style::DESIGN, 2.5),
    Stroke::dashed(style::OPTIMUM, 2.5, (8.0, 5.0)),
];
/// Zero of force and of deflection.
const ZERO: Stroke = Stroke::solid(style::ASIDE, 1.0);
/// Where on a piece its arrow stands, so that those of two ways on one curve stand apart.
const ARROW_AT: f64 = 0.42;

/// The picture of strokes, each with the name of its law, as an SVG document.
pub fn svg(title: &str, subtitle: &str, strokes: &[(&str, ContactStroke)]) -> String {
    let points = || strokes.iter().flat_map(|(_, stroke)| stroke.points());
    // A blow has no scale of force: nothing but its zero is marked.
    let yields = points().any(|(_, force)| force != 0.0);
    let force = Axis::new("contact force F (N)");
    let (x, force) = if yields {
        let y = range(points().map(|point| point.1), 0.12, 0.24);
        (
            range(points().map(|point| point.0), 0.02, 0.08),
            force.range(y),
        )
    } else {
        let zero = (0.0, "0".to_owned());
        ((-1.0, 1.0), force.range((-0.15, 1.0)).ticks([zero]))
    };
    let top = force.ends[1].unwrap_or(1.0);
    let mut layers = vec![
        Layer::horizontal(0.0, ZERO, ""),
        Layer::vertical(0.0, ZERO, ""),
    ];
    for ((name, stroke), line) in strokes.iter().zip(LINES) {
        let name = if strokes.len() > 1 { *name } else { "" };
        draw(&mut layers, stroke, line, name, top);
    }
    let deflection = Axis::new("deflection x − r (m)").range(x);
    let panel = Panel::new(deflection, force, layers).sized((556.0, 336.0));
    let chart = Chart {
        subtitle: subtitle.to_owned(),
        legend: Legend::Inside(Corner::TopLeft),
        letters: 13,
        ..Chart::new(title, [panel])
    };
    chart.svg()
}

/// The curve of a stroke with its arrows and names, up to the top of the panel where a stop does not yield.
fn draw(layers: &mut Vec<Layer>, stroke: &ContactStroke, line: Stroke, name: &str, top: f64) {
    let mut points = Vec::new();
    for (index, piece) in stroke.pieces.iter().enumerate() {
        let wall = stroke.rebound.filter(|wall| wall.pieces_before == index);
        points.extend(wall.map(|wall| (wall.deflection, top)));
        points.extend(&piece.points);
    }
    layers.push(Layer::line(points, line).named(name));
    let forced = stroke.pieces.iter().filter(|it| it.kind != PhaseKind::Free);
    layers.extend(forced.map(|it| Layer::direction(it.points.iter().copied(), ARROW_AT, line)));
    let is_numbered = stroke.pieces.iter().any(|it| it.kind == PhaseKind::Pierce);
    let numbered = stroke.pieces.iter().filter(|_| is_numbered);
    layers.extend(numbered.filter_map(numeral));
    if let Some(wall) = &stroke.rebound {
        let before = stroke.pieces[..wall.pieces_before].last();
        let foot = before.and_then(|piece| piece.points.last());
        let foot = (wall.deflection, foot.map_or(0.0, |point| point.1));
        let way = [foot, (wall.deflection, top)];
        layers.push(Layer::direction(way, 0.35, line));
        layers.push(Layer::direction([way[1], way[0]], 0.3, line));
        layers.push(newton(wall, is_numbered, top));
    }
}

/// The paper's numeral of a piece: above it on the way in, below it on the way out, once where both
/// ways are one.
fn numeral(piece: &StrokePiece) -> Option<Layer> {
    let numeral = match piece.kind {
        PhaseKind::Pierce => "I",
        PhaseKind::Cut => "II",
        PhaseKind::Stop if piece.inward => "III",
        _ => return None,
    };
    let middle = *piece.points.get(piece.points.len() / 2)?;
    let side = if piece.inward { -8.0 } else { 20.0 };
    Some(Layer::text(middle, Align::Middle, numeral).moved(0.0, side))
}

/// The velocities before and after a rigid stop.
fn newton(wall: &Rebound, is_numbered: bool, top: f64) -> Layer {
    let (name, aside, align) = match is_numbered {
        true => ("IV: ", -12.0, Align::Right),
        false => ("", 12.0, Align::Left),
    };
    let text = format!(
        "{name}F → ∞, v₋ = {:.2} m/s, v₊ = {:.2} m/s",
        wall.before, wall.after
    );
    let text = text.replace('-', "−");
    Layer::text((wall.deflection, top), align, text).moved(aside, 24.0)
}

/// The range of values with room on both sides, as shares of it.
fn range(values: impl Iterator<Item = f64> + Clone, below: f64, above: f64) -> (f64, f64) {
    let low = values.clone().fold(0.0, f64::min);
    let high = values.fold(0.0, f64::max);
    let room = high - low;
    (low - below * room, high + above * room)
}
