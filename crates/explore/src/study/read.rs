//! Results of a study, read from Parquet.

use std::path::Path;
use std::sync::Arc;

use anyhow::{Context, Error, bail};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::{ByteArray, DataType};
use parquet::file::reader::{FileReader, SerializedFileReader};
use softstop_console::scene_file;

use super::column::StudyColumn;

/// Reads columns row group by row group: the first point of each, and the columns in this order.
///
/// # Errors
/// If the file cannot be read, or lacks a column.
pub(super) fn read(
    path: &Path,
    names: &[&str],
    mut visit: impl FnMut(u64, &[StudyColumn]),
) -> Result<(), Error> {
    let reader = SerializedFileReader::new(scene_file::open(path)?)?;
    let schema = reader.metadata().file_metadata().schema_descr();
    let place = |name: &&str| {
        let place = schema.columns().iter().position(|it| it.name() == *name);
        place.with_context(|| format!("it has no column {name}"))
    };
    let places = names.iter().map(place).collect::<Result<Vec<_>, _>>()?;
    let mut first = 0;
    for number in 0..reader.num_row_groups() {
        let group = reader.get_row_group(number)?;
        let rows = group.metadata().num_rows() as usize;
        let columns = places
            .iter()
            .map(|place| column(group.get_column_reader(*place)?, rows));
        visit(first, &columns.collect::<Result<Vec<_>, Error>>()?);
        first += rows as u64;
    }
    Ok(())
}

fn column(reader: ColumnReader, rows: usize) -> Result<StudyColumn, Error> {
    Ok(match reader {
        ColumnReader::DoubleColumnReader(reader) => {
            let numbers = values(reader, rows)?.map(|it| it.unwrap_or(f64::NAN));
            StudyColumn::Numbers(numbers.collect())
        }
        ColumnReader::ByteArrayColumnReader(reader) => {
            let word = |it: ByteArray| Arc::from(&*String::from_utf8_lossy(it.data()));
            StudyColumn::Words(values(reader, rows)?.map(|it| it.map(word)).collect(), 0)
        }
        _ => bail!("it was not written by softstop"),
    })
}

/// The values of a column, none where there is nothing.
fn values<T: DataType>(
    mut reader: ColumnReaderImpl<T>,
    rows: usize,
) -> Result<impl Iterator<Item = Option<T::T>>, Error> {
    let (mut levels, mut there) = (Vec::with_capacity(rows), Vec::with_capacity(rows));
    reader.read_records(rows, Some(&mut levels), None, &mut there)?;
    if levels.is_empty() {
        // A column that is never empty has no levels.
        levels.resize(there.len(), 1);
    }
    let mut there = there.into_iter();
    let value = move |level| if level == 0 { None } else { there.next() };
    Ok(levels.into_iter().map(value))
}
