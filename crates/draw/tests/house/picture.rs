//! The house as a picture: a room stands above all that it imports.

use softstop_draw::pen::{Align, Pen, Stroke, width};
use softstop_draw::style;

use super::rooms::Room;

/// Width and height of a room, and the gaps between rooms and floors.
const ROOM: (f64, f64) = (236.0, 96.0);
const GAP: (f64, f64) = (84.0, 44.0);
const MARGIN: f64 = 30.0;
const LETTERS: u32 = 12;
const WALLS: &str = "#F3F6F9";

/// The picture as an SVG document.
pub fn draw(rooms: &[Room]) -> String {
    let extent = |count: f64, room: f64, gap: f64| 2.0 * MARGIN + count * (room + gap) - gap;
    let (wide, high) = (extent(3.0, ROOM.0, GAP.0), extent(7.0, ROOM.1, GAP.1));
    let mut pen = Pen::new(wide, high);
    pen.fill(&[(0.0, 0.0, wide, high)], "#ffffff");
    let rooms: Vec<&Room> = rooms.iter().filter(|room| room.corner.is_some()).collect();
    for room in &rooms {
        let below = room.below(&rooms);
        for import in below.filter(|below| is_direct(room, &below.name, &rooms)) {
            let ((x, y), (to_x, to_y)) = (corner(room), corner(import));
            let from = (x + 0.5 * ROOM.0, y + ROOM.1);
            let stroke = Stroke::solid(style::ASIDE, 1.4);
            pen.arrow(from, (to_x + 0.5 * ROOM.0, to_y), stroke);
        }
    }
    for room in rooms {
        let (left, top) = corner(room);
        pen.fill(&[(left, top, ROOM.0, ROOM.1)], WALLS);
        pen.frame((left, top, ROOM.0, ROOM.1));
        let place = match room.place.as_str() {
            "" => "src",
            place => place,
        };
        pen.heading((left + 12.0, top + 22.0), 15, Align::Left, place);
        for (line, words) in lines(&room.job).iter().enumerate() {
            let y = top + 42.0 + 16.0 * line as f64;
            pen.text((left + 12.0, y), LETTERS, Align::Left, words);
        }
    }
    pen.svg()
}

/// Left and top edge of a room.
fn corner(room: &Room) -> (f64, f64) {
    let (column, floor) = room.corner.expect("a room of the house");
    (
        MARGIN + column * (ROOM.0 + GAP.0),
        MARGIN + floor * (ROOM.1 + GAP.1),
    )
}

/// Whether no room between the two says the same.
fn is_direct(room: &Room, import: &str, rooms: &[&Room]) -> bool {
    !room
        .below(rooms)
        .any(|between| between.rests_on(import, rooms))
}

/// The words in lines that fit a room.
fn lines(text: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let last = lines.len() - 1;
        let longer = format!("{} {word}", lines[last]).trim().to_owned();
        if width(LETTERS, &longer) > 1.06 * (ROOM.0 - 16.0) {
            lines.push(word.to_owned());
        } else {
            lines[last] = longer;
        }
    }
    lines
}
