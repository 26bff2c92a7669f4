//! Results of a study, read from Parquet.

use std::path::Path;
use std::sync::Arc;

use anyhow::{Context, Error, bail};
use parquet::column::reader::ColumnReader;
use parquet::file::reader::{FileReader, SerializedFileReader};
use softstop_console::scene_file;

use super::column::Column;

/// Reads columns row group by row group: the first point of each, and the columns in this order.
///
/// # Errors
/// If the file cannot be read, or lacks a column.
pub(super) fn read(
    path: &Path,
    names: &[&str],
    mut visit: impl FnMut(u64, &[Column]),
) -> Result<(), Error> {
    let reader = SerializedFileReader::new(scene_file::open(path)?)?;
    let schema = reader.metadata().file_metadata().schema_descr();
    let column = |name: &&str| {
        let place = schema.columns().iter().position(|it| it.name() == *name);
        place.with_context(|| format!("it has no column {name}"))
    };
    let places = names.iter().map(column).collect::<Result<Vec<_>, _>>()?;
    let mut first = 0;
    for number in 0..reader.num_row_groups() {
        let group = reader.get_row_group(number)?;
        let rows = group.metadata().num_rows() as usize;
        let columns = places
            .iter()
            .map(|place| values(group.get_column_reader(*place)?, rows));
        visit(first, &columns.collect::<Result<Vec<_>, Error>>()?);
        first += rows as u64;
    }
    Ok(())
}

fn values(reader: ColumnReader, rows: usize) -> Result<Column, Error> {
    let mut levels = Vec::with_capacity(rows);
    Ok(match reader {
        ColumnReader::DoubleColumnReader(mut reader) => {
            let mut there = Vec::with_capacity(rows);
            reader.read_records(rows, Some(&mut levels), None, &mut there)?;
            if levels.is_empty() {
                return Ok(Column::Numbers(there));
            }
            let mut there = there.into_iter();
            let all = levels.iter().map(|level| match level {
                0 => Some(f64::NAN),
                _ => there.next(),
            });
            Column::Numbers(all.map(|it| it.unwrap_or(f64::NAN)).collect())
        }
        ColumnReader::ByteArrayColumnReader(mut reader) => {
            let mut there = Vec::with_capacity(rows);
            reader.read_records(rows, Some(&mut levels), None, &mut there)?;
            let mut there = there.into_iter();
            let all = levels.iter().map(|level| match level {
                0 => None,
                _ => Some(Arc::from(&*String::from_utf8_lossy(there.next()?.data()))),
            });
            Column::Words(all.collect(), 0)
        }
        _ => bail!("it was not written by softstop"),
    })
}
