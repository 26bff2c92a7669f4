//! Where the parts of a chart are on the page: margins follow from the texts at the axes.

use crate::chart::{Axis, Chart, Legend, Panel};
use crate::index::width;
use crate::layer::Shape;
use crate::legend::{Entry, column, entries, height};
use crate::panel::Panel as Frame;
use crate::scale::{around, log_ticks, ticks};
use crate::stroke::{Point, Stroke};

/// Length of a tick.
pub(crate) const TICK: f64 = 5.0;
/// Room around what is drawn, as a share of it.
const ROOM: f64 = 0.06;
/// Room between parts.
pub(crate) const GAP: f64 = 14.0;
/// Height of a line of text, in units of its letters.
pub(crate) const LINE: f64 = 1.4;
/// Width of a bar of shades.
pub(crate) const BAR: f64 = 18.0;

/// Values at an axis and what is written there.
pub(crate) type Ticks = Vec<(f64, String)>;

/// A panel whose ranges, texts and margins are known; values of logarithmic axes are powers of ten.
pub(crate) struct Placed<'a> {
    pub(crate) panel: &'a Panel,
    pub(crate) frame: Frame,
    /// Across, upwards, and of the bar of shades.
    pub(crate) ticks: [Ticks; 3],
    /// Whether numbers and names of both axes are written.
    pub(crate) shows: [bool; 2],
    pub(crate) names: Vec<Name>,
    /// Where its own layers are explained, and how.
    pub(crate) legend: Option<Legend>,
    pub(crate) key: Vec<Entry>,
    /// Room left, right, above and below.
    pub(crate) margins: [f64; 4],
}

/// The name of a place across, above the panel: in a line so high that no other one's way down crosses it.
pub(crate) struct Name {
    pub(crate) text: String,
    pub(crate) at: f64,
    pub(crate) line: usize,
    pub(crate) stroke: Stroke,
}

/// A value as its axis places it.
pub(crate) fn on(axis: &Axis, value: f64) -> f64 {
    match axis.is_log {
        true => value.log10(),
        false => value,
    }
}

/// About so many ticks have room on a length across, and upwards.
fn counts(size: (f64, f64)) -> (usize, usize) {
    let whole = |count: f64| count.round().max(2.0) as usize;
    (whole(2.0 + size.0 / 150.0), whole(2.5 + size.1 / 110.0))
}

/// The widest of the texts of ticks.
pub(crate) fn widest(ticks: &Ticks, letters: u32) -> f64 {
    let widths = ticks.iter().map(|(_, text)| width(letters, text));
    widths.fold(0.0, f64::max)
}

impl Axis {
    /// Its range; of a logarithmic axis as powers of ten.
    fn range_of(&self, values: impl Iterator<Item = f64>) -> (f64, f64) {
        let (low, high) = around(values.map(|value| on(self, value)), 0.0);
        let [from, to] = self.ends.map(|end| end.map(|value| on(self, value)));
        let (low, high) = (from.unwrap_or(low), to.unwrap_or(high));
        let high = if high > low { high } else { low + 1.0 };
        let room = ROOM * (high - low);
        (from.unwrap_or(low - room), to.unwrap_or(high + room))
    }

    fn ticks_of(&self, range: (f64, f64), count: usize) -> Ticks {
        match &self.ticks {
            Some(ticks) => {
                let ticks = ticks
                    .iter()
                    .map(|(value, text)| (on(self, *value), text.clone()));
                ticks
                    .filter(|it| range.0 <= it.0 && it.0 <= range.1)
                    .collect()
            }
            None if self.is_log => log_ticks(range, count),
            None => ticks(range, count),
        }
    }

    /// Ticks across, so many that their texts stay apart.
    fn ticks_across(&self, range: (f64, f64), wide: f64, letters: u32) -> Ticks {
        let mut count = counts((wide, 0.0)).0;
        loop {
            let ticks = self.ticks_of(range, count);
            let room = 1.2 * (widest(&ticks, letters) + 4.0) * ticks.len() as f64;
            if room <= wide || count <= 2 || self.ticks.is_some() {
                return ticks;
            }
            count -= 1;
        }
    }
}

impl<'a> Placed<'a> {
    /// A panel of this size, its corner at the origin.
    fn new(chart: &Chart, panel: &'a Panel, size: (f64, f64), (ranges, shows): Shown) -> Self {
        let ([x, y], letters) = (ranges, chart.letters);
        let frame = Frame::new((0.0, 0.0, size.0, size.1), x, y);
        let upwards = counts(size).1;
        let bar = panel.bar().map(|(range, _)| ticks(range, upwards));
        let legend = chart.legend_of(panel);
        let mut placed = Self {
            panel,
            frame,
            ticks: [
                panel.x.ticks_across(x, size.0, letters),
                panel.y.ticks_of(y, upwards),
                bar.unwrap_or_default(),
            ],
            shows,
            names: names(panel, &frame, letters),
            legend,
            key: legend.map_or_else(Vec::new, |_| entries([panel].into_iter())),
            margins: [0.0; 4],
        };
        placed.margins = placed.margins(letters);
        placed
    }

