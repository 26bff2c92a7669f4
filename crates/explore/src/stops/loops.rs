//! The picture of a law: contact force over deflection for a stroke in and out, as in the
//! paper's figure 2.

use softstop::PhaseKind;
use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Area, Pen, Stroke as Line};
use softstop_draw::shapes::Sign;
use softstop_draw::style;

use crate::stops::stroke::{Piece, Rebound, Stroke};

/// The lines of the first law and of the second.
const LINES: [Line; 2] = [
    Line::solid(style::DESIGN, 2.5),
    Line::dashed(style::OPTIMUM, 2.5, (8.0, 5.0)),
];
/// Zero of force and of deflection.
const ZERO: Line = Line::solid(style::ASIDE, 1.0);
/// The page, and the panel on it.
const PAGE: (f64, f64) = (660.0, 480.0);
const AREA: Area = (78.0, 76.0, 556.0, 336.0);
/// Letters.
const LETTERS: u32 = 13;
/// Where on a piece its arrow stands, so that those of two ways on one curve stand apart.
const ARROW_AT: f64 = 0.42;
/// Shortest piece, in pixels, that gets an arrow.
const SHORTEST: f64 = 15.0;
/// Half the range of deflections around a stop that does not yield.
const ASIDE: f64 = 1.0;

/// The picture of strokes, each with the name of its law, as an SVG document.
pub fn svg(title: &str, subtitle: &str, strokes: &[(&str, Stroke)]) -> String {
    let points = || strokes.iter().flat_map(|(_, stroke)| stroke.points());
    // A blow has no scale of force: nothing but its zero is marked.
    let yields = points().any(|(_, force)| force != 0.0);
    let (x, y, ticks) = if yields {
        let x = range(points().map(|point| point.0), 0.02, 0.08);
        (x, range(points().map(|point| point.1), 0.12, 0.24), 6)
    } else {
        ((-ASIDE, ASIDE), (-0.15, 1.0), 0)
    };
    let panel = Panel::new(AREA, x, y);
    let mut pen = Pen::page(PAGE.0, PAGE.1);
    heading(&mut pen, (AREA.0, 32.0), title, subtitle);
    let (across, upwards) = ("deflection x − r (m)", "contact force F (N)");
    let axes = Axes::new(LETTERS, Some(across), upwards, (6, ticks));
    panel.ground(&mut pen, &axes);
    panel.curve(&mut pen, &[(x.0, 0.0), (x.1, 0.0)], ZERO);
    panel.curve(&mut pen, &[(0.0, y.0), (0.0, y.1)], ZERO);
    for ((_, stroke), line) in strokes.iter().zip(LINES) {
        draw(&mut pen, &panel, stroke, line);
    }
    panel.axes(&mut pen, &axes);
    if !yields {
        let place = (AREA.0 - 9.0, panel.height(0.0) + 5.0);
        pen.text(place, LETTERS, Align::Right, "0");
    }
    if strokes.len() > 1 {
        let named = strokes.iter().zip(LINES);
        let named = named.map(|((name, _), line)| (Sign::Line(line), (*name).to_owned()));
        let place = (AREA.0 + 14.0, AREA.1 + 22.0);
        pen.legend(place, LETTERS, &named.collect::<Vec<_>>());
    }
    pen.svg()
}

/// The curve of a stroke with its arrows and names.
fn draw(pen: &mut Pen, panel: &Panel, stroke: &Stroke, line: Line) {
    let mut points = Vec::new();
    for (index, piece) in stroke.pieces.iter().enumerate() {
        let wall = stroke.rebound.filter(|wall| wall.pieces_before == index);
        points.extend(wall.map(|wall| (wall.deflection, panel.y.1)));
        points.extend(&piece.points);
    }
    panel.curve(pen, &points, line);
    for piece in &stroke.pieces {
        arrow(pen, panel, piece, line);
    }
    let is_numbered = stroke.pieces.iter().any(|it| it.kind == PhaseKind::Pierce);
    for piece in stroke.pieces.iter().filter(|_| is_numbered) {
        numeral(pen, panel, piece);
    }
    if let Some(wall) = &stroke.rebound {
        let before = stroke.pieces[..wall.pieces_before].last();
        let foot = before.and_then(|piece| piece.points.last());
        let foot = foot.map_or(0.0, |point| point.1);
        let at = |share: f64| panel.place((wall.deflection, foot + share * (panel.y.1 - foot)));
        let (low, high) = (at(0.35), at(0.7));
        head(pen, low, high, line);
        head(pen, high, low, line);
        newton(pen, panel, wall, is_numbered);
    }
}

/// The arrow of a piece.
fn arrow(pen: &mut Pen, panel: &Panel, piece: &Piece, line: Line) {
    let places = piece.points.iter().map(|point| panel.place(*point));
    let places: Vec<(f64, f64)> = places.collect();
    let length = |pair: &[(f64, f64)]| (pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1);
    let whole: f64 = places.windows(2).map(length).sum();
    if whole < SHORTEST || piece.kind == PhaseKind::Free {
        return;
    }
    let mut passed = 0.0;
    let reached = places.windows(2).find(|pair| {
        passed += length(pair);
        passed >= ARROW_AT * whole
    });
    if let Some(pair) = reached {
        head(pen, pair[0], pair[1], line);
    }
}

/// The head of an arrow, its middle at `from`, pointing to `to`.
fn head(pen: &mut Pen, from: (f64, f64), to: (f64, f64), line: Line) {
    const HALF: f64 = 6.5;
    let length = (to.0 - from.0).hypot(to.1 - from.1);
    let (x, y) = (
        HALF * (to.0 - from.0) / length,
        HALF * (to.1 - from.1) / length,
    );
    let (tail, tip) = ((from.0 - x, from.1 - y), (from.0 + x, from.1 + y));
    pen.arrow(tail, tip, Line { width: 2.2, ..line });
}

/// The paper's numeral of a piece: above it on the way in, below it on the way out, once where both
/// ways are one.
fn numeral(pen: &mut Pen, panel: &Panel, piece: &Piece) {
    let numeral = match piece.kind {
        PhaseKind::Pierce => "I",
        PhaseKind::Cut => "II",
        PhaseKind::Stop if piece.inward => "III",
        _ => return,
    };
    if let Some(point) = piece.points.get(piece.points.len() / 2) {
        let (x, y) = panel.place(*point);
        let side = if piece.inward { -8.0 } else { 20.0 };
        pen.text((x, y + side), LETTERS + 1, Align::Middle, numeral);
    }
}

/// The velocities before and after a rigid stop.
fn newton(pen: &mut Pen, panel: &Panel, wall: &Rebound, is_numbered: bool) {
    let (name, aside, align) = match is_numbered {
        true => ("IV: ", -12.0, Align::Right),
        false => ("", 12.0, Align::Left),
    };
    let text = format!(
        "{name}F → ∞, v₋ = {:.2} m/s, v₊ = {:.2} m/s",
        wall.before, wall.after
    );
    let place = (panel.across(wall.deflection) + aside, AREA.1 + 24.0);
    pen.text(place, LETTERS, align, &text.replace('-', "−"));
}

/// The range of values with room on both sides, as shares of it.
fn range(values: impl Iterator<Item = f64> + Clone, below: f64, above: f64) -> (f64, f64) {
    let low = values.clone().fold(0.0, f64::min);
    let high = values.fold(0.0, f64::max);
    let room = high - low;
    (low - below * room, high + above * room)
}
