//! The house as a picture: a room stands above all that it imports.

use softstop_draw::pen::{Align, Pen, Stroke, width};
use softstop_draw::style;

use super::rooms::Room;

/// Width and height of a room, and the gaps between rooms and floors.
const ROOM: (f64, f64) = (236.0, 92.0);
const GAP: (f64, f64) = (26.0, 58.0);
const MARGIN: f64 = 30.0;
const LETTERS: u32 = 12;
const WALLS: &str = "#F3F6F9";

/// The picture as an SVG document.
pub fn draw(rooms: &[Room]) -> String {
    let rooms: Vec<&Room> = rooms.iter().filter(|room| room.name != "xtask").collect();
    let all: Vec<Room> = rooms.iter().map(|room| copy(room)).collect();
    let floors = floors(&all);
    let widest = floors.iter().map(Vec::len).max().unwrap_or(0) as f64;
    let wide = 2.0 * MARGIN + widest * ROOM.0 + (widest - 1.0) * GAP.0;
    let count = floors.len() as f64;
    let high = 2.0 * MARGIN + count * ROOM.1 + (count - 1.0) * GAP.1;
    let mut pen = Pen::new(wide, high);
    pen.fill(&[(0.0, 0.0, wide, high)], "#ffffff");
    let corner = |name: &str| {
        let floor = floors
            .iter()
            .position(|floor| floor.iter().any(|room| room.name == name))?;
        let on_floor = &floors[floor];
        let index = on_floor.iter().position(|room| room.name == name)? as f64;
        let length = on_floor.len() as f64;
        let taken = length * ROOM.0 + (length - 1.0) * GAP.0;
        let left = 0.5 * (wide - taken) + index * (ROOM.0 + GAP.0);
        let top = high - MARGIN - ROOM.1 - floor as f64 * (ROOM.1 + GAP.1);
        Some((left, top))
    };
    for room in &all {
        for below in room
            .below(&all)
            .filter(|below| is_direct(room, below, &all))
        {
            if let (Some(from), Some(to)) = (corner(&room.name), corner(&below.name)) {
                let from = (from.0 + 0.5 * ROOM.0, from.1 + ROOM.1);
                pen.arrow(
                    from,
                    (to.0 + 0.5 * ROOM.0, to.1),
                    Stroke::solid(style::ASIDE, 1.4),
                );
            }
        }
    }
    for room in &all {
        if let Some((left, top)) = corner(&room.name) {
            pen.fill(&[(left, top, ROOM.0, ROOM.1)], WALLS);
            pen.frame((left, top, ROOM.0, ROOM.1));
            let place = match room.place.as_str() {
                "" => "src/",
                place => place,
            };
            pen.heading((left + 12.0, top + 22.0), 15, Align::Left, place);
            for (line, words) in lines(&room.job).iter().enumerate() {
                let y = top + 42.0 + 16.0 * line as f64;
                pen.text((left + 12.0, y), LETTERS, Align::Left, words);
            }
        }
    }
    pen.svg()
}

fn copy(room: &Room) -> Room {
    Room {
        name: room.name.clone(),
        place: room.place.clone(),
        folder: room.folder.clone(),
        job: room.job.clone(),
        imports: room.imports.clone(),
    }
}

/// The rooms of each floor, from the ground up.
fn floors(rooms: &[Room]) -> Vec<Vec<&Room>> {
    let mut floors: Vec<Vec<&Room>> = Vec::new();
    for room in rooms {
        let floor = room.floor(rooms);
        floors.resize_with(floors.len().max(floor + 1), Vec::new);
        floors[floor].push(room);
    }
    floors
}

/// Whether no room between the two says the same.
fn is_direct(room: &Room, below: &Room, rooms: &[Room]) -> bool {
    !room
        .below(rooms)
        .any(|between| between.rests_on(&below.name, rooms))
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
