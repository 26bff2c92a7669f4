//! Columns: what a table holds, said once for CSV, for people and for `--help`.
//!
//! A new column is one line: name, unit, form for people (none if CSV alone has it), meaning, cell.
//!
//! ```
//! use softstop_console::column::{Column, Units, help, text};
//! use softstop_console::columns;
//!
//! struct Jump { place: f64, velocity: Option<f64>, motion: &'static str }
//!
//! fn jumps() -> [Column<Jump>; 3] {
//!     columns! { Jump, jump;
//!         "motion" [None] Plain, "what follows" => jump.motion;
//!         "frequency" [Frequency] Fixed(4), "of the drive" => jump.place;
//!         "velocity" [Velocity], "before impact" => jump.velocity;
//!     }
//! }
//!
//! let rows = [Jump { place: 1.5, velocity: None, motion: "z = 1" }];
//! assert_eq!(
//!     text(&jumps(), &rows, &Units::SI),
//!     "motion   frequency (rad/s)\nz = 1               1.5000\n"
//! );
//! assert!(help("jumps.csv", &jumps()).contains("velocity    m/s     before impact"));
//! ```

use std::borrow::Borrow;

use serde::Serialize;

pub use crate::units::{Unit, Units};

/// What stands in a column of a row.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Cell {
    /// Nothing.
    Empty,
    /// A word.
    Text(String),
    /// A number.
    Number(f64),
    /// A count.
    Count(u64),
    /// Yes or no.
    Flag(bool),
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<f64> for Cell {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<u64> for Cell {
    fn from(count: u64) -> Self {
        Self::Count(count)
    }
}

impl From<usize> for Cell {
    fn from(count: usize) -> Self {
        Self::Count(count as u64)
    }
}

impl From<bool> for Cell {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}

impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Empty, Into::into)
    }
}

/// How numbers are written for people.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// As they are.
    Plain,
    /// With so many decimals.
    Fixed(usize),
    /// With so many decimals and a power of ten.
    Power(usize),
    /// A share in per cent, with so many decimals.
    Percent(usize),
}

impl Form {
    fn write(self, cell: &Cell) -> String {
        match (cell, self) {
            (Cell::Empty, _) => "-".to_owned(),
            (Cell::Text(text), _) => text.clone(),
            (Cell::Count(count), _) => count.to_string(),
            (Cell::Flag(flag), _) => if *flag { "yes" } else { "no" }.to_owned(),
            (Cell::Number(number), Self::Plain) => number.to_string(),
            (Cell::Number(number), Self::Fixed(decimals)) => format!("{number:.decimals$}"),
            (Cell::Number(number), Self::Power(decimals)) => format!("{number:.decimals$e}"),
            (Cell::Number(number), Self::Percent(decimals)) => {
                format!("{:.decimals$} %", 100.0 * number)
            }
        }
    }
}

/// A column of a table whose rows are `T`.
#[derive(Debug, Clone, Copy)]
pub struct Column<T> {
    name: &'static str,
    unit: Unit,
    meaning: &'static str,
    cell: fn(&T) -> Cell,
    form: Option<Form>,
}

/// A column that CSV has: its name, unit and meaning, and where its cells come from.
pub const fn column<T>(
    name: &'static str,
    unit: Unit,
    meaning: &'static str,
    cell: fn(&T) -> Cell,
) -> Column<T> {
    Column {
        name,
        unit,
        meaning,
        cell,
        form: None,
    }
}

/// An array of [`Column`]s, one in each line; see [`column`](crate::column).
#[macro_export]
macro_rules! columns {
    ($row:ty, $it:ident; $(
        $name:literal [$unit:ident $(($of:expr))?] $($form:ident $(($decimals:expr))?)?,
        $meaning:literal => $cell:expr;
    )*) => {
        [$(
            $crate::column::column(
                $name,
                $crate::column::Unit::$unit $(($of))?,
                $meaning,
                |$it: &$row| $crate::column::Cell::from($cell),
            )
            $(.shown($crate::column::Form::$form $(($decimals))?))?
        ),*]
    };
}

impl<T> Column<T> {
    /// The table for people has it, too, its numbers in this form.
    #[must_use]
    pub const fn shown(self, form: Form) -> Self {
        Self {
            form: Some(form),
            ..self
        }
    }
}

/// The names of columns, the first line of a CSV table.
pub fn names<T>(columns: &[Column<T>]) -> Vec<&'static str> {
    columns.iter().map(|column| column.name).collect()
}

/// What a row has in its columns.
pub fn cells<T>(columns: &[Column<T>], row: &T) -> Vec<Cell> {
    columns.iter().map(|column| (column.cell)(row)).collect()
}

/// The table for people: words to the left, numbers to the right, under names with units.
#[must_use]
pub fn text<T>(
    columns: &[Column<T>],
    rows: impl IntoIterator<Item = impl Borrow<T>>,
    units: &Units,
) -> String {
    let shown = columns
        .iter()
        .filter_map(|column| Some((column, column.form?)));
    let shown: Vec<(&Column<T>, Form)> = shown.collect();
    let heads = shown.iter().map(|(column, _)| {
        let name = column.name.replace('_', " ");
        Cell::Text(units.label(&name, column.unit))
    });
    let rows = rows.into_iter().map(|row| {
        let cells = shown.iter().map(|(column, _)| (column.cell)(row.borrow()));
        cells.collect::<Vec<Cell>>()
    });
    let lines: Vec<Vec<Cell>> = std::iter::once(heads.collect()).chain(rows).collect();
    let width = |index: usize| {
        let written = lines.iter().map(|line| shown[index].1.write(&line[index]));
        written.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let is_word = |index: usize| {
        let words = |line: &Vec<Cell>| matches!(line[index], Cell::Text(_));
        lines.len() > 1 && lines[1..].iter().any(words)
    };
    let layout: Vec<(usize, bool)> = (0..shown.len())
        .map(|index| (width(index), is_word(index)))
        .collect();
    let line = |cells: &Vec<Cell>| {
        let cells = cells.iter().zip(&shown).zip(&layout);
        let padded = cells.map(|((cell, (_, form)), (width, is_word))| {
            let cell = form.write(cell);
            if *is_word {
                format!("{cell:<width$}")
            } else {
                format!("{cell:>width$}")
            }
        });
        let padded: Vec<String> = padded.collect();
        padded.join("   ").trim_end().to_owned() + "\n"
    };
    lines.iter().map(line).collect()
}

/// What the columns of a file mean: a paragraph at the end of `--help`.
#[must_use]
pub fn help<T>(file: &str, columns: &[Column<T>]) -> String {
    let lines: Vec<[&str; 3]> = columns
        .iter()
        .map(|column| {
            let unit = Units::SI.name(column.unit);
            let unit = if unit.is_empty() { "-" } else { unit };
            [column.name, unit, column.meaning]
        })
        .collect();
    let width = |index: usize| lines.iter().map(|line| line[index].chars().count()).max();
    let [name_width, unit_width] = [0, 1].map(|index| width(index).unwrap_or(0));
    let line = |[name, unit, meaning]: &[&str; 3]| {
        format!("\n  {name:name_width$}   {unit:unit_width$}   {meaning}")
    };
    format!("\n\nColumns of {file}:") + &lines.iter().map(line).collect::<String>()
}
