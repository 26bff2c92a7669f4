//! A chart on its page: SVG, PNG, and SVG inside HTML.

use crate::canvas::Canvas;
use crate::chart::Chart;
use crate::grid::GAP;
use crate::index::width;
use crate::layout::{LINE, place};
use crate::legend::Key;
use crate::mark::Align;
use crate::stroke::Point;
use crate::style;

/// Room around the page.
const EDGE: f64 = 16.0;
/// Width of bold letters in units of that of others.
const BOLD: f64 = 1.13;
/// Pixels of a PNG for each pixel of the chart.
const SCALE: f32 = 2.0;

impl Chart {
    /// As an SVG document, on a dark screen dark.
    pub fn svg(&self) -> String {
        let document = self.drawn(true).svg(str::to_owned);
        document.replacen('>', &format!(">\n  {}", style::DARK), 1)
    }

    /// As PNG, with two pixels for each of the chart's.
    ///
    /// # Errors
    /// Why it cannot be made.
    pub fn png(&self) -> Result<Vec<u8>, String> {
        self.drawn(true).png(SCALE)
    }

    /// As an element of an HTML page, without its headings and in the page's colours, light or dark; the title is told to
    /// those who cannot see it. Its texts are written anew.
    pub fn inline(&self, anew: impl Fn(&str) -> String) -> String {
        let canvas = self.drawn(false);
        let title = anew(&self.title).replace('&', "&amp;").replace('<', "&lt;");
        let title = title.replace('"', "&quot;");
        let document = canvas.svg(anew);
        // What stands before is the ground of the document.
        let (_, body) = document.split_once("fill=\"white\" />").unwrap_or_default();
        let body = body.replace("</svg>", "");
        let body: String = body.lines().map(str::trim).collect();
        let body = style::themed(&body);
        let (width, height) = canvas.size();
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{title}\">{body}</svg>"
        )
    }

    /// With headings on white, or without on the ground of another page.
    fn drawn(&self, is_page: bool) -> Canvas {
        let letters = self.letters;
        let key = Key::new(
            self.panels.iter().filter(|it| self.legend_of(it).is_none()),
            letters,
        );
        let wide = match self.page {
            Some((width, _)) => width - 2.0 * EDGE,
            None => {
                let title = match is_page {
                    true => BOLD * width(letters + 6, &self.title),
                    false => 0.0,
                };
                let beside = key.room(self.legend, f64::INFINITY)[0];
                title.max(place(self, None).1.0 + beside)
            }
        };
        let [beside, over, under] = key.room(self.legend, wide);
        let (head, notes) = match is_page {
            true => (self.headings(wide), lines(&self.notes, letters - 1, wide)),
            false => Default::default(),
        };
        let top = EDGE + tall(&head);
        let rest = under + tall(&notes) + EDGE;
        let room = self
            .page
            .map(|it| (wide - beside, it.1 - top - over - rest));
        let (mut placed, end) = place(self, room);
        let least = key.height(self.legend);
        let bottom = top + over + end.1.max(least);
        let (width, height) = self.page.unwrap_or((wide + 2.0 * EDGE, bottom + rest));
        let size = (width.ceil(), height.ceil());
        let mut canvas = Canvas::new(size);
        if is_page {
            canvas.fill(&[(0.0, 0.0, size.0, size.1)], style::PAPER);
        }
        write(&mut canvas, (EDGE, EDGE), &head);
        // A legend beside begins at the height of the first panel, if it has room there.
        let first = placed.first().map_or(0.0, |it| it.frame.area.1);
        let lower = first.min(end.1 - least).max(0.0);
        let inner = (EDGE, top + over + lower, wide, bottom - top - over - lower);
        let outer = (EDGE, top, end.0 + beside, bottom + under - top);
        key.draw(&mut canvas, self.legend, inner, outer);
        for panel in &mut placed {
            panel.frame.area.0 += EDGE;
            panel.frame.area.1 += top + over;
            panel.draw(&mut canvas);
        }
        write(&mut canvas, (EDGE, bottom + under), &notes);
        canvas
    }

    /// Title and subtitle in lines of this width.
    fn headings(&self, wide: f64) -> Vec<Line> {
        let of = |text: &String, letters, wide| lines(std::slice::from_ref(text), letters, wide);
        let title = of(&self.title, self.letters + 6, wide / BOLD);
        let title = title.into_iter().map(|line| (line.0, true, line.2));
        title
            .chain(of(&self.subtitle, self.letters - 1, wide))
            .collect()
    }
}

