//! Where the panels of a chart are on the page: margins follow from the texts at the axes.

use crate::axis::{Ticks, count_upwards, widest};
use crate::chart::{Chart, Legend, Panel};
use crate::frame::Frame;
use crate::grid::{GAP, Item, arrange};
use crate::index::width;
use crate::layer::Shape;
use crate::legend::Key;
use crate::names::{Name, lines, names};
use crate::stroke::Point;

/// Length of a tick.
pub(crate) const TICK: f64 = 5.0;
/// Height of a line of text, in units of its letters.
pub(crate) const LINE: f64 = 1.4;
/// Width of a bar of shades.
pub(crate) const BAR: f64 = 18.0;

/// A panel whose ranges, texts and margins are known.
pub(crate) struct PlacedPanel<'a> {
    pub(crate) panel: &'a Panel,
    /// Size of the letters.
    pub(crate) letters: u32,
    pub(crate) frame: Frame,
    /// Across, upwards, and of the bar of shades.
    pub(crate) ticks: [Ticks; 3],
    /// What is written beside them.
    pub(crate) labels: [String; 3],
    /// Whether numbers and names of both axes are written.
    pub(crate) shows: [bool; 2],
    pub(crate) names: Vec<Name>,
    /// Where its own layers are explained, and how.
    pub(crate) legend: Option<Legend>,
    pub(crate) key: Key,
    /// Room left, right, above and below.
    pub(crate) margins: [f64; 4],
}

impl<'a> PlacedPanel<'a> {
    /// A panel of this size, its corner at the origin.
    fn new(chart: &Chart, panel: &'a Panel, size: (f64, f64), (ranges, shows): Shown) -> Self {
        let ([x, y], letters) = (ranges, chart.letters);
        let area = (0.0, 0.0, size.0, size.1);
        let frame = Frame { area, x, y };
        let upwards = count_upwards(size.1);
        let bar = panel.bar();
        let bar = bar.map(|(range, axis)| (axis.ticks_of(range, upwards), axis.label(range)));
        let (bar, shade) = bar.unwrap_or_default();
        let legend = chart.legend_of(panel);
        let mut placed = Self {
            panel,
            letters,
            frame,
            ticks: [
                panel.x.ticks_across(x, size.0, letters),
                panel.y.ticks_of(y, upwards),
                bar,
            ],
            labels: [panel.x.label(x), panel.y.label(y), shade],
            shows,
            names: names(panel, &frame, letters),
            legend,
            key: Key::new(legend.map(|_| panel), letters),
            margins: [0.0; 4],
        };
        placed.margins = placed.needed();
        placed
    }

    /// Room that is needed left, right, above and below.
    fn needed(&self) -> [f64; 4] {
        let (letters, size) = (self.letters, f64::from(self.letters));
        let [across, upwards, bar] = &self.ticks;
        let Panel { x, y, title, .. } = self.panel;
        let line = |text: &str| if text.is_empty() { 0.0 } else { LINE * size };
        let left = match self.shows[1] {
            true if y.is_bare(upwards) => 2.0,
            true => self.room_upwards(upwards, &self.labels[1]),
            false => TICK,
        };
        let overhang = across.last().map_or(0.0, |(value, text)| {
            0.5 * width(letters, text) - (self.frame.right() - self.frame.x_of(*value))
        });
        let bar = match self.panel.bar() {
            Some(_) => GAP + self.room_upwards(bar, &self.labels[2]) + BAR,
            None => 0.0,
        };
        let above = line(title) + LINE * size * lines(&self.names) as f64;
        let below = match self.shows[0] {
            true if x.is_bare(across) => 0.0,
            true => TICK + LINE * size + 1.1 * line(&x.name),
            false => TICK,
        };
        let [beside, over, under] = match self.legend {
            Some(legend) => self.key.room(legend, self.frame.area.2),
            None => [0.0; 3],
        };
        [
            left,
            bar.max(overhang).max(4.0) + beside,
            above + over + if above > 0.0 { 6.0 } else { 0.0 },
            below + under,
        ]
    }

    /// Room for numbers and name of an axis upwards.
    fn room_upwards(&self, ticks: &Ticks, name: &str) -> f64 {
        let name = if name.is_empty() { 0.0 } else { LINE };
        TICK + 4.0 + widest(ticks, self.letters) + name * f64::from(self.letters)
    }

    /// A point as the frame takes it.
    pub(crate) fn position(&self, (x, y): Point) -> Point {
        (self.panel.x.position(x), self.panel.y.position(y))
    }
}

