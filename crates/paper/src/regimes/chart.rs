//! The regimes z = p/n over drive frequency and clearance, as a page of maps.

use softstop_dynamics::motion::MotionClass;

use super::boundaries::Boundaries;
use super::{MAPS, is_loaded};
use softstop_draw::panel::{Axes, Panel};
use softstop_draw::pen::{Align, Pen};
use softstop_explore::basin::cells::{RegimeMap, color};

/// Size of a map; room around: left, above the first row, between columns, right, between rows.
const MAP: (f64, f64) = (600.0, 400.0);
const LEFT: f64 = 78.0;
const TOP: f64 = 96.0;
const BETWEEN: f64 = 86.0;
const RIGHT: f64 = 26.0;
const ROW: f64 = 502.0;
/// Height of a row of the legend, how many columns it has, and how wide each is.
const LINE: f64 = 30.0;
const COLUMNS: usize = 4;
const COLUMN: f64 = 330.0;
/// Letters: title, headings, text.
const LETTERS: (u32, u32, u32) = (24, 19, 18);
/// The axes of all maps.
const AXES: Axes<'static> = Axes::new(LETTERS.2, Some("frequency η"), "clearance ρ", (6, 6));
/// Pixels for each unit of length.
const SCALE: f32 = 2.0;
/// Where on a map's height the names of curves stand, as a share of it.
const NAMES_AT: f64 = 0.2;
/// eta and rho of the points A and B.
const POINT: (f64, f64) = (1.15, 10.0);

/// The maps with their boundaries as PNG.
pub(super) fn png(maps: &[RegimeMap], boundaries: &[Boundaries; 2]) -> Result<Vec<u8>, String> {
    let classes = MotionClass::ALL.iter().copied();
    let is_there = |class: &MotionClass| maps.iter().any(|map| map.share(*class) > 0.0);
    let classes: Vec<MotionClass> = classes.filter(is_there).collect();
    let bottom = TOP + ROW * maps.len().div_ceil(2) as f64;
    let width = LEFT + 2.0 * MAP.0 + BETWEEN + RIGHT;
    let height = bottom + LINE * (classes.len().div_ceil(COLUMNS) as f64 + 0.2);
    let mut pen = Pen::new(width, height);
    pen.fill(&[(0.0, 0.0, width, height)], "#ffffff");
    let title = "Regimes z = p/n: p impacts in n drive periods";
    pen.heading((LEFT, 42.0), LETTERS.0, Align::Left, title);
    for (index, map) in maps.iter().enumerate() {
        let left = LEFT + (MAP.0 + BETWEEN) * (index % 2) as f64;
        let top = TOP + ROW * (index / 2) as f64;
        let lines = boundaries[usize::from(is_loaded(index))].lines();
        let panel = Panel::new((left, top, MAP.0, MAP.1), map.eta, map.rho);
        draw(&mut pen, &panel, index, map, &lines);
    }
    legend(&mut pen, bottom, &classes);
    pen.png_at(SCALE)
}

/// What the colours mean.
fn legend(pen: &mut Pen, top: f64, classes: &[MotionClass]) {
    for (index, class) in classes.iter().enumerate() {
        let left = LEFT + COLUMN * (index % COLUMNS) as f64;
        let line = top + LINE * (index / COLUMNS) as f64;
        let square = (left, line - 15.0, 30.0, 18.0);
        pen.fill(&[square], color(*class));
        pen.frame(square);
        pen.text((left + 42.0, line), LETTERS.2, Align::Left, class.name());
    }
}

/// A map with lines, a point, and names of wide regimes and of lines.
fn draw(
    pen: &mut Pen,
    panel: &Panel,
    index: usize,
    map: &RegimeMap,
    lines: &[(&str, Vec<(f64, f64)>)],
) {
    let (left, top, ..) = panel.area;
    let heading = format!("{} {}", letter(index), MAPS[index].page);
    pen.heading((left, top - 12.0), LETTERS.1, Align::Left, &heading);
    let colors = map.cells.iter().map(|cell| color(cell.class()));
    panel.cells(pen, map.columns, &colors.collect::<Vec<_>>());
    for (name, points) in lines {
        panel.rimmed(pen, points, dashes(name));
    }
    panel.axes(pen, &AXES);
    for class in [MotionClass::Zero, MotionClass::One, MotionClass::TwoThirds] {
        if let Some(place) = map.widest(class) {
            pen.label(panel.place(place), LETTERS.2, class.name());
        }
    }
    let rho = panel.y.0 + NAMES_AT * (panel.y.1 - panel.y.0);
    for (name, points) in lines {
        for eta in crossings(points, rho) {
            if panel.holds((eta, rho)) {
                pen.label(panel.place((eta, rho)), LETTERS.2, name);
            }
        }
    }
    if panel.holds(POINT) {
        let (x, y) = panel.place(POINT);
        pen.spot((x, y), 6.0);
        let name = if is_loaded(index) { "B" } else { "A" };
        pen.label((x + 18.0, y - 10.0), LETTERS.2, name);
    }
}

/// Dashes of a boundary and the gaps between them.
fn dashes(name: &str) -> Option<(f64, f64)> {
    match name {
        "g₀" => Some((3.0, 4.0)),
        "s_PD" => Some((9.0, 5.0)),
        _ => None,
    }
}

/// Where a curve is at this height.
fn crossings(points: &[(f64, f64)], height: f64) -> Vec<f64> {
    let pairs = points.windows(2);
    let crossing = |pair: &[(f64, f64)]| {
        let (from, to) = (pair[0], pair[1]);
        let crosses = (from.1 < height) != (to.1 < height);
        crosses.then(|| from.0 + (to.0 - from.0) * (height - from.1) / (to.1 - from.1))
    };
    pairs.filter_map(crossing).collect()
}

/// (a), (b), ...
fn letter(index: usize) -> String {
    format!("({})", char::from(b'a' + index as u8))
}
