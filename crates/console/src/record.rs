//! Records: the figures of one thing, said once for JSON and for people.
//!
//! ```
//! use softstop_console::column::{Column, Units};
//! use softstop_console::columns;
//! use softstop_console::record::Record;
//!
//! struct Blow { velocity: f64, impacts: u64 }
//!
//! let blow: [Column<Blow>; 2] = columns! { Blow, it;
//!     "before_impact_velocity" [Velocity] Fixed(2), "before-impact velocity" => it.velocity;
//!     "impacts" [None], "how many" => it.impacts;
//! };
//! let record = Record::of(&blow, &Blow { velocity: 6.5, impacts: 1 });
//! assert_eq!(record.text(&Units::SI), "before-impact velocity (m/s)   6.50\n");
//! assert_eq!(serde_json::to_string(&record)?, r#"{"before_impact_velocity":6.5,"impacts":1}"#);
//! # Ok::<(), serde_json::Error>(())
//! ```

use crate::cell::{Cell, Figure};
use crate::number::NumberStyle;
use crate::table::aligned;
use crate::units::{Unit, Units};

pub use crate::cell::Record;

impl Record {
    /// The same, and a figure for people under a label of its own.
    #[must_use]
    pub fn with(mut self, name: &'static str, label: &str, cell: impl Into<Cell>) -> Self {
        self.0.push(Figure {
            name,
            label: label.to_owned(),
            unit: Unit::None,
            form: Some(NumberStyle::Six),
            cell: cell.into(),
        });
        self
    }

    /// Adds a figure that programs and pages read and texts leave out.
    #[must_use]
    pub fn hidden(self, name: &'static str, cell: impl Into<Cell>) -> Self {
        let mut record = self.with(name, "", cell);
        if let Some(last) = record.0.last_mut() {
            last.form = None;
        }
        record
    }

    /// The cell of this name.
    pub fn cell(&self, name: &str) -> Option<&Cell> {
        let figure = self.0.iter().find(|it| it.name == name);
        figure.map(|it| &it.cell)
    }

    /// The number of this name; NaN if there is none.
    pub fn number(&self, name: &str) -> f64 {
        match self.cell(name) {
            Some(Cell::Number(number)) => *number,
            Some(Cell::Count(count)) => *count as f64,
            _ => f64::NAN,
        }
    }

    /// The numbers and counts that people read, by what they mean.
    pub fn numbers(&self) -> impl Iterator<Item = (&str, f64)> {
        let shown = self.0.iter().filter(|it| it.form.is_some());
        shown.filter_map(|it| match it.cell {
            Cell::Number(number) => Some((&*it.label, number)),
            Cell::Count(count) => Some((&*it.label, count as f64)),
            _ => None,
        })
    }

    /// The same, and then the figures of another one.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        self.0.extend(other.0);
        self
    }

    /// For people: a line for each figure.
    pub fn text(&self, units: &Units) -> String {
        beside(std::slice::from_ref(self), units)
    }
}

/// Records beside one another, a line for each figure of the first one.
pub fn beside(records: &[Record], units: &Units) -> String {
    let cell = |record: &Record, name, form: NumberStyle| {
        let cell = record.cell(name);
        cell.map_or_else(String::new, |cell| cell.format(form))
    };
    let figures = records.first().into_iter().flat_map(|first| &first.0);
    let line = |figure: &Figure| {
        let form = figure.form?;
        let label = units.label(&figure.label, figure.unit);
        let cells = records.iter().map(|record| cell(record, figure.name, form));
        Some([label].into_iter().chain(cells).collect())
    };
    let lines: Vec<Vec<String>> = figures.filter_map(line).collect();
    aligned(&lines, |index| index == 0)
}

/// Records below one another, a line for each, under the names of the first one's figures; nothing if there is
/// none.
pub fn below(records: &[Record], units: &Units) -> String {
    let shown = |record: &Record| {
        let figures = record.0.iter().filter(|it| it.form.is_some());
        figures.cloned().collect::<Vec<Figure>>()
    };
    let rows: Vec<Vec<Figure>> = records.iter().map(shown).collect();
    let heads = rows.iter().take(1).map(|figures| {
        let head = |it: &Figure| units.label(&it.name.replace('_', " "), it.unit);
        figures.iter().map(head).collect()
    });
    let line = |figures: &Vec<Figure>| {
        let cell = |it: &Figure| it.cell.format(it.form.unwrap_or(NumberStyle::Plain));
        figures.iter().map(cell).collect()
    };
    let lines: Vec<Vec<String>> = heads.chain(rows.iter().map(line)).collect();
    aligned(&lines, |index| {
        let is_word = |row: &Vec<Figure>| matches!(row[index].cell, Cell::Text(_) | Cell::Told(_));
        rows.iter().any(is_word)
    })
}