/// Size of letters, whether they are bold, and what is written.
type Line = (u32, bool, String);

/// Height of lines with the room below them.
fn tall(lines: &[Line]) -> f64 {
    let heights = lines.iter().map(|(letters, ..)| LINE * f64::from(*letters));
    heights.sum::<f64>() + if lines.is_empty() { 0.0 } else { 0.5 * GAP }
}

fn write(canvas: &mut Canvas, (left, mut top): Point, lines: &[Line]) {
    for (letters, is_bold, text) in lines {
        top += LINE * f64::from(*letters);
        let place = (left, top - 0.35 * f64::from(*letters));
        match is_bold {
            true => canvas.heading(place, *letters, text),
            false => canvas.colored_text(place, *letters, Align::Left, style::ASIDE, text),
        }
    }
}

/// Paragraphs in lines of this width.
fn lines(paragraphs: &[String], letters: u32, wide: f64) -> Vec<Line> {
    let mut lines: Vec<String> = Vec::new();
    for paragraph in paragraphs.iter().filter(|it| !it.is_empty()) {
        lines.push(String::new());
        for word in paragraph.split(' ') {
            let last = lines.last_mut();
            let longer = last
                .as_ref()
                .map(|line| format!("{line} {word}").trim().to_owned());
            match (last, longer) {
                (Some(line), Some(longer))
                    if line.is_empty() || width(letters, &longer) <= wide =>
                {
                    *line = longer
                }
                _ => lines.push(word.to_owned()),
            }
        }
    }
    lines
        .into_iter()
        .map(|line| (letters, false, line))
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::{Align, Chart, Layer, Mark, Panel, Stroke, style};

    #[test]
    fn what_is_no_number_is_not_drawn() {
        let (nan, stroke) = (f64::NAN, Stroke::solid(style::DESIGN, 1.0));
        for x in [nan, 0.5] {
            let layers = [
                Layer::line([], stroke),
                Layer::line([(1.0, x), (x, x)], stroke),
                Layer::line([(0.0, 0.0), (x, 0.5), (1.0, 1.0)], stroke).named("line"),
                Layer::contour([(0.0, x), (1.0, 1.0)], None),
                Layer::dots([(x, 1.0)], 1.0, style::INK),
                Layer::marks([(x, 1.0)], Mark::Triangle, style::INK),
                Layer::marks([(x, x)], Mark::Diamond, style::INK),
                Layer::band([(0.0, [x, 1.0]), (1.0, [0.0, 1.0])], style::INK, 0.5),
                Layer::boxes([[(x, 1.0), (0.0, f64::INFINITY)]], style::INK, 0.5),
                Layer::shades(2, [x, 1.0], "shade"),
                Layer::ring((x, 0.5), (0.1, 0.1)),
                Layer::horizontal(x, stroke, "across"),
                Layer::vertical(x, stroke, "upwards"),
                Layer::arrow((x, 0.0), (1.0, 1.0), stroke),
                Layer::direction([(x, 0.0), (1.0, 1.0)], 0.5, stroke),
                Layer::text((0.5, x), Align::Left, "text"),
                Layer::label((x, 0.5), "label"),
            ];
            let alone = layers.iter().map(|it| vec![it.clone()]);
            for layers in alone.chain([layers.to_vec()]) {
                let panel = Panel {
                    layers: layers.clone(),
                    ..Panel::default()
                };
                let svg = Chart::new("Chart", [panel]).svg();
                assert!(!svg.contains("NaN") && !svg.contains("inf"), "{layers:?}");
                assert!(layers.len() == 1 || svg.contains("line"));
            }
        }
    }

    #[test]
    fn a_page_has_its_own_colours_in_place_of_ours() {
        let line = Layer::line([(0.0, 0.0), (1.0, 1.0)], Stroke::solid(style::DESIGN, 1.0));
        let panel = Panel {
            layers: vec![line.named("s_SN")],
            ..Panel::default()
        };
        let page = Chart::new("a < b", [panel]).inline(str::to_owned);
        assert!(page.contains("aria-label=\"a &lt; b\"") && page.contains("var(--design)"));
        assert!(!page.contains('#') && !page.contains("a < b"), "{page}");
    }
}
