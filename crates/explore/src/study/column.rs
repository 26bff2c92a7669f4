//! The columns of a row group: values of the axes, and outputs from their blocks.

use std::collections::HashMap;
use std::ops::Range;

use softstop_console::cell::Cell;
use softstop_console::failure::Failure;

use super::blocks::Blocks;
use super::file::Study;
use super::outputs::{Output, is_over_budget};

/// A column.
pub(super) enum Column {
    /// Numbers, not a number where there is nothing.
    Numbers(Vec<f64>),
    Words(Words),
}

/// A column of few different words.
#[derive(Default)]
pub(super) struct Words {
    /// Those that there are.
    pub all: Vec<String>,
    /// Of each row, by its place among them.
    pub places: Vec<Option<usize>>,
    /// Rows without one since they are over the budget.
    pub over_budget: u64,
    known: HashMap<[u64; 2], Option<usize>>,
}

impl Words {
    /// Adds the word of these numbers.
    fn push(&mut self, output: Output, numbers: [f64; 2]) {
        self.over_budget += u64::from(is_over_budget(numbers[0]));
        let all = &mut self.all;
        let place = *self
            .known
            .entry(numbers.map(f64::to_bits))
            .or_insert_with(|| {
                let word = output.word(numbers)?;
                let place = all.iter().position(|it| *it == word);
                Some(place.unwrap_or_else(|| {
                    all.push(word);
                    all.len() - 1
                }))
            });
        self.places.push(place);
    }

    /// How often each stands there.
    pub fn counts(&self) -> impl Iterator<Item = (&str, u64)> {
        let mut counts = vec![0; self.all.len()];
        for place in self.places.iter().flatten() {
            counts[*place] += 1;
        }
        self.all.iter().map(String::as_str).zip(counts)
    }
}

impl Column {
    /// How many rows it has.
    pub fn len(&self) -> usize {
        match self {
            Self::Numbers(numbers) => numbers.len(),
            Self::Words(words) => words.places.len(),
        }
    }

    /// For CSV.
    pub fn cell(&self, row: usize) -> Cell {
        match self {
            Self::Numbers(numbers) => Some(numbers[row]).filter(|it| !it.is_nan()).into(),
            Self::Words(words) => words.places[row].map(|it| words.all[it].clone()).into(),
        }
    }

    /// Adds an output of so many points from its numbers in a block.
    fn extend(&mut self, output: Output, numbers: &[f64], points: usize) {
        match self {
            Self::Numbers(all) => all.extend(numbers),
            Self::Words(words) => {
                let second = |point| numbers.get(points + point).copied().unwrap_or(f64::NAN);
                for (point, first) in numbers.iter().take(points).enumerate() {
                    words.push(output, [*first, second(point)]);
                }
            }
        }
    }
}

/// All columns of some blocks: the axes, then the outputs.
///
/// # Errors
/// [`Failure::Run`] if a block cannot be read.
pub(super) fn group(
    study: &Study,
    blocks: &mut Blocks,
    group: Range<u64>,
) -> Result<Vec<Column>, Failure> {
    let points = study.block(group.start).start..study.block(group.end - 1).end;
    let mut columns = coordinates(study, points);
    columns.extend(outputs(study, blocks, group)?);
    Ok(columns)
}

/// The values of the axes.
fn coordinates(study: &Study, points: Range<u64>) -> Vec<Column> {
    let length = (points.end - points.start) as usize;
    let mut columns = vec![Vec::with_capacity(length); study.axes.len()];
    for point in points {
        study.each_value(point, |axis, value| columns[axis].push(value));
    }
    columns.into_iter().map(Column::Numbers).collect()
}

/// The outputs.
fn outputs(study: &Study, blocks: &mut Blocks, group: Range<u64>) -> Result<Vec<Column>, Failure> {
    let empty = |output: &Output| match output.is_word() {
        true => Column::Words(Words::default()),
        false => Column::Numbers(Vec::new()),
    };
    let mut columns: Vec<Column> = study.outputs.iter().map(empty).collect();
    for block in group {
        let numbers = blocks.read(block)?;
        let points = numbers.len() / study.width();
        let mut rest = numbers.as_slice();
        for (output, column) in study.outputs.iter().zip(&mut columns) {
            let (own, after) = rest.split_at(points * output.width());
            column.extend(*output, own, points);
            rest = after;
        }
    }
    Ok(columns)
}
