//! A table as a picture.

use super::pen::{Align, Pen};

/// Lines of cells under a line of names.
#[derive(Debug, Clone)]
pub struct TablePicture {
    /// Above it.
    pub title: String,
    /// Names of the columns, and their widths in pixels.
    pub columns: Vec<(&'static str, f64)>,
    /// The cells of each line, and whether a rule is drawn above it.
    pub lines: Vec<(Vec<String>, bool)>,
    /// Below it.
    pub notes: Vec<String>,
}

/// Distance of lines, size of letters, margin.
const LINE: f64 = 27.0;
const LETTERS: u32 = 15;
const MARGIN: f64 = 28.0;
/// Where the first line stands.
const TOP: f64 = 100.0;

impl TablePicture {
    /// The picture as an SVG document.
    pub fn svg(&self) -> String {
        let width = 2.0 * MARGIN + self.columns.iter().map(|column| column.1).sum::<f64>();
        let bottom = TOP + LINE * self.lines.len() as f64;
        let height = bottom + 20.0 + 22.0 * self.notes.len() as f64;
        let mut pen = Pen::page(width, height);
        pen.heading((MARGIN, 36.0), 19, Align::Left, &self.title);
        let names = self.columns.iter().map(|column| column.0);
        for (name, left) in names.zip(self.lefts()) {
            pen.heading((left, TOP - 30.0), LETTERS, Align::Left, name);
        }
        let rule = |pen: &mut Pen, y: f64| pen.tick((MARGIN, y), (width - MARGIN, y));
        rule(&mut pen, TOP - 19.0);
        for (index, (cells, is_ruled)) in self.lines.iter().enumerate() {
            let y = TOP + LINE * index as f64;
            if *is_ruled && index > 0 {
                rule(&mut pen, y - 19.0);
            }
            for (cell, left) in cells.iter().zip(self.lefts()) {
                pen.text((left, y), LETTERS, Align::Left, cell);
            }
        }
        rule(&mut pen, bottom - 19.0);
        for (index, note) in self.notes.iter().enumerate() {
            let y = bottom + 8.0 + 22.0 * index as f64;
            pen.text((MARGIN, y), LETTERS - 1, Align::Left, note);
        }
        pen.svg()
    }

    /// The left edges of the columns.
    fn lefts(&self) -> impl Iterator<Item = f64> + '_ {
        self.columns.iter().scan(MARGIN, |left, column| {
            let here = *left;
            *left += column.1;
            Some(here)
        })
    }
}
