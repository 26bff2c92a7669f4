//! Which initial state leads to which motion.

use softstop_draw::panel::{Axes, Panel};
use softstop_draw::pen::{Area, Pen, width};

use crate::page::data::Basin;
use crate::page::figure::{EDGE, Figure, HALF, LETTERS, LINE, RIGHT, ROOM, ends};

/// Radius of the spot where a motion passes the plane.
const SPOT: f64 = 4.5;

/// The picture.
pub(in crate::page) fn figure(basin: &Basin) -> Figure {
    let mut pen = Pen::new(HALF.width, HALF.height);
    let right = HALF.width - RIGHT;
    let top = key(&mut pen, basin, right);
    let area = (ROOM.0, top, right - ROOM.0, HALF.height - top - ROOM.1);
    let panel = Panel::new(area, ends(basin.x_range), ends(basin.y_range));
    let columns = basin.columns.max(1);
    let rows = (basin.cells.len() / columns).max(1);
    let (wide, tall) = (area.2 / columns as f64, area.3 / rows as f64);
    for (class, motion) in basin.motions.iter().enumerate() {
        let mut areas: Vec<Area> = Vec::new();
        for (row, cells) in basin.cells.chunks(columns).enumerate() {
            let mut from = 0;
            for run in cells.chunk_by(|a, b| a == b) {
                if usize::from(run[0]) == class {
                    let left = area.0 + wide * from as f64;
                    let above = panel.bottom() - tall * (row + 1) as f64;
                    areas.push((left, above, wide * run.len() as f64 + 0.4, tall + 0.4));
                }
                from += run.len();
            }
        }
        pen.fill(&areas, &motion.color);
    }
    if let Some((radius, [x, y])) = basin.ball {
        let radii = (0.5 * radius * area.2, 0.5 * radius * area.3);
        pen.ring(panel.place((x, y)), radii);
    }
    for [x, y] in &basin.spots {
        if panel.holds((*x, *y)) {
            pen.spot(panel.place((*x, *y)), SPOT);
        }
    }
    let names = (basin.x.line(), basin.y.line());
    panel.axes(
        &mut pen,
        &Axes::new(LETTERS, Some(&names.0), &names.1, (5, 5)),
    );
    let shares = basin.motions.iter().map(|motion| {
        let [low, high] = motion.interval.map(|share| 100.0 * share);
        format!(
            "{} {:.1} % ({low:.1} to {high:.1})",
            motion.name,
            100.0 * motion.share
        )
    });
    let shares: Vec<String> = shares.collect();
    let ball = basin.ball.map_or(String::new(), |(radius, _)| {
        format!(" The ring is the largest ball inside the basin of the design: {radius:.3} of half of each axis.")
    });
    let caption = format!(
        "Shares of the initial states, with 95 % intervals: {}. The spot is the design at drive angle 0.{ball}",
        shares.join("; ")
    );
    Figure::new(&pen, HALF, "Which start leads to which motion", caption)
}

/// The colours and what they mean, in lines; where the panel begins.
fn key(pen: &mut Pen, basin: &Basin, right: f64) -> f64 {
    let size = f64::from(LETTERS);
    let (mut x, mut y) = (ROOM.0, EDGE + 4.0);
    for motion in &basin.motions {
        let wide = 1.9 * size + 0.86 * width(LETTERS, &motion.name);
        if x > ROOM.0 && x + wide > right {
            (x, y) = (ROOM.0, y + LINE);
        }
        let square = (x, y - 0.85 * size, 1.3 * size, size);
        pen.fill(&[square], &motion.color);
        pen.frame(square);
        let place = (x + 1.9 * size, y);
        pen.text(
            place,
            LETTERS,
            softstop_draw::pen::Align::Left,
            &motion.name,
        );
        x += wide + 18.0;
    }
    y + 14.0
}
