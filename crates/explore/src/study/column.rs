//! The columns of a row group: values of the axes, and outputs from their blocks.

use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

use softstop_console::cell::Cell;
use softstop_console::failure::Failure;

use super::blocks::Blocks;
use super::file::Study;
use super::outputs::{StudyOutput, is_over_budget};

/// Words by the bits of the numbers that they stand for.
type KnownWords = HashMap<[u64; 2], Option<Arc<str>>>;

/// A column.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum StudyColumn {
    /// Numbers, not a number where there is nothing.
    Numbers(Vec<f64>),
    /// Words, and how many rows have none since they are over the budget.
    Words(Vec<Option<Arc<str>>>, u64),
}

impl StudyColumn {
    /// How many rows it has.
    pub fn len(&self) -> usize {
        match self {
            Self::Numbers(numbers) => numbers.len(),
            Self::Words(words, _) => words.len(),
        }
    }

    /// The number of a row; not a number if there is none.
    pub fn number(&self, row: usize) -> f64 {
        match self {
            Self::Numbers(numbers) => numbers[row],
            Self::Words(..) => f64::NAN,
        }
    }

    /// The word of a row, if it has one.
    pub fn word(&self, row: usize) -> Option<&str> {
        match self {
            Self::Numbers(_) => None,
            Self::Words(words, _) => words[row].as_deref(),
        }
    }

    /// For CSV.
    pub fn cell(&self, row: usize) -> Cell {
        match self {
            Self::Numbers(numbers) => Some(numbers[row]).filter(|it| !it.is_nan()).into(),
            Self::Words(words, _) => words[row].as_deref().into(),
        }
    }

    /// Adds an output of so many points from its numbers in a block; equal words are one.
    fn extend(
        &mut self,
        output: StudyOutput,
        numbers: &[f64],
        points: usize,
        known: &mut KnownWords,
    ) {
        match self {
            Self::Numbers(all) => all.extend(numbers),
            Self::Words(words, over_budget) => {
                let second = |point| numbers.get(points + point).copied().unwrap_or(f64::NAN);
                for (point, first) in numbers.iter().take(points).enumerate() {
                    *over_budget += u64::from(is_over_budget(*first));
                    let numbers = [*first, second(point)];
                    let word = known.entry(numbers.map(f64::to_bits));
                    let word = word.or_insert_with(|| output.word(numbers).map(Into::into));
                    words.push(word.clone());
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
) -> Result<Vec<StudyColumn>, Failure> {
    let points = study.block(group.start).start..study.block(group.end - 1).end;
    let mut columns = coordinates(study, points);
    columns.extend(outputs(study, blocks, group)?);
    Ok(columns)
}

/// The values of the axes.
fn coordinates(study: &Study, points: Range<u64>) -> Vec<StudyColumn> {
    let length = (points.end - points.start) as usize;
    let mut columns = vec![Vec::with_capacity(length); study.axes.len()];
    for point in points {
        study.each_value(point, |axis, value| columns[axis].push(value));
    }
    columns.into_iter().map(StudyColumn::Numbers).collect()
}

/// The outputs.
fn outputs(
    study: &Study,
    blocks: &mut Blocks,
    group: Range<u64>,
) -> Result<Vec<StudyColumn>, Failure> {
    let empty = |output: &StudyOutput| match output.is_word() {
        true => StudyColumn::Words(Vec::new(), 0),
        false => StudyColumn::Numbers(Vec::new()),
    };
    let mut columns: Vec<StudyColumn> = study.outputs.iter().map(empty).collect();
    let mut known = vec![KnownWords::new(); columns.len()];
    for block in group {
        let numbers = blocks.read(block)?;
        let points = numbers.len() / study.width();
        let mut rest = numbers.as_slice();
        for ((output, column), known) in study.outputs.iter().zip(&mut columns).zip(&mut known) {
            let (own, after) = rest.split_at(points * output.width());
            column.extend(*output, own, points, known);
            rest = after;
        }
    }
    Ok(columns)
}
