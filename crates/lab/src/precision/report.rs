//! The report of `chart precision`, whose field names are the keys of the JSON.

use std::collections::BTreeMap;

use serde::Serialize;

use super::case::Case;
use super::computer::Machine;
use super::errors::Scale;
use super::lead::{self, Lead};
use super::measure::Row;
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
    pub rows: Vec<Row>,
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

impl SceneReport {
    /// What was measured on a case.
    pub fn new(
        case: &Case,
        machine: &Machine,
        truth: &Truth,
        scale: Scale,
        rows: Vec<Row>,
    ) -> Self {
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
            lead: LeadReport {
                how: lead::HOW,
                at: lead::leads(&rows, exact),
            },
            rows,
            files: BTreeMap::new(),
        }
    }
}
