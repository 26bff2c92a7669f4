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

use crate::cell::Figure;
use crate::record::{Record, below};
use crate::table::aligned;

pub use crate::cell::{Cell, Told};
pub use crate::number::NumberStyle;
pub use crate::units::{Unit, Units};
pub use softstop::Dimension;

/// A column of a table whose rows are `T`.
#[derive(Debug, Clone, Copy)]
pub struct Column<T> {
    pub(crate) name: &'static str,
    pub(crate) unit: Unit,
    pub(crate) meaning: &'static str,
    pub(crate) cell: fn(&T) -> Cell,
    pub(crate) form: Option<NumberStyle>,
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

/// An array of [`Column`]s, one in each line, of a row or of its parts, `(a, b)`; see [`column`](crate::column).
#[macro_export]
macro_rules! columns {
    (@unit None) => { $crate::column::Unit::None };
    (@unit Of($name:expr)) => { $crate::column::Unit::Of($name) };
    (@unit $dimension:ident) => {
        $crate::column::Unit::Own($crate::column::Dimension::$dimension)
    };
    ($row:ty, $it:tt; $(
        $name:literal [$unit:ident $(($of:expr))?] $($form:ident $(($decimals:expr))?)?,
        $meaning:literal => $cell:expr;
    )*) => {
        [$(
            $crate::column::column(
                $name,
                $crate::columns!(@unit $unit $(($of))?),
                $meaning,
                |row: &$row| {
                    #[allow(unused_variables)]
                    let $it = row;
                    $crate::column::Cell::from($cell)
                },
            )
            $(.shown($crate::column::NumberStyle::$form $(($decimals))?))?
        ),*]
    };
}

impl<T> Column<T> {
    /// The table for people has it, too, its numbers in this form.
    #[must_use]
    pub const fn shown(self, form: NumberStyle) -> Self {
        Self {
            form: Some(form),
            ..self
        }
    }
}

impl Record {
    /// What a thing has in these columns.
    pub fn of<T>(columns: &[Column<T>], thing: &T) -> Self {
        let figures = columns.iter().map(|column| Figure {
            name: column.name,
            label: column.meaning.to_owned(),
            unit: column.unit,
            form: column.form,
            cell: (column.cell)(thing),
        });
        Self(figures.collect())
    }

    /// What things have in these columns.
    pub fn all<T>(columns: &[Column<T>], things: &[T]) -> Vec<Self> {
        let things = things.iter();
        things.map(|thing| Self::of(columns, thing)).collect()
    }
}

/// The table for people: words to the left, numbers to the right, under names with units.
pub fn text<T>(
    columns: &[Column<T>],
    rows: impl IntoIterator<Item = impl Borrow<T>>,
    units: &Units,
) -> String {
    let records = rows
        .into_iter()
        .map(|row| Record::of(columns, row.borrow()));
    below(&records.collect::<Vec<_>>(), units)
}

/// The table for programs: an array of the cells of each column, by the column's name.
pub fn arrays<T>(
    columns: &[Column<T>],
    rows: impl IntoIterator<Item = impl Borrow<T>>,
) -> serde_json::Result<Told> {
    let rows: Vec<_> = rows.into_iter().collect();
    let mut value = serde_json::Map::new();
    for column in columns {
        let cells = rows.iter().map(|row| (column.cell)(row.borrow()));
        let cells = cells.map(serde_json::to_value).collect::<Result<_, _>>()?;
        value.insert(column.name.to_owned(), cells);
    }
    Ok(Told::from(serde_json::Value::from(value)))
}

/// What the columns of a file mean: a paragraph at the end of `--help`.
pub fn help<T>(file: &str, columns: &[Column<T>]) -> String {
    let lines = columns.iter().map(|column| {
        let unit = match Units::SI.name(column.unit) {
            "" => "-",
            unit => unit,
        };
        let name = format!("  {}", column.name);
        vec![name, unit.to_owned(), column.meaning.to_owned()]
    });
    let lines: Vec<Vec<String>> = lines.collect();
    format!(
        "\n\nColumns of {file}:\n{}",
        aligned(&lines, |_| true).trim_end()
    )
}