    /// Room that is needed left, right, above and below.
    fn margins(&self, letters: u32) -> [f64; 4] {
        let (size, shows) = (f64::from(letters), self.shows);
        let line = |text: &str| if text.is_empty() { 0.0 } else { LINE * size };
        let room = |ticks: &Ticks, name: &str| match (ticks.is_empty(), name.is_empty()) {
            (true, true) => 2.0,
            _ => TICK + 4.0 + widest(ticks, letters) + line(name),
        };
        let overhang = self.ticks[0].last().map_or(0.0, |(value, text)| {
            0.5 * width(letters, text) - (self.frame.right() - self.frame.across(*value))
        });
        let bar = self
            .panel
            .bar()
            .map_or(0.0, |(_, name)| GAP + room(&self.ticks[2], name) + BAR);
        let above = line(&self.panel.title) + LINE * size * self.lines() as f64;
        let key = self.key_height(letters);
        let (beside, over, under) = match self.legend.filter(|_| !self.key.is_empty()) {
            Some(Legend::Right) => (GAP + column(&self.key, letters).0, 0.0, 0.0),
            Some(Legend::Above) => (0.0, key, 0.0),
            Some(Legend::Below) => (0.0, 0.0, key),
            _ => (0.0, 0.0, 0.0),
        };
        let below = match (self.ticks[0].is_empty(), self.panel.x.name.is_empty()) {
            (true, true) => 0.0,
            _ => TICK + LINE * size + 1.1 * line(&self.panel.x.name),
        };
        [
            if shows[1] {
                room(&self.ticks[1], &self.panel.y.name)
            } else {
                TICK
            },
            bar.max(overhang.max(4.0)) + beside,
            above + over + if above > 0.0 { 6.0 } else { 0.0 },
            under + if shows[0] { below } else { TICK },
        ]
    }

    /// Height of its own legend in lines.
    pub(crate) fn key_height(&self, letters: u32) -> f64 {
        height(&self.key, letters, self.frame.area.2)
    }

    /// Lines of names above the panel.
    pub(crate) fn lines(&self) -> usize {
        self.names.iter().map(|it| it.line + 1).max().unwrap_or(0)
    }

    /// A point as the frame takes it.
    pub(crate) fn on(&self, (x, y): Point) -> Point {
        (on(&self.panel.x, x), on(&self.panel.y, y))
    }
}

fn names(panel: &Panel, frame: &Frame, letters: u32) -> Vec<Name> {
    let named = panel.layers.iter().filter_map(|layer| match &layer.shape {
        Shape::Upwards(place, stroke, text) if !text.is_empty() => {
            let at = on(&panel.x, *place);
            let is_inside = frame.x.0 <= at && at <= frame.x.1;
            is_inside.then_some((at, text, *stroke))
        }
        _ => None,
    });
    let mut named: Vec<_> = named.collect();
    named.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut names: Vec<Name> = Vec::new();
    for (at, text, stroke) in named {
        let end = frame.across(at) + 0.9 * width(letters, text) + 8.0;
        let crossed = names.iter().filter(|it| frame.across(it.at) < end);
        let line = crossed.map(|it| it.line + 1).max().unwrap_or(0);
        let text = text.clone();
        names.push(Name {
            text,
            at,
            line,
            stroke,
        });
    }
    names
}

/// The panels of a chart, with the size of the page that is theirs; it begins at the origin.
pub(crate) fn place(chart: &Chart, room: Option<(f64, f64)>) -> (Vec<Placed<'_>>, (f64, f64)) {
    let ranges = ranges(chart);
    let mut sizes: Vec<(f64, f64)> = chart.panels.iter().map(|panel| panel.snapped()).collect();
    let (mut placed, mut end) = (Vec::new(), (0.0, 0.0));
    // Texts follow from sizes, and sizes from texts.
    for _ in 0..3 {
        let panels = chart.panels.iter().zip(&sizes).zip(&ranges);
        let panels = panels.map(|((panel, size), shown)| Placed::new(chart, panel, *size, *shown));
        placed = panels.collect();
        let items = |side: usize| {
            let items = placed
                .iter()
                .map(|Placed { panel, margins, .. }| match side {
                    0 => {
                        let room = [margins[0], margins[1]];
                        (panel.at.0, panel.span.0, panel.snapped().0, room)
                    }
                    _ => {
                        let room = [margins[2], margins[3]];
                        (panel.at.1, panel.span.1, panel.snapped().1, room)
                    }
                });
            items.collect::<Vec<Item>>()
        };
        let (across, width) = tracks(&items(0), room.map(|it| it.0));
        let (down, height) = tracks(&items(1), room.map(|it| it.1));
        end = (width, height);
        for ((it, (left, wide)), (top, high)) in placed.iter_mut().zip(across).zip(down) {
            it.frame.area = (left, top, wide, high);
        }
        sizes = placed
            .iter()
            .map(|it| (it.frame.area.2, it.frame.area.3))
            .collect();
    }
    (placed, end)
}

