//! What more of one good costs of another.

use softstop_draw::panel::{Axes, Panel};
use softstop_draw::pen::{Pen, Stroke};
use softstop_draw::scale::around;
use softstop_draw::shapes::{Mark, Sign};
use softstop_draw::style;

use crate::page::data::Front;
use crate::page::figure::{EDGE, Figure, HALF, LETTERS, LINE, RIGHT, ROOM, finite, legend};
use crate::page::words::capital;

const LINED: Stroke = Stroke::solid(style::DESIGN, 1.6);

/// The picture.
pub(in crate::page) fn figure(front: &Front) -> Figure {
    let mut pen = Pen::new(HALF.width, HALF.height);
    let right = HALF.width - RIGHT;
    let mut entries = vec![(
        Sign::Mark(Mark::Circle, style::DESIGN),
        "best designs".to_owned(),
    )];
    if front.design.is_some() {
        let mark = Sign::Mark(Mark::Triangle, style::OPTIMUM);
        entries.push((mark, "this design".to_owned()));
    }
    let top = legend(&mut pen, (ROOM.0, EDGE + 4.0), right, &entries) - LINE + 14.0;
    let points = finite(&front.points);
    let design = front.design.iter();
    let design = design
        .flat_map(|point| finite(std::slice::from_ref(point)))
        .next();
    let all = || points.iter().copied().chain(design);
    let area = (ROOM.0, top, right - ROOM.0, HALF.height - top - ROOM.1);
    let panel = Panel::new(
        area,
        around(all().map(|it| it.0), 0.06),
        around(all().map(|it| it.1), 0.08),
    );
    let names = (front.x.line(), front.y.line());
    let axes = Axes::new(LETTERS, Some(&names.0), &names.1, (5, 5));
    panel.ground(&mut pen, &axes);
    panel.curve(&mut pen, &points, LINED);
    for point in &points {
        pen.mark(panel.place(*point), Mark::Circle, 3.5, style::DESIGN);
    }
    if let Some(design) = design {
        pen.mark(panel.place(design), Mark::Triangle, 8.0, style::OPTIMUM);
    }
    panel.axes(&mut pen, &axes);
    let caption = format!(
        "Each point is a design that cannot be bettered in one of the two without loss in the other. {}",
        front.note
    );
    let caption = caption.trim_end().to_owned();
    Figure::new(&pen, HALF, &capital(&front.title), caption)
}
