//! The results of a study as Parquet and CSV, written row group by row group.

use std::fs::File;
use std::sync::Arc;

use anyhow::{Context, Error};
use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use softstop_console::cell::Cell;
use softstop_console::failure::Failure;
use softstop_console::output::Staged;
use softstop_console::progress::Progress;

use super::blocks::Blocks;
use super::file::Study;
use super::report::Summary;

/// Blocks of a row group.
const GROUP: u64 = 128;

/// A column of a row group.
enum Column {
    Numbers(Vec<f64>),
    Words(Vec<Option<String>>),
}

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
    for first in (0..study.blocks()).step_by(GROUP as usize) {
        let group = first..(first + GROUP).min(study.blocks());
        let mut columns = coordinates(
            study,
            study.block(first).start,
            study.block(group.end - 1).end,
        );
        let outputs = outputs(study, blocks, group)?;
        for (summary, column) in summaries.iter_mut().zip(&outputs) {
            match column {
                Column::Numbers(numbers) => summary.numbers(numbers),
                Column::Words(words) => summary.words(words),
            }
        }
        columns.extend(outputs);
        add(&mut parquet, &columns).context("study.parquet")?;
        if let Some(csv) = &mut csv {
            rows(csv, &columns)?;
        }
        progress.steps(columns[0].len() as u64)?;
    }
    let file = parquet.into_inner().context("study.parquet")?;
    file.sync_all().context("study.parquet")?;
    if let Some(csv) = csv {
        csv.close()?;
    }
    Ok(summaries)
}

/// The names of all columns: axes and outputs.
pub(super) fn names(study: &Study) -> impl Iterator<Item = &str> {
    let axes = study.axes.iter().map(|axis| axis.name.as_str());
    axes.chain(study.outputs.iter().map(|output| output.name()))
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
    let words = study.outputs.iter().filter(|output| output.is_word());
    let properties = WriterProperties::builder()
        .set_created_by(concat!("softstop ", env!("CARGO_PKG_VERSION")).to_owned())
        .set_statistics_enabled(EnabledStatistics::None)
        .set_offset_index_disabled(true)
        .set_dictionary_enabled(false);
    let properties = words.fold(properties, |properties, output| {
        properties.set_column_dictionary_enabled(output.name().into(), true)
    });
    let properties = Arc::new(properties.build());
    Ok(SerializedFileWriter::new(
        file,
        Arc::new(schema),
        properties,
    )?)
}

/// The values of the axes from one point to another.
fn coordinates(study: &Study, from: u64, to: u64) -> Vec<Column> {
    let mut columns = vec![Vec::with_capacity((to - from) as usize); study.axes.len()];
    for point in from..to {
        for (column, value) in columns.iter_mut().zip(study.values(point)) {
            column.push(value);
        }
    }
    columns.into_iter().map(Column::Numbers).collect()
}

/// The outputs of some blocks.
fn outputs(
    study: &Study,
    blocks: &mut Blocks,
    group: std::ops::Range<u64>,
) -> Result<Vec<Column>, Failure> {
    let mut columns: Vec<Column> = study
        .outputs
        .iter()
        .map(|output| match output.is_word() {
            true => Column::Words(Vec::new()),
            false => Column::Numbers(Vec::new()),
        })
        .collect();
    for block in group {
        let numbers = blocks.read(block)?;
        let points = numbers.len() / study.width();
        let mut rest = numbers.as_slice();
        for (output, column) in study.outputs.iter().zip(&mut columns) {
            let (own, after) = rest.split_at(points * output.width());
            rest = after;
            match column {
                Column::Numbers(numbers) => numbers.extend(own),
                Column::Words(words) => {
                    let second = |point| own.get(points + point).copied().unwrap_or(f64::NAN);
                    words.extend((0..points).map(|point| output.word([own[point], second(point)])));
                }
            }
        }
    }
    Ok(columns)
}

impl Column {
    fn len(&self) -> usize {
        match self {
            Self::Numbers(numbers) => numbers.len(),
            Self::Words(words) => words.len(),
        }
    }

    /// For CSV.
    fn cell(&self, row: usize) -> Cell {
        match self {
            Self::Numbers(numbers) => Some(numbers[row]).filter(|it| !it.is_nan()).into(),
            Self::Words(words) => words[row].clone().into(),
        }
    }
}

/// Adds a row group.
fn add(parquet: &mut SerializedFileWriter<File>, columns: &[Column]) -> Result<(), Error> {
    let mut group = parquet.next_row_group()?;
    for column in columns {
        let mut writer = group.next_column()?.context("too few columns")?;
        match column {
            Column::Numbers(numbers) => {
                let there: Vec<f64> = numbers.iter().copied().filter(|it| !it.is_nan()).collect();
                let levels: Vec<i16> = numbers.iter().map(|it| i16::from(!it.is_nan())).collect();
                let typed = writer.typed::<DoubleType>();
                typed.write_batch(&there, Some(&levels), None)?;
            }
            Column::Words(words) => {
                let there = words.iter().flatten();
                let there: Vec<ByteArray> = there.map(|it| it.as_str().into()).collect();
                let levels: Vec<i16> = words.iter().map(|it| i16::from(it.is_some())).collect();
                let typed = writer.typed::<ByteArrayType>();
                typed.write_batch(&there, Some(&levels), None)?;
            }
        }
        writer.close()?;
    }
    group.close()?;
    Ok(())
}

fn rows(csv: &mut Staged, columns: &[Column]) -> Result<(), Failure> {
    for row in 0..columns[0].len() {
        csv.row(columns.iter().map(|column| column.cell(row)))?;
    }
    Ok(())
}
