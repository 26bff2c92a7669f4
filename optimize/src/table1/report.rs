//! The table as data.

use anyhow::Context;
use serde::Serialize;
use softstop::transitions::{Cause, Rules, Transition};

use super::matching::{Match, find};
use super::paper::PaperRow;
use super::swept::{self, Sweep};
use crate::failure::Failure;

/// The table.
#[derive(Debug, Serialize)]
pub struct TableReport {
    /// Its rows, in the paper's order.
    pub rows: Vec<RowReport>,
}

/// One row. Of a row that was not found only the number, the paper's figure and the remark are there.
#[derive(Debug, Serialize)]
pub struct RowReport {
    /// The paper's number.
    pub number: usize,
    /// The paper's frequency ratio.
    pub paper: f64,
    /// Ours.
    pub eta: Option<f64>,
    /// What it is, in the paper's symbols.
    #[serde(rename = "type")]
    pub kind: Option<String>,
    /// True if going back does not lead to the first motion again.
    pub hysteresis: Option<bool>,
    /// What ends.
    pub from: Option<String>,
    /// What follows, everything on the way named.
    pub to: Option<String>,
    /// How the figure was found, and why it differs.
    pub remark: String,
}

/// Difference from the paper's figure that its digits explain.
const ROUNDING: f64 = 1e-5;

impl TableReport {
    /// The rows of the paper that are among some transitions.
    #[must_use]
    pub fn new(rows: &[PaperRow], transitions: &[Transition], rules: &Rules) -> Self {
        let report = |row: &PaperRow| match find(row, transitions) {
            Some(found) => RowReport::new(row, &found, rules),
            None => RowReport::missing(row),
        };
        Self {
            rows: rows.iter().map(report).collect(),
        }
    }

    /// As comma-separated values.
    ///
    /// # Errors
    /// [`Failure::Run`] if they cannot be written.
    pub fn csv(&self) -> Result<String, Failure> {
        let mut table = csv::Writer::from_writer(Vec::new());
        for row in &self.rows {
            table.serialize(row).context("cannot write the table")?;
        }
        let bytes = table.into_inner().context("cannot write the table")?;
        Ok(String::from_utf8(bytes).context("cannot write the table")?)
    }
}

impl RowReport {
    fn new(row: &PaperRow, found: &Match<'_>, rules: &Rules) -> Self {
        let transition = found.transition;
        let names: Vec<String> = std::iter::once(&transition.from)
            .chain(&transition.path)
            .map(ToString::to_string)
            .collect();
        let (from, to) = if found.is_reversed {
            (transition.to().to_string(), transition.from.to_string())
        } else {
            (names[0].clone(), names[1..].join(" -> "))
        };
        Self {
            number: row.number,
            paper: row.eta,
            eta: Some(found.eta),
            kind: Some(transition.symbols()),
            hysteresis: Some(transition.hysteresis),
            from: Some(from),
            to: Some(to),
            remark: remark(row, found, rules),
        }
    }

    fn missing(row: &PaperRow) -> Self {
        Self {
            number: row.number,
            paper: row.eta,
            eta: None,
            kind: None,
            hysteresis: None,
            from: None,
            to: None,
            remark:
                "not found: no transition between these motions was met near the paper's figure"
                    .to_owned(),
        }
    }
}

fn remark(row: &PaperRow, found: &Match<'_>, rules: &Rules) -> String {
    let transition = found.transition;
    let mut parts = Vec::new();
    match transition.causes[..] {
        [Cause::OutOfChaos] => parts.push(format!(
            "chaos is transient near its end: here half of {} motions on it settle within {} drive periods",
            rules.motions, rules.lifetime
        )),
        _ => parts.push(format!(
            "the stable branch ends at {:.10}, located to 1e-10",
            transition.value
        )),
    }
    if let Some(until) = transition.doubled_until {
        parts.push(format!(
            "the last motion doubled from it ends at {until:.10}"
        ));
    }
    if let Some(settled) = transition.settled_at {
        parts.push(format!("the last motion follows from {settled:.10} on"));
    }
    if transition.causes.first() == Some(&Cause::Fold)
        && let Some(lost) = swept::lost_at(transition.value, Sweep::PAPER)
    {
        parts.push(format!(
            "a sweep up by {} per {} drive periods loses it at {lost:.3} only",
            Sweep::PAPER.step,
            Sweep::PAPER.periods
        ));
    }
    let gap = found.eta - row.eta;
    if gap.abs() > ROUNDING {
        parts.push(format!("{gap:+.1e} from the paper"));
    }
    parts.join("; ")
}
