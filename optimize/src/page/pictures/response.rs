//! The before-impact velocity over the drive's frequency.

use softstop_draw::panel::{Axes, Panel};
use softstop_draw::pen::Pen;
use softstop_draw::scale::around;
use softstop_draw::shapes::{Mark, Sign};
use softstop_draw::style;

use super::stroke;
use crate::page::data::{Response, Role};
use crate::page::figure::{
    BOUND, EDGE, Figure, LETTERS, LINE, Names, RIGHT, ROOM, WIDE, finite, legend,
};
use crate::page::words::quantity;

/// Half the size of the design's mark.
const MARK: f64 = 8.0;
/// Colour and opacity of machines within the tolerances, and the opacity of the tolerance of the frequency.
const BAND: (&str, f64) = (style::OPTIMUM, 0.35);
const ALLOWED: f64 = 0.3;

/// The picture.
pub(in crate::page) fn figure(response: &Response) -> Figure {
    let mut pen = Pen::new(WIDE.width, WIDE.height);
    let right = WIDE.width - RIGHT;
    let mark = Sign::Mark(Mark::Triangle, style::OPTIMUM);
    let mut entries = vec![(mark, "design".to_owned())];
    for curve in &response.curves {
        if !entries.iter().any(|(_, name)| *name == curve.name) {
            entries.push((Sign::Line(stroke(curve.role)), curve.name.clone()));
        }
    }
    if response.tolerance.is_some() {
        let patch = Sign::Band(style::ALLOWED, ALLOWED);
        entries.push((patch, "tolerance of the frequency".to_owned()));
    }
    if !response.bands.is_empty() {
        let patch = Sign::Band(BAND.0, BAND.1);
        entries.push((patch, "within the tolerances".to_owned()));
    }
    let top = legend(&mut pen, (ROOM.0, EDGE + 4.0), right, &entries) - LINE + 14.0;
    let points = || {
        response
            .curves
            .iter()
            .flat_map(|curve| finite(&curve.points))
    };
    let ends = response.ends.iter().map(|end| end.1);
    let across = around(points().map(|it| it.0).chain(ends), 0.03);
    let highest = points()
        .map(|it| it.1)
        .chain([response.design[1]])
        .fold(0.0, f64::max);
    let area = (ROOM.0, top, right - ROOM.0, WIDE.height - top - ROOM.1);
    let panel = Panel::new(
        area,
        across,
        (0.0, if highest > 0.0 { 1.1 * highest } else { 1.0 }),
    );
    let names = Names::new(&panel, &response.ends);
    let panel = names.room(panel);
    let area = panel.area;
    let labels = (response.x.line(), response.y.line());
    let axes = Axes::new(LETTERS, Some(&labels.0), &labels.1, (8, 6));
    let tolerance = response
        .tolerance
        .filter(|ends| ends.iter().all(|end| end.is_finite()));
    if let Some(ends) = tolerance {
        let [low, high] = ends.map(|at| panel.across(at.clamp(across.0, across.1)));
        pen.tint(
            (low, area.1, (high - low).max(1.0), area.3),
            style::ALLOWED,
            ALLOWED,
        );
    }
    panel.ground(&mut pen, &axes);
    for band in &response.bands {
        let inside = |it: &&[f64; 3]| it.iter().all(|value| value.is_finite());
        let band = band.iter().filter(inside);
        let band: Vec<(f64, [f64; 2])> = band.map(|[x, low, high]| (*x, [*low, *high])).collect();
        panel.band(&mut pen, &band, BAND.0, BAND.1);
    }
    names.draw(&mut pen, &panel, BOUND);
    for role in [Role::Unstable, Role::Beside, Role::Design] {
        for curve in response.curves.iter().filter(|curve| curve.role == role) {
            panel.curve(&mut pen, &finite(&curve.points), stroke(role));
        }
    }
    let [x, y] = response.design;
    if panel.holds((x, y)) {
        pen.mark(panel.place((x, y)), Mark::Triangle, MARK, style::OPTIMUM);
    }
    panel.axes(&mut pen, &axes);
    let title = format!(
        "{} over the {}",
        "How hard the mass strikes", response.x.name
    );
    let mut caption = format!(
        "The design runs at {} and strikes with {}.",
        quantity(x, &response.x.unit),
        quantity(y, &response.y.unit)
    );
    let away = response.ends.iter().map(|(name, at)| {
        let away = 100.0 * (at / x - 1.0);
        let side = if away < 0.0 { "below" } else { "above" };
        format!("{name} lies {:.1} % {side} that frequency", away.abs())
    });
    for away in away {
        caption += &format!(" {away}.");
    }
    if response.machines > 0 {
        caption += &format!(
            " The band reaches from the least to the greatest velocity of {} machines at the corners of the tolerances, that \
             of the frequency apart, and ends where the first of them has no such motion.",
            response.machines
        );
    }
    Figure::new(&pen, WIDE, &title, caption)
}
