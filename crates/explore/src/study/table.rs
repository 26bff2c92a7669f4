//! The results of a study as Parquet and CSV, written row group by row group.

use std::collections::HashMap;
use std::fs::File;
use std::sync::Arc;

use anyhow::{Context, Error};
use parquet::basic::{Compression, Encoding, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use serde_json::{Value, json};
use softstop_console::failure::Failure;
use softstop_console::output::Staged;
use softstop_console::progress::Progress;

use super::blocks::Blocks;
use super::column::{self, StudyColumn};
use super::file::Study;
use super::report::{Summary, unit};

/// Blocks of a row group.
const GROUP: u64 = 128;

/// Writes all blocks in order, and sums up what they hold.
///
/// # Errors
/// [`Failure::Run`] if a block cannot be read, or a file cannot be written; [`Failure::Interrupted`].
pub(super) fn write(
    study: &Study,
    blocks: &mut Blocks,
    parquet: File,
    mut csv: Option<Staged>,
) -> Result<Vec<Summary>, Failure> {
    let mut summaries: Vec<Summary> = study.outputs.iter().map(|_| Summary::default()).collect();
    let mut parquet = open(study, parquet).context("study.parquet")?;
    if let Some(csv) = &mut csv {
        csv.row(names(study))?;
    }
    let progress = Progress::new(study.points, "points put in place");
    let mut firsts = (0..study.blocks()).step_by(GROUP as usize);
    let mut group = |blocks: &mut Blocks| {
        let first = firsts.next()?;
        let group = first..(first + GROUP).min(study.blocks());
        Some(column::group(study, blocks, group))
    };
    let mut next = group(blocks).transpose()?;
    while let Some(columns) = next {
        let (read, written) = rayon::join(
            || group(blocks).transpose(),
            || put(&columns, &mut summaries, &mut parquet, csv.as_mut()),
        );
        written?;
        progress.steps(columns[0].len() as u64)?;
        next = read?;
    }
    let file = parquet.into_inner().context("study.parquet")?;
    file.sync_all().context("study.parquet")?;
    if let Some(csv) = csv {
        csv.close()?;
    }
    Ok(summaries)
}

/// Puts a row group into the files.
fn put(
    columns: &[StudyColumn],
    summaries: &mut [Summary],
    parquet: &mut SerializedFileWriter<File>,
    csv: Option<&mut Staged>,
) -> Result<(), Failure> {
    let outputs = &columns[columns.len() - summaries.len()..];
    for (summary, column) in summaries.iter_mut().zip(outputs) {
        summary.add(column);
    }
    add(parquet, columns).context("study.parquet")?;
    match csv {
        Some(csv) => rows(csv, columns),
        None => Ok(()),
    }
}

/// The names of all columns: axes and outputs.
pub(super) fn names(study: &Study) -> impl Iterator<Item = &str> {
    let axes = study.axes.iter().map(|axis| axis.name.as_str());
    axes.chain(study.outputs.iter().map(|output| output.name))
}

fn open(study: &Study, file: File) -> Result<SerializedFileWriter<File>, Error> {
    let axes = study.axes.len();
    let field = |(number, name): (usize, &str)| {
        let is_axis = number < axes;
        let is_word = !is_axis && study.outputs[number - axes].is_word();
        let (physical, logical) = match is_word {
            true => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
            false => (Physical::DOUBLE, None),
        };
        let repetition = match is_axis {
            true => Repetition::REQUIRED,
            false => Repetition::OPTIONAL,
        };
        let field = Type::primitive_type_builder(name, physical);
        let field = field.with_repetition(repetition).with_logical_type(logical);
        Ok(Arc::new(field.build()?))
    };
    let fields = names(study).enumerate().map(field);
    let fields = fields.collect::<Result<Vec<_>, Error>>()?;
    let schema = Type::group_type_builder("study")
        .with_fields(fields)
        .build()?;
    Ok(SerializedFileWriter::new(
        file,
        Arc::new(schema),
        Arc::new(properties(study)?),
    )?)
}

/// How columns are written: words and the values of grids by dictionaries, other numbers byte by byte, first all
/// first bytes; least and greatest of each row group; compressed.
fn properties(study: &Study) -> Result<WriterProperties, Error> {
    let properties = WriterProperties::builder()
        .set_created_by(concat!("softstop ", env!("CARGO_PKG_VERSION")).to_owned())
        .set_key_value_metadata(Some(told(study)?))
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_offset_index_disabled(true)
        .set_compression(Compression::SNAPPY)
        .set_encoding(Encoding::BYTE_STREAM_SPLIT)
        .set_dictionary_enabled(false);
    let words = study.outputs.iter().filter(|output| output.is_word());
    let grids = study.axes.iter().filter(|axis| axis.draw().is_none());
    let properties = words.fold(properties, |properties, output| {
        let properties = properties.set_column_dictionary_enabled(output.name.into(), true);
        properties.set_column_encoding(output.name.into(), Encoding::PLAIN)
    });
    let properties = grids.fold(properties, |properties, axis| {
        properties.set_column_dictionary_enabled(axis.name.as_str().into(), true)
    });
    Ok(properties.build())
}

/// What the file tells of itself: the study, and name, unit and meaning of each column as JSON.
fn told(study: &Study) -> Result<Vec<KeyValue>, Error> {
    let machine = &study.machine;
    let axes = study.axes.iter().map(|axis| {
        let (unit, label) = axis.told(machine);
        json!({ "name": axis.name, "unit": unit, "meaning": label })
    });
    let outputs = study.outputs.iter().map(
        |it| json!({ "name": it.name, "unit": unit(machine, it.unit), "meaning": it.meaning }),
    );
    let columns: Vec<Value> = axes.chain(outputs).collect();
    Ok(vec![
        KeyValue::new("study".to_owned(), study.hash.clone()),
        KeyValue::new("columns".to_owned(), serde_json::to_string(&columns)?),
    ])
}

/// Adds a row group.
fn add(parquet: &mut SerializedFileWriter<File>, columns: &[StudyColumn]) -> Result<(), Error> {
    let mut group = parquet.next_row_group()?;
    for column in columns {
        let mut writer = group.next_column()?.context("too few columns")?;
        match column {
            StudyColumn::Numbers(numbers) => {
                let there: Vec<f64> = numbers.iter().copied().filter(|it| !it.is_nan()).collect();
                let levels: Vec<i16> = numbers.iter().map(|it| i16::from(!it.is_nan())).collect();
                let typed = writer.typed::<DoubleType>();
                typed.write_batch(&there, Some(&levels), None)?;
            }
            StudyColumn::Words(words, _) => {
                let there = words.iter().flatten();
                let mut known: HashMap<&str, ByteArray> = HashMap::new();
                let there =
                    there.map(|it| known.entry(it).or_insert_with(|| (&**it).into()).clone());
                let there: Vec<ByteArray> = there.collect();
                let levels = words.iter().map(|it| i16::from(it.is_some()));
                let levels: Vec<i16> = levels.collect();
                let typed = writer.typed::<ByteArrayType>();
                typed.write_batch(&there, Some(&levels), None)?;
            }
        }
        writer.close()?;
    }
    group.close()?;
    Ok(())
}

fn rows(csv: &mut Staged, columns: &[StudyColumn]) -> Result<(), Failure> {
    for row in 0..columns[0].len() {
        csv.row(columns.iter().map(|column| column.cell(row)))?;
    }
    Ok(())
}
