//! What came of a study: the manifest beside its table.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use softstop::Machine;
use softstop_console::arguments::title;
use softstop_console::budget::Budget;
use softstop_console::column::{Unit, Units};
use softstop_console::number::NumberStyle::Seven;
use softstop_console::record::Record;
use softstop_console::report::stated_machine;
use softstop_console::table::aligned;
use softstop_console::units;
use softstop_dynamics::settled::Settling;

use super::certainty::Certainty;
use super::column::StudyColumn;
use super::file::Study;
use super::outputs::{OVER_BUDGET, is_over_budget};
use super::values::Values;

/// What a column of outputs holds.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Summary {
    /// Points that have it.
    pub values: u64,
    /// Least and greatest finite number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub least: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub greatest: Option<f64>,
    /// Points that lack it since they are over the budget.
    #[serde(skip_serializing_if = "is_none", default)]
    pub over_budget: u64,
    /// How often each word stands there.
    #[serde(skip_serializing_if = "BTreeMap::is_empty", default)]
    pub words: BTreeMap<String, u64>,
}

fn is_none(count: &u64) -> bool {
    *count == 0
}

impl Summary {
    /// Adds what a column holds.
    pub fn add(&mut self, column: &StudyColumn) {
        match column {
            StudyColumn::Numbers(numbers) => numbers.iter().for_each(|it| self.add_number(*it)),
            StudyColumn::Words(words, over_budget) => {
                self.over_budget += over_budget;
                words.iter().flatten().for_each(|it| self.add_word(it));
            }
        }
    }

    fn add_number(&mut self, number: f64) {
        self.values += u64::from(!number.is_nan());
        self.over_budget += u64::from(is_over_budget(number));
        if number.is_finite() {
            self.least = Some(self.least.map_or(number, |it| it.min(number)));
            self.greatest = Some(self.greatest.map_or(number, |it| it.max(number)));
        }
    }

    fn add_word(&mut self, word: &str) {
        self.values += 1;
        self.over_budget += u64::from(word == OVER_BUDGET);
        match self.words.get_mut(word) {
            Some(count) => *count += 1,
            None => _ = self.words.insert(word.to_owned(), 1),
        }
    }
}

/// An axis.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct AxisReport {
    /// The key of the machine's file, and the name of its column.
    pub parameter: String,
    pub unit: String,
    /// As pictures have it.
    pub label: String,
    #[serde(flatten)]
    pub values: Values,
}

/// A column of outputs.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct ColumnReport {
    pub name: String,
    pub unit: String,
    pub meaning: String,
    #[serde(flatten)]
    pub summary: Summary,
}

/// The manifest.
#[derive(Debug, Serialize)]
pub(super) struct StudyReport {
    version: &'static str,
    /// What studies that come to the same have in common.
    study: String,
    machine: Record,
    /// Where its motions start, unless an axis says so.
    start: [f64; 2],
    points: u64,
    /// The axes, the slowest first; samples change fastest.
    axes: Vec<AxisReport>,
    samples: Option<u64>,
    seed: u32,
    motion: Settling,
    certainty: Certainty,
    /// Millions of scan windows that a point may cost.
    budget: Budget,
    columns: Vec<ColumnReport>,
}

/// What pictures need of a manifest.
#[derive(Debug, Deserialize)]
pub(super) struct Manifest {
    pub points: u64,
    pub axes: Vec<AxisReport>,
    pub samples: Option<u64>,
    pub columns: Vec<ColumnReport>,
}

impl StudyReport {
    pub fn new(study: &Study, summaries: Vec<Summary>) -> Self {
        let machine = &study.machine;
        let axes = study.axes.iter().map(|axis| {
            let (unit, label) = axis.told(machine);
            AxisReport {
                parameter: axis.name.clone(),
                unit: unit.to_owned(),
                label,
                values: axis.values.clone(),
            }
        });
        let columns = study.outputs.iter().zip(summaries);
        let columns = columns.map(|(output, summary)| ColumnReport {
            name: output.name.to_owned(),
            unit: unit(machine, output.unit).to_owned(),
            meaning: output.meaning.to_owned(),
            summary,
        });
        Self {
            version: env!("CARGO_PKG_VERSION"),
            study: study.hash.clone(),
            machine: stated_machine(machine),
            start: [machine.start.position, machine.start.velocity],
            points: study.points,
            axes: axes.collect(),
            samples: study.samples,
            seed: study.seed,
            motion: study.settling,
            certainty: study.certainty,
            budget: study.budget,
            columns: columns.collect(),
        }
    }

    /// What people read.
    pub fn text(&self, study: &Study) -> String {
        let mut rows = vec![
            ["output", "points", "least", "greatest"]
                .map(str::to_owned)
                .to_vec(),
        ];
        for column in &self.columns {
            let Summary {
                values,
                least,
                greatest,
                words,
                ..
            } = &column.summary;
            let number = |it: &Option<f64>| it.map_or("-".to_owned(), |it| Seven.format(it));
            let mut row = vec![
                column.name.clone(),
                values.to_string(),
                number(least),
                number(greatest),
            ];
            if !words.is_empty() {
                let mut words: Vec<_> = words.iter().collect();
                words.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
                let told = words
                    .iter()
                    .take(TOLD)
                    .map(|(word, count)| format!("{word}: {count}"));
                let more = if words.len() > TOLD { ", ..." } else { "" };
                row.truncate(2);
                row.push(told.collect::<Vec<_>>().join(", ") + more);
            }
            rows.push(row);
        }
        let over = self.columns.iter().map(|column| column.summary.over_budget);
        let over = over
            .max()
            .filter(|count| *count > 0)
            .map(|count| format!("\n{count} points {}\n", self.budget.refusal()));
        format!(
            "{}: {} points\n\n{}{}",
            title(&study.machine),
            self.points,
            aligned(&rows, |column| column == 0),
            over.unwrap_or_default()
        )
    }
}

/// A unit by its name in JSON.
pub(super) fn unit(machine: &Machine, unit: Unit) -> &'static str {
    match unit {
        Unit::Own(dimension) => units::name(machine, dimension),
        other => Units::of(machine).name(other),
    }
}

/// Words that people are told of a column.
const TOLD: usize = 6;
