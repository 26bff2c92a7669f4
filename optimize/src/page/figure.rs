//! Pictures inside the page: their sizes, their legends, and how a drawing becomes a part of the page.

use softstop_draw::panel::Panel;
use softstop_draw::pen::{Align, Pen, Stroke, width};
use softstop_draw::shapes::Sign;
use softstop_draw::style;

use super::words::plain;

/// Letters of all pictures.
pub(super) const LETTERS: u32 = 14;
/// From line to line.
pub(super) const LINE: f64 = 19.0;
/// Room left of a panel for numbers and name, and below it.
pub(super) const ROOM: (f64, f64) = (80.0, 50.0);
/// Room above.
pub(super) const EDGE: f64 = 16.0;
/// Room at the right: half of a wide number under the end of an axis.
pub(super) const RIGHT: f64 = 28.0;
/// What stands for a colour of a drawing in the page, light or dark.
const COLORS: [(&str, &str); 7] = [
    ("#222222", "var(--ink)"),
    ("#ffffff", "var(--card)"),
    ("#e9e9e9", "var(--grid)"),
    ("#777777", "var(--aside)"),
    ("#0072b2", "var(--design)"),
    ("#000000", "var(--ink)"),
    ("#d55e00", "var(--mark)"),
];

/// The size of a picture, in its own pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Size {
    pub(super) width: f64,
    pub(super) height: f64,
}

/// A whole line of the page.
pub(super) const WIDE: Size = Size {
    width: 980.0,
    height: 460.0,
};
/// Two in a line.
pub(super) const HALF: Size = Size {
    width: 480.0,
    height: 400.0,
};

/// A picture with its words.
#[derive(Debug, Clone, serde::Serialize)]
pub(super) struct Figure {
    /// Above it.
    pub(super) title: String,
    /// The picture as SVG elements.
    pub(super) svg: String,
    /// What it shows, in a sentence or two.
    pub(super) caption: String,
    /// Whether it takes a whole line.
    pub(super) is_wide: bool,
}

impl Figure {
    /// A drawing of this size; its title is told to those who cannot see it, too.
    pub(super) fn new(pen: &Pen, size: Size, title: &str, caption: String) -> Self {
        Self {
            title: title.to_owned(),
            svg: inline(&pen.svg_with(plain), size, title),
            caption,
            is_wide: size == WIDE,
        }
    }
}

/// The elements of a document, in colours of the page.
fn inline(document: &str, size: Size, title: &str) -> String {
    let body = document
        .split_once("fill=\"white\" />")
        .map_or(document, |(_, body)| body);
    let body = body.replace("</svg>", "");
    let body: String = body.lines().map(str::trim).collect();
    let body = COLORS
        .iter()
        .fold(body, |body, (from, to)| body.replace(from, to));
    let Size { width, height } = size;
    let title = super::words::html(title)
        .replace("<sub>", "")
        .replace("</sub>", "");
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{title}\">{body}</svg>"
    )
}

/// Signs and what they mean, in lines from the left end on; where the next line would be.
pub(super) fn legend(
    pen: &mut Pen,
    (left, top): (f64, f64),
    right: f64,
    entries: &[(Sign, String)],
) -> f64 {
    let size = f64::from(LETTERS);
    let (mut x, mut y) = (left, top);
    for (sign, text) in entries {
        let wide = 2.8 * size + 0.86 * width(LETTERS, text);
        if x > left && x + wide > right {
            (x, y) = (left, y + LINE);
        }
        pen.legend((x, y), LETTERS, &[(*sign, text.clone())]);
        x += wide + 20.0;
    }
    if entries.is_empty() { top } else { y + LINE }
}

/// Names of places along the axis across, to stand above a panel: each begins at its place, in a line so high that no
/// other one's way down crosses it.
pub(super) struct Names {
    placed: Vec<(String, f64, usize)>,
    lines: usize,
}

impl Names {
    /// Those inside a panel, whose height plays no part.
    pub(super) fn new(panel: &Panel, names: &[(String, f64)]) -> Self {
        let inside = |it: &&(String, f64)| panel.holds((it.1, panel.y.0));
        let mut names: Vec<&(String, f64)> = names.iter().filter(inside).collect();
        names.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut placed: Vec<(String, f64, usize)> = Vec::new();
        for (name, at) in names {
            let end = panel.across(*at) + 0.86 * width(LETTERS, name) + 8.0;
            let crossed = placed.iter().filter(|it| panel.across(it.1) < end);
            let line = crossed.map(|it| it.2 + 1).max().unwrap_or(0);
            placed.push((name.clone(), *at, line));
        }
        let lines = placed.iter().map(|it| it.2 + 1).max().unwrap_or(0);
        Self { placed, lines }
    }

    /// The panel with room above it for the names.
    pub(super) fn room(&self, panel: Panel) -> Panel {
        let room = LINE * self.lines as f64;
        let (left, top, wide, tall) = panel.area;
        let area = (left, top + room, wide, tall - room);
        Panel { area, ..panel }
    }

    /// The names, and their lines down through the panel.
    pub(super) fn draw(&self, pen: &mut Pen, panel: &Panel, stroke: Stroke) {
        for (name, at, line) in &self.placed {
            let x = panel.across(*at);
            let y = panel.area.1 - 6.0 - LINE * *line as f64;
            let whole = Stroke {
                dashes: None,
                width: 1.0,
                ..stroke
            };
            pen.line(&[(x, y - 10.0), (x, panel.area.1)], whole);
            panel.curve(pen, &[(*at, panel.y.0), (*at, panel.y.1)], stroke);
            let room = panel.right() + RIGHT - 0.86 * width(LETTERS, name);
            match x + 4.0 < room {
                true => pen.text((x + 4.0, y), LETTERS, Align::Left, name),
                false => pen.text((x - 4.0, y), LETTERS, Align::Right, name),
            }
        }
    }
}

/// The line of what bounds something.
pub(super) const BOUND: Stroke = Stroke::dashed(style::ASIDE, 1.3, (5.0, 4.0));

/// The ends of an axis; from 0 to 1 if they are none.
pub(super) fn ends([low, high]: [f64; 2]) -> (f64, f64) {
    match low.is_finite() && high.is_finite() && low < high {
        true => (low, high),
        false => (0.0, 1.0),
    }
}

/// Points that have a place.
pub(super) fn finite(points: &[[f64; 2]]) -> Vec<(f64, f64)> {
    let points = points.iter().map(|[x, y]| (*x, *y));
    points
        .filter(|(x, y)| x.is_finite() && y.is_finite())
        .collect()
}
