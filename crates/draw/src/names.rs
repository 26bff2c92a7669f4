//! Names of places across, above a panel: none covers another one, nor the line that leads down from it.

use std::cmp::Ordering;

use crate::chart::Panel;
use crate::frame::Frame;
use crate::index::width;
use crate::layer::Shape;

/// Room between a name and its line.
pub(crate) const AWAY: f64 = 4.0;
/// How far a name may reach beyond the frame.
const BEYOND: f64 = 20.0;

/// A name beside a line upwards.
pub(crate) struct Name {
    pub(crate) text: String,
    /// The place, as the frame takes it.
    pub(crate) at: f64,
    /// In which line it stands, counted upwards from the panel.
    pub(crate) line: usize,
    /// Left of its line rather than right of it.
    pub(crate) is_left: bool,
    pub(crate) color: &'static str,
    x: f64,
    width: f64,
}

impl Name {
    /// From where to where it takes room.
    fn range(&self) -> (f64, f64) {
        let room = self.width + 2.0 * AWAY;
        match self.is_left {
            true => (self.x - room, self.x),
            false => (self.x, self.x + room),
        }
    }

    /// Whether both may stand in their lines.
    fn is_apart(&self, other: &Self) -> bool {
        let (own, its) = (self.range(), other.range());
        let crosses = |x: f64, range: (f64, f64)| range.0 < x && x < range.1;
        match self.line.cmp(&other.line) {
            Ordering::Equal => own.1 <= its.0 || its.1 <= own.0,
            Ordering::Greater => !crosses(self.x, its),
            Ordering::Less => !crosses(other.x, own),
        }
    }
}

/// The names of a panel, in as few lines as a walk from right to left finds.
pub(crate) fn names(panel: &Panel, frame: &Frame, letters: u32) -> Vec<Name> {
    let name = |place: f64, text: &str, color| {
        let at = panel.x.position(place);
        let (x, width) = (frame.x_of(at), width(letters, text));
        let is_left = x + AWAY + width > frame.right() + BEYOND;
        Name {
            text: text.to_owned(),
            at,
            line: 0,
            is_left,
            color,
            x,
            width,
        }
    };
    let named = panel.layers.iter().filter_map(|layer| match &layer.shape {
        Shape::Vertical(place, stroke, text) if !text.is_empty() => {
            Some(name(*place, text, stroke.color))
        }
        _ => None,
    });
    let inside = named.filter(|it| frame.x.0 <= it.at && it.at <= frame.x.1);
    let mut inside: Vec<Name> = inside.collect();
    inside.sort_by(|a, b| b.x.total_cmp(&a.x));
    let mut names: Vec<Name> = Vec::new();
    for mut name in inside {
        let is_free = (0..=lines(&names)).any(|line| {
            name.line = line;
            names.iter().all(|other| name.is_apart(other))
        });
        if !is_free {
            // Below all others, whose lines lead down at its right.
            names.iter_mut().for_each(|other| other.line += 1);
            (name.line, name.is_left) = (0, true);
        }
        names.push(name);
    }
    names
}

/// How many lines names take.
pub(crate) fn lines(names: &[Name]) -> usize {
    names.iter().map(|it| it.line + 1).max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::names;
    use crate::frame::Frame;
    use crate::{Axis, Layer, Panel, Stroke};

    fn placed(places: &[(f64, &str)]) -> Vec<(String, usize, bool)> {
        let stroke = Stroke::solid("#000000", 1.0);
        let layers = places.iter();
        let layers = layers.map(|(at, name)| Layer::vertical(*at, stroke, *name));
        let panel = Panel {
            x: Axis::new("across"),
            layers: layers.collect(),
            ..Panel::default()
        };
        let frame = Frame {
            area: (0.0, 0.0, 500.0, 300.0),
            x: (0.0, 1.0),
            y: (0.0, 1.0),
        };
        let names = names(&panel, &frame, 14);
        for (index, name) in names.iter().enumerate() {
            assert!(names[..index].iter().all(|other| name.is_apart(other)));
        }
        let named = names.into_iter();
        named.map(|it| (it.text, it.line, it.is_left)).collect()
    }

    #[test]
    fn names_stand_so_high_that_none_is_crossed() {
        let own = |name: &str, line| (name.to_owned(), line, false);
        assert_eq!(
            placed(&[(0.4, "first"), (0.42, "second"), (0.8, "third")]),
            [own("third", 0), own("second", 0), own("first", 1)]
        );
    }

    #[test]
    fn a_name_without_room_at_the_right_covers_none() {
        let names = placed(&[(0.93, "15→G"), (0.95, "16→PD, ISN, OCH")]);
        let own = |name: &str, line| (name.to_owned(), line, true);
        assert_eq!(names, [own("16→PD, ISN, OCH", 1), own("15→G", 0)]);
    }

    #[test]
    fn many_names_stay_apart() {
        for count in 2..40 {
            let texts: Vec<String> = (0..count).map(|it| "n".repeat(1 + it * 7 % 12)).collect();
            let places = (0..count).map(|it| ((it * it * 37 % 101) as f64 / 100.0, &*texts[it]));
            assert_eq!(placed(&places.collect::<Vec<_>>()).len(), count);
        }
    }
}