/// The panels of a chart, with the size of the page that is theirs; it begins at the origin.
pub(crate) fn place(chart: &Chart, room: Option<(f64, f64)>) -> (Vec<PlacedPanel<'_>>, (f64, f64)) {
    let ranges = ranges(chart);
    let wanted: Vec<(f64, f64)> = chart.panels.iter().map(Panel::snapped).collect();
    let (mut sizes, mut placed, mut end) = (wanted.clone(), Vec::new(), (0.0, 0.0));
    // Texts follow from sizes, and sizes from texts.
    for _ in 0..3 {
        let panels = chart.panels.iter().zip(&sizes).zip(&ranges);
        let panels =
            panels.map(|((panel, size), shown)| PlacedPanel::new(chart, panel, *size, *shown));
        placed = panels.collect();
        let (mut columns, mut rows) = (Vec::new(), Vec::new());
        for (PlacedPanel { panel, margins, .. }, size) in placed.iter().zip(&wanted) {
            let [left, right, above, below] = *margins;
            columns.push(Item {
                tracks: (panel.at.0, panel.span.0),
                size: size.0,
                room: [left, right],
            });
            rows.push(Item {
                tracks: (panel.at.1, panel.span.1),
                size: size.1,
                room: [above, below],
            });
        }
        let (across, width) = arrange(&columns, room.map(|it| it.0));
        let (down, height) = arrange(&rows, room.map(|it| it.1));
        end = (width, height);
        sizes.clear();
        for ((it, (left, wide)), (top, high)) in placed.iter_mut().zip(across).zip(down) {
            it.frame.area = (left, top, wide, high);
            sizes.push((wide, high));
        }
    }
    (placed, end)
}

/// The ranges of both axes.
type Ranges = [(f64, f64); 2];
/// These, and which of both axes have numbers.
type Shown = (Ranges, [bool; 2]);

/// The ranges of all panels, and which of their axes have numbers.
fn ranges(chart: &Chart) -> Vec<Shown> {
    let all = chart.panels.iter().map(|panel| {
        let points: Vec<Point> = panel.layers.iter().flat_map(|it| it.extent()).collect();
        let x = panel.x.range_of(points.iter().map(|it| it.0));
        (panel, [x, panel.y.range_of(points.iter().map(|it| it.1))])
    });
    let all: Vec<(&Panel, Ranges)> = all.collect();
    let union = |a: (f64, f64), b: (f64, f64)| (a.0.min(b.0), a.1.max(b.1));
    let with = |(panel, own): &(&Panel, Ranges)| {
        let (mut ranges, mut shows) = (*own, [true; 2]);
        for (other, range) in &all {
            if chart.shares_x && other.at.0 == panel.at.0 {
                ranges[0] = union(ranges[0], range[0]);
                shows[0] &= other.at.1 <= panel.at.1;
            }
            if chart.shares_y && other.at.1 == panel.at.1 {
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

#[cfg(test)]
mod tests {
    use super::place;
    use crate::{Axis, Chart, Layer, Panel, Stroke};

    fn line(points: [(f64, f64); 2]) -> Panel {
        Panel {
            x: Axis::new("across"),
            y: Axis::new("upwards"),
            layers: vec![Layer::line(points, Stroke::solid("#000000", 1.0))],
            ..Panel::default()
        }
    }

    #[test]
    fn panels_of_a_column_share_their_axis_across() {
        let panels = [
            line([(0.0, 0.0), (1.0, 5.0)]),
            line([(0.5, -1e4), (2.0, 1e4)]),
        ];
        let chart = Chart {
            shares_x: true,
            ..Chart::new("", panels).in_columns(1)
        };
        let (placed, _) = place(&chart, None);
        assert_eq!(placed[0].frame.x, placed[1].frame.x);
        assert_eq!(placed[0].frame.area.0, placed[1].frame.area.0);
        assert_ne!(placed[0].frame.y, placed[1].frame.y);
        assert_eq!(placed[0].shows, [false, true]);
        assert_eq!(placed[1].shows, [true, true]);
    }

    #[test]
    fn panels_fill_the_page_beside_their_texts() {
        let panels = [
            line([(0.0, 0.0), (1.0, 5e7)]),
            line([(0.0, 0.0), (1.0, 1.0)]),
        ];
        let chart = Chart::new("", panels).in_columns(2);
        let (placed, end) = place(&chart, Some((900.0, 400.0)));
        assert!((end.0 - 900.0).abs() < 1e-9 && (end.1 - 400.0).abs() < 1e-9);
        let [first, second] = [0, 1].map(|index: usize| placed[index].frame.area.2);
        assert!((first - second).abs() < 1e-9);
        assert!(placed[0].margins[0] > placed[1].margins[0]);
    }
}
