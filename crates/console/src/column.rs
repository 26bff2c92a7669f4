//! Columns: what a table holds, said once for CSV, for people and for `--help`.
//!
//! A new column is one line:
//!
//! ```
//! use softstop_console::column::{Column, Form, Unit, Units, column, help, text};
//!
//! struct Jump { place: f64, velocity: Option<f64>, motion: &'static str }
//!
//! fn columns() -> [Column<Jump>; 3] {
//!     [
//!         column("motion", Unit::None, "what follows", |jump: &Jump| jump.motion.into())
//!             .shown(Form::Plain),
//!         column("frequency", Unit::Frequency, "of the drive", |jump: &Jump| jump.place.into())
//!             .shown(Form::Fixed(4)),
//!         column("velocity", Unit::Velocity, "before impact", |jump: &Jump| jump.velocity.into()),
//!     ]
//! }
//!
//! let jumps = [Jump { place: 1.5, velocity: None, motion: "z = 1" }];
//! assert_eq!(
//!     text(&columns(), &jumps, &Units::SI),
//!     "motion   frequency (rad/s)\nz = 1               1.5000\n"
//! );
//! assert!(help("jumps.csv", &columns()).contains("velocity    m/s     before impact"));
//! ```

use std::borrow::Borrow;

use serde::Serialize;
use softstop::{Language, Machine};

/// What a number is one of; [`Units`] has the names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// A word, a count, a ratio.
    None,
    /// The same for all machines.
    Of(&'static str),
    /// Of a position.
    Length,
    /// Of a velocity.
    Velocity,
    /// Of the drive's angular frequency.
    Frequency,
    /// Of a force.
    Force,
}

/// The names of a machine's own units; empty where its numbers are ratios.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Units {
    length: &'static str,
    velocity: &'static str,
    frequency: &'static str,
    force: &'static str,
}

impl Units {
    /// Of a machine in SI units.
    pub const SI: Self = Self {
        length: "m",
        velocity: "m/s",
        frequency: "rad/s",
        force: "N",
    };
    /// Of the paper's ratios.
    pub const RATIOS: Self = Self {
        length: "",
        velocity: "",
        frequency: "",
        force: "",
    };

    /// Those that a machine speaks.
    #[must_use]
    pub const fn of(machine: &Machine) -> Self {
        match machine.speaks {
            Language::Ratios => Self::RATIOS,
            Language::Hertz => Self {
                frequency: "Hz",
                ..Self::SI
            },
            Language::Si => Self::SI,
        }
    }

    /// The name of a unit.
    #[must_use]
    pub const fn name(&self, unit: Unit) -> &'static str {
        match unit {
            Unit::None => "",
            Unit::Of(name) => name,
            Unit::Length => self.length,
            Unit::Velocity => self.velocity,
            Unit::Frequency => self.frequency,
            Unit::Force => self.force,
        }
    }

    /// What something is called, with its unit: `position (m)`.
    #[must_use]
    pub fn label(&self, name: &str, unit: Unit) -> String {
        match self.name(unit) {
            "" => name.to_owned(),
            unit => format!("{name} ({unit})"),
        }
    }
}

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

/// What the columns of a file mean, for `--help`.
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
        format!("  {name:name_width$}   {unit:unit_width$}   {meaning}\n")
    };
    format!("\nColumns of {file}:\n") + &lines.iter().map(line).collect::<String>()
}
