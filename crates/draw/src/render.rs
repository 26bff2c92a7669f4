//! A chart on its page: SVG, PNG, and SVG inside HTML.

use crate::chart::{Chart, Legend};
use crate::index::width;
use crate::layout::{GAP, LINE, place};
use crate::legend::{column, draw_column, draw_lines, entries, height};
use crate::pen::{Align, Pen};
use crate::stroke::Point;
use crate::style;

/// Room around the page.
const EDGE: f64 = 16.0;
/// Pixels of a PNG for each pixel of the chart.
const SCALE: f32 = 2.0;

impl Chart {
    /// As an SVG document.
    pub fn svg(&self) -> String {
        self.drawn(true).svg()
    }

    /// As PNG, with two pixels for each of the chart's.
    ///
    /// # Errors
    /// Why it cannot be made.
    pub fn png(&self) -> Result<Vec<u8>, String> {
        self.drawn(true).png_at(SCALE)
    }

    /// As an element of an HTML page, without its headings and in the page's colours, light or dark; the title is told to
    /// those who cannot see it. Its texts are written anew.
    pub fn inline(&self, anew: impl Fn(&str) -> String) -> String {
        let pen = self.drawn(false);
        let document = pen.svg_with(anew);
        // What stands before is the ground of the document.
        let (_, body) = document.split_once("fill=\"white\" />").unwrap_or_default();
        let body = body.replace("</svg>", "");
        let body: String = body.lines().map(str::trim).collect();
        let body = style::themed(&body);
        let (width, height) = pen.size();
        let title = self.title.replace('&', "&amp;").replace('<', "&lt;");
        let title = title.replace('"', "&quot;");
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{title}\">{body}</svg>"
        )
    }

    /// With headings on white, or without on the ground of another page.
    fn drawn(&self, is_page: bool) -> Pen {
        let letters = self.letters;
        let key = entries(self.panels.iter().filter(|it| self.legend_of(it).is_none()));
        let (beside, least) = match self.legend {
            Legend::Right if !key.is_empty() => {
                let (wide, high) = column(&key, letters);
                (GAP + wide, high)
            }
            _ => (0.0, 0.0),
        };
        let title = 0.95 * width(letters + 6, &self.title);
        let wide = match self.page {
            Some((width, _)) => width - 2.0 * EDGE,
            None => (place(self, None).1.0 + beside).max(if is_page { title } else { 0.0 }),
        };
        let in_lines = |wanted: Legend| match self.legend == wanted && !key.is_empty() {
            true => height(&key, letters, wide) + 0.5 * GAP,
            false => 0.0,
        };
        let (head, notes) = match is_page {
            true => (self.headings(wide), lines(&self.notes, letters - 1, wide)),
            false => (Vec::new(), Vec::new()),
        };
        let top = EDGE + tall(&head);
        let above = top + in_lines(Legend::Above);
        let below = in_lines(Legend::Below);
        let rest = below + tall(&notes) + EDGE;
        let room = self.page.map(|it| (wide - beside, it.1 - above - rest));
        let (mut placed, end) = place(self, room);
        let bottom = above + end.1.max(least);
        let size = self.page.unwrap_or((wide + 2.0 * EDGE, bottom + rest));
        let size = (size.0.ceil(), size.1.ceil());
        let mut pen = match is_page {
            true => Pen::page(size.0, size.1),
            false => Pen::new(size.0, size.1),
        };
        write(&mut pen, (EDGE, EDGE), &head);
        match self.legend {
            Legend::Right => {
                let first = placed.first().map_or(0.0, |it| it.frame.area.1);
                let place = (
                    EDGE + end.0 + GAP,
                    above + first.min(end.1 - least).max(0.0),
                );
                draw_column(&mut pen, place, letters, &key);
            }
            Legend::Above => draw_lines(&mut pen, (EDGE, top), letters, wide, &key),
            Legend::Below => {
                let place = (EDGE, bottom + 0.5 * GAP);
                draw_lines(&mut pen, place, letters, wide, &key);
            }
            Legend::Inside(_) => {}
        }
        for panel in &mut placed {
            panel.frame.area.0 += EDGE;
            panel.frame.area.1 += above;
            panel.draw(&mut pen, letters);
        }
        write(&mut pen, (EDGE, bottom + below), &notes);
        pen
    }

    /// Title and subtitle in lines of this width.
    fn headings(&self, wide: f64) -> Vec<Line> {
        let mut head = Vec::new();
        if !self.title.is_empty() {
            head.push((self.letters + 6, true, self.title.clone()));
        }
        let subtitle = std::slice::from_ref(&self.subtitle);
        head.extend(lines(subtitle, self.letters - 1, wide));
        head
    }
}

/// Size of letters, whether they are bold, and what is written.
type Line = (u32, bool, String);

/// Height of lines with the room below them.
fn tall(lines: &[Line]) -> f64 {
    let heights = lines.iter().map(|(letters, ..)| LINE * f64::from(*letters));
    heights.sum::<f64>() + if lines.is_empty() { 0.0 } else { 0.5 * GAP }
}

fn write(pen: &mut Pen, (left, mut top): Point, lines: &[Line]) {
    for (letters, is_bold, text) in lines {
        top += LINE * f64::from(*letters);
        let place = (left, top - 0.35 * f64::from(*letters));
        match is_bold {
            true => pen.heading(place, *letters, Align::Left, text),
            false => pen.words(place, *letters, Align::Left, (style::ASIDE, false), text),
        }
    }
}

/// Paragraphs in lines of this width.
fn lines(paragraphs: &[String], letters: u32, wide: f64) -> Vec<Line> {
    let mut lines: Vec<Line> = Vec::new();
    for paragraph in paragraphs {
        let mut line = String::new();
        for word in paragraph.split(' ') {
            let longer = format!("{line} {word}").trim().to_owned();
            if 0.92 * width(letters, &longer) > wide && !line.is_empty() {
                lines.push((
                    letters,
                    false,
                    std::mem::replace(&mut line, word.to_owned()),
                ));
            } else {
                line = longer;
            }
        }
        if !line.is_empty() {
            lines.push((letters, false, line));
        }
    }
    lines
}
