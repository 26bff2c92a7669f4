//! What came of a study: the manifest beside its table.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use softstop::Machine;
use softstop_console::arguments::title;
use softstop_console::budget::Budget;
use softstop_console::column::{Unit, Units};
use softstop_console::export::Report;
use softstop_console::number::NumberStyle::Seven;
use softstop_console::report::MachineReport;
use softstop_console::table::aligned;
use softstop_console::units;
use softstop_dynamics::settled::Settling;

use super::file::{Certainty, Study};
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
    pub fn numbers(&mut self, numbers: &[f64]) {
        self.values += numbers.iter().filter(|it| !it.is_nan()).count() as u64;
        self.over_budget += numbers.iter().filter(|it| is_over_budget(**it)).count() as u64;
        for &number in numbers.iter().filter(|it| it.is_finite()) {
            self.least = Some(self.least.map_or(number, |it| it.min(number)));
            self.greatest = Some(self.greatest.map_or(number, |it| it.max(number)));
        }
    }

    pub fn word(&mut self, word: &str, count: u64) {
        if word == OVER_BUDGET {
            self.over_budget += count;
        }
        self.values += count;
        *self.words.entry(word.to_owned()).or_default() += count;
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
    machine: MachineReport,
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
    #[serde(skip)]
    title: String,
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
            name: output.name().to_owned(),
            unit: unit(machine, output.unit()).to_owned(),
            meaning: output.meaning().to_owned(),
            summary,
        });
        Self {
            version: env!("CARGO_PKG_VERSION"),
            study: study.hash.clone(),
            machine: MachineReport::of(machine),
            start: [machine.start.position, machine.start.velocity],
            points: study.points,
            axes: axes.collect(),
            samples: study.samples,
            seed: study.seed,
            motion: study.settling,
            certainty: study.certainty,
            budget: study.budget,
            columns: columns.collect(),
            title: title(machine),
        }
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

impl Report for StudyReport {
    fn text(&self) -> String {
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
            self.title,
            self.points,
            aligned(&rows, |column| column == 0),
            over.unwrap_or_default()
        )
    }
}
