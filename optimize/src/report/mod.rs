//! The report of `optimize`: design, references and search, whose field names are the keys of the JSON.

pub mod text;

use std::collections::BTreeMap;

use serde::Serialize;
use softstop::{Dimension, Parameter};
use softstop_console::export::Report;
use softstop_console::report::{MotionReport, Stated};

use crate::design::{Design, Problem};
use crate::optimize::reference::Reference;

/// The design that was found, in the machine's own units.
#[derive(Debug, Clone, Serialize)]
pub struct DesignReport {
    /// The machine.
    #[serde(flatten)]
    pub machine: Stated,
    /// The motion.
    #[serde(flatten)]
    pub motion: MotionReport,
    /// Lower end of the design's zone.
    pub frequency_g0: f64,
    /// Upper end of the design's zone.
    pub frequency_sn: f64,
    /// Least allowed distance M from both ends, as a share of the zone's width.
    pub margin: f64,
    /// Place in the zone, in [M, 1 - M].
    pub s: f64,
    /// The limits that hold the design back, in words.
    pub at_limits: Vec<String>,
}

impl DesignReport {
    /// The report on the solution of this problem.
    #[must_use]
    pub fn new(problem: &Problem, design: &Design) -> Self {
        let machine = &design.machine;
        let own = |frequency| machine.to_own(Dimension::Frequency, frequency);
        Self {
            machine: Stated::of(machine),
            motion: MotionReport::of(machine, &design.orbit),
            frequency_g0: own(design.zone.frequency_g0),
            frequency_sn: own(design.zone.frequency_sn),
            margin: problem.margin,
            s: design.place,
            at_limits: at_limits(problem, design),
        }
    }
}

/// The key of a parameter in JSON: the last word of its name, as the paper's ratios are called.
#[must_use]
pub fn key(parameter: Parameter) -> String {
    match parameter {
        Parameter::StopStiffness => "stiffness".to_owned(),
        Parameter::Suspension => "suspension_stiffness".to_owned(),
        Parameter::Frequency => "frequency".to_owned(),
        other => other.name().replace('.', "_"),
    }
}

/// Distance in s within which a design stands at the end of the allowed window.
const AT_MARGIN: f64 = 1e-9;

fn at_limits(problem: &Problem, design: &Design) -> Vec<String> {
    let mut limits: Vec<String> = problem
        .axes
        .iter()
        .filter_map(|axis| {
            let end = axis.range.end(design.machine.value(axis.parameter)?)?;
            Some(format!("{}: {end} bound", key(axis.parameter)))
        })
        .collect();
    if design.place <= problem.margin + AT_MARGIN {
        limits.push("margin from g0".to_owned());
    }
    if design.place >= 1.0 - problem.margin - AT_MARGIN {
        limits.push("margin from s_SN".to_owned());
    } else if let Some(end) = near_end(problem, design.frequency()) {
        limits.push(format!("frequency: {end} bound"));
    }
    limits
}

/// Frequencies pass through the place in the zone and back, so an end is met to rounding only.
fn near_end(problem: &Problem, frequency: f64) -> Option<&'static str> {
    let near = |end: f64| end.is_finite() && (frequency - end).abs() <= 1e-12 * end.abs();
    let Problem {
        frequency: range, ..
    } = problem;
    match (range.is_held(), near(range.low), near(range.high)) {
        (false, true, _) => Some("lower"),
        (false, _, true) => Some("upper"),
        _ => None,
    }
}

/// A motion beside which the design is set.
#[derive(Debug, Clone, Serialize)]
pub struct ReferenceReport {
    /// The machine.
    #[serde(flatten)]
    pub machine: Stated,
    /// The motion.
    #[serde(flatten)]
    pub motion: MotionReport,
    /// Before-impact velocity of the design over that of this motion.
    pub gain: f64,
}

impl ReferenceReport {
    /// A reference beside a design of this velocity.
    #[must_use]
    pub fn new(reference: &Reference, design_velocity: f64) -> Self {
        let Reference { machine, orbit, .. } = reference;
        Self {
            machine: Stated::of(machine),
            motion: MotionReport::of(machine, orbit),
            gain: design_velocity / orbit.before_impact_velocity(),
        }
    }
}

/// How the design was searched.
#[derive(Debug, Clone, Serialize)]
pub struct SearchReport {
    /// Values held and ranges searched, in words.
    pub bounds: BTreeMap<String, String>,
    /// Seed.
    pub seed: u64,
    /// Zones computed at most.
    pub evaluations: u64,
    /// Zones that were computed.
    pub evaluations_used: u64,
}

/// What `softstop optimize` reports and writes.
#[derive(Debug, Clone, Serialize)]
pub struct OptimizeReport {
    /// The solution.
    pub design: DesignReport,
    /// The motions beside it: the paper's points A and B, or the machine as it was given.
    pub reference: BTreeMap<&'static str, ReferenceReport>,
    /// How it was searched.
    pub search: SearchReport,
    /// The same for people.
    #[serde(skip)]
    pub text: String,
}

impl Report for OptimizeReport {
    fn text(&self) -> String {
        self.text.clone()
    }
}
