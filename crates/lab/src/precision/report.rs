//! What is said of a measurement: plain data whose field names are the keys of the JSON and the columns of the
//! CSV.

use std::collections::BTreeMap;

use serde::Serialize;

use super::case::Case;
use super::errors::Scale;
use super::lead::{self, Lead};
use super::machine::Machine;
use super::measure::{Outcome, Row};
use super::truth::Truth;

/// All charts of a run.
#[derive(Debug, Clone, Serialize)]
pub struct PrecisionReport {
    /// Where times were taken.
    pub machine: Machine,
    /// One for each scene.
    pub charts: Vec<SceneReport>,
}

/// A scene's measurement.
#[derive(Debug, Clone, Serialize)]
pub struct SceneReport {
    /// The scene's name.
    pub scene: String,
    /// What is special about it.
    pub title: String,
    /// Drive periods.
    pub periods: f64,
    /// Where times were taken.
    pub machine: Machine,
    /// What errors are measured against.
    pub reference: ReferenceReport,
    /// What errors are divided by.
    pub scale: Scale,
    /// One for each setting of each method.
    pub rows: Vec<RowReport>,
    /// By how much the exact method leads.
    pub lead: LeadReport,
    /// The files written.
    pub files: BTreeMap<&'static str, String>,
}

/// What errors are measured against.
#[derive(Debug, Clone, Serialize)]
pub struct ReferenceReport {
    /// How it was found.
    pub method: &'static str,
    /// Decimal digits of the motion's size that two computations of it agree in, chaos included; the doubles
    /// below have 16 of them.
    pub digits: u32,
    /// Position in m and velocity in m/s at the end.
    pub end: (f64, f64),
    /// Impacts that are compared.
    pub impacts: usize,
    /// Impacts so slow are not compared, in m/s.
    pub slowest: f64,
}

/// How far ahead the exact method is.
#[derive(Debug, Clone, Serialize)]
pub struct LeadReport {
    /// How the figures come about.
    pub how: &'static str,
    /// One for each error and target.
    pub at: Vec<Lead>,
}

/// One run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RowReport {
    /// The method.
    pub method: String,
    /// Step in drive periods or tolerance.
    pub knob: Option<f64>,
    /// `done`, `failed` or `skipped`.
    pub status: &'static str,
    /// Why there is no answer.
    pub reason: Option<String>,
    /// Median time of a run, in s.
    pub seconds: Option<f64>,
    /// Runs that the median is of.
    pub runs: Option<usize>,
    /// Steps of a run.
    pub steps: Option<u64>,
    /// Evaluations of the law of force in a run.
    pub evaluations: Option<u64>,
    /// Error of the state at the end.
    pub end_error: Option<f64>,
    /// Largest error of the time of an impact, in drive periods.
    pub impact_time_error: Option<f64>,
    /// Largest error of a before-impact velocity.
    pub impact_velocity_error: Option<f64>,
    /// Impacts found.
    pub impacts: Option<usize>,
    /// Impacts found less those that are.
    pub impact_difference: Option<i64>,
}

impl SceneReport {
    /// What was measured on a case.
    #[must_use]
    pub fn new(case: &Case, machine: &Machine, truth: &Truth, scale: Scale, rows: &[Row]) -> Self {
        let exact = rows.first().map_or("", |row| row.method.as_str());
        Self {
            scene: case.name.clone(),
            title: case.title.clone(),
            periods: case.task.periods,
            machine: machine.clone(),
            reference: ReferenceReport {
                method: truth.method,
                digits: truth.digits(),
                end: truth.solution.end,
                impacts: scale.told(&truth.solution.impacts).len(),
                slowest: scale.slowest(),
            },
            scale,
            rows: rows.iter().map(RowReport::new).collect(),
            lead: LeadReport {
                how: lead::HOW,
                at: lead::leads(rows, exact),
            },
            files: BTreeMap::new(),
        }
    }
}

/// The columns of the CSV.
pub const COLUMNS: [&str; 13] = [
    "method",
    "knob",
    "status",
    "reason",
    "seconds",
    "runs",
    "steps",
    "evaluations",
    "end_error",
    "impact_time_error",
    "impact_velocity_error",
    "impacts",
    "impact_difference",
];

impl RowReport {
    /// The largest of the errors.
    #[must_use]
    pub fn worst_error(&self) -> Option<f64> {
        let errors = [
            self.end_error,
            self.impact_time_error,
            self.impact_velocity_error,
        ];
        errors.into_iter().flatten().reduce(f64::max)
    }

    fn new(row: &Row) -> Self {
        let empty = Self {
            method: row.method.clone(),
            knob: row.knob,
            status: "done",
            reason: None,
            seconds: None,
            runs: None,
            steps: None,
            evaluations: None,
            end_error: None,
            impact_time_error: None,
            impact_velocity_error: None,
            impacts: None,
            impact_difference: None,
        };
        match &row.outcome {
            Outcome::Failed(reason) => Self {
                status: "failed",
                reason: Some(reason.clone()),
                ..empty
            },
            Outcome::Skipped(reason) => Self {
                status: "skipped",
                reason: Some(reason.clone()),
                ..empty
            },
            Outcome::Done {
                seconds,
                runs,
                work,
                impacts,
                errors,
            } => Self {
                seconds: Some(*seconds),
                runs: Some(*runs),
                steps: Some(work.steps),
                evaluations: Some(work.evaluations),
                end_error: Some(errors.end),
                impact_time_error: errors.impact_time,
                impact_velocity_error: errors.impact_velocity,
                impacts: Some(*impacts),
                impact_difference: Some(errors.impact_difference),
                ..empty
            },
        }
    }
}