/// Track, number of tracks, size, and the room before and behind.
type Item = (usize, usize, f64, [f64; 2]);

/// Begin and size of each item, and the end of the last track; they fill the room, if it is given.
fn tracks(items: &[Item], room: Option<f64>) -> (Vec<(f64, f64)>, f64) {
    let count = items.iter().map(|it| it.0 + it.1).max().unwrap_or(0);
    let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max).ceil();
    let mut tracks = Vec::new();
    for track in 0..count {
        let begins = items.iter().filter(|it| it.0 == track);
        let ends = items.iter().filter(|it| it.0 + it.1 == track + 1);
        let sizes = items.iter().filter(|it| (it.0, it.1) == (track, 1));
        let shares = items
            .iter()
            .filter(|it| it.0 <= track && track < it.0 + it.1);
        let alone = sizes.map(|it| it.2).reduce(f64::max);
        let shared = shares.map(|it| it.2 / it.1 as f64).reduce(f64::max);
        tracks.push((
            most(&mut begins.map(|it| it.3[0])),
            alone.or(shared).unwrap_or(0.0),
            most(&mut ends.map(|it| it.3[1])),
        ));
    }
    let gaps = GAP * count.saturating_sub(1) as f64;
    let margins: f64 = tracks.iter().map(|it| it.0 + it.2).sum();
    let whole: f64 = tracks.iter().map(|it| it.1).sum();
    let scale = room.map_or(1.0, |room| ((room - gaps - margins) / whole).max(0.05));
    let (mut at, mut places) = (0.0, Vec::new());
    for (before, size, after) in tracks {
        places.push((at + before, at + before + scale * size));
        at += before + scale * size + after + GAP;
    }
    let place = |it: &Item| {
        let (begin, end) = (places[it.0].0, places[it.0 + it.1 - 1].1);
        (begin, end - begin)
    };
    (items.iter().map(place).collect(), at - GAP)
}

/// The ranges of both axes.
type Ranges = [(f64, f64); 2];
/// These, and which of both axes have numbers.
type Shown = (Ranges, [bool; 2]);

/// The ranges of all panels, and which of their axes have numbers.
fn ranges(chart: &Chart) -> Vec<Shown> {
    let own = |panel: &Panel| {
        let points: Vec<Point> = panel.layers.iter().flat_map(|it| it.extent()).collect();
        [
            panel.x.range_of(points.iter().map(|it| it.0)),
            panel.y.range_of(points.iter().map(|it| it.1)),
        ]
    };
    let all: Vec<_> = chart
        .panels
        .iter()
        .map(|panel| (panel, own(panel)))
        .collect();
    let union = |a: (f64, f64), b: (f64, f64)| (a.0.min(b.0), a.1.max(b.1));
    let with = |(panel, own): &(&Panel, Ranges)| {
        let (mut ranges, mut shows) = (*own, [true; 2]);
        for (other, range) in &all {
            if chart.shares_across && other.at.0 == panel.at.0 {
                ranges[0] = union(ranges[0], range[0]);
                shows[0] &= other.at.1 <= panel.at.1;
            }
            if chart.shares_upwards && other.at.1 == panel.at.1 {
                ranges[1] = union(ranges[1], range[1]);
                shows[1] &= other.at.0 >= panel.at.0;
            }
        }
        (ranges, shows)
    };
    all.iter().map(with).collect()
}

impl Panel {
    /// Its size; cells are whole half pixels, which are whole ones in a PNG.
    fn snapped(&self) -> (f64, f64) {
        let cells = self.layers.iter().find_map(|layer| match &layer.shape {
            Shape::Cells(columns, colors) => Some((*columns, colors.len() / columns)),
            Shape::Shades(columns, values, _) => Some((*columns, values.len() / columns)),
            _ => None,
        });
        let side = |length: f64, cells: usize| {
            let cells = cells.max(1) as f64;
            0.5 * (2.0 * length / cells).round().max(1.0) * cells
        };
        let (wide, high) = self.size;
        cells.map_or(self.size, |it| (side(wide, it.0), side(high, it.1)))
    }
}
