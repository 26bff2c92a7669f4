//! Tables whose columns are known only once they are made.

use crate::cell::Cell;
use crate::record::Record;

/// A table: the name of its file, the heads of its columns, and rows of cells.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sheet {
    /// Name of its file, without ending.
    pub name: String,
    /// A head for each column.
    pub heads: Vec<String>,
    /// A cell for each column.
    pub rows: Vec<Vec<Cell>>,
}

/// A row of a [`Sheet`] from values of different types.
#[macro_export]
macro_rules! row {
    ($($cell:expr),* $(,)?) => { vec![$($crate::column::Cell::from($cell)),*] };
}

impl Sheet {
    /// A table of these heads and rows.
    pub fn new<T: Into<String>>(
        name: impl Into<String>,
        heads: impl IntoIterator<Item = T>,
        rows: impl IntoIterator<Item = Vec<Cell>>,
    ) -> Self {
        Self {
            name: name.into(),
            heads: heads.into_iter().map(Into::into).collect(),
            rows: rows.into_iter().collect(),
        }
    }

    /// Records below one another, under the names of the first one's figures.
    pub fn of_records(name: &str, records: &[Record]) -> Self {
        let heads = records.iter().take(1).flat_map(|record| &record.0);
        let row = |record: &Record| record.0.iter().map(|it| it.cell.clone()).collect();
        Self::new(name, heads.map(|it| it.name), records.iter().map(row))
    }
}
