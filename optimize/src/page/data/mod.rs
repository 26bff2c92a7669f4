//! What the report of a design tells, as plain data in the machine's own units.
//!
//! Whatever is absent (`None`, or an empty list) is left out of the page, with its heading. Symbols may have an index
//! after an underscore (`s_SN`); the page sets it below the line.

mod pictures;

pub use pictures::{
    Basin, BasinMotion, Curve, Erosion, ErosionPoint, Front, Histogram, Map, Portrait, Response,
    Role,
};

use serde::Serialize;
use softstop_console::record::Record;

/// The whole report.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Report {
    /// Name of the machine.
    pub machine: String,
    /// What was asked, in a sentence.
    pub task: String,
    /// What the reader must know before the figures, each a sentence.
    pub warnings: Vec<String>,
    /// The figures that matter most, in large letters: the objective first.
    pub highlights: Vec<Fact>,
    /// The design beside other machines.
    pub comparison: Option<Comparison>,
    /// What limits the design, in a sentence.
    pub limit: Option<String>,
    /// What was required of it, and what it has: `verdict::required`.
    pub requirements: Vec<Record>,
    /// Maps over two parameters.
    pub maps: Vec<Map>,
    /// The motion over the drive's frequency.
    pub response: Option<Response>,
    /// The motion in the phase plane.
    pub portrait: Option<Portrait>,
    /// Which start leads to which motion.
    pub basin: Option<Basin>,
    /// Share and integrity of the basin along the zone.
    pub erosion: Option<Erosion>,
    /// What more of one good costs of another.
    pub fronts: Vec<Front>,
    /// The objective over machines within the tolerances.
    pub histogram: Option<Histogram>,
    /// What each tolerance does to the objective.
    pub sensitivities: Vec<Sensitivity>,
    /// Ways to bring the machine into its motion.
    pub run_up: Vec<RunUp>,
    /// How all this was computed.
    pub computed: Option<Computed>,
}

/// How a design was computed.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Computed {
    /// Hysteresis zones.
    pub zones: u64,
    /// Machines within the tolerances, if there are tolerances.
    pub samples: Option<u64>,
    /// Whether parameters follow others.
    pub has_links: bool,
}

/// What an axis, a column or a row shows.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Label {
    /// In words.
    pub name: String,
    /// Its letter; may be empty.
    pub symbol: String,
    /// Its unit; empty for bare numbers.
    pub unit: String,
}

/// A name and what stands behind it.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Fact {
    /// What it is.
    pub name: String,
    /// As it is to be read, with its unit.
    pub value: String,
}

impl Fact {
    /// With this name and value.
    pub fn new(name: impl Into<String>, value: impl Into<String>) -> Self {
        let (name, value) = (name.into(), value.into());
        Self { name, value }
    }
}

/// Machines side by side.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Comparison {
    /// Names of the machines; the design first.
    pub machines: Vec<String>,
    /// Their quantities.
    pub rows: Vec<Row>,
}

/// A quantity of machines side by side.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Row {
    /// What it is.
    pub label: Label,
    /// True if the search chose it.
    pub is_chosen: bool,
    /// Its value for each machine; none where a machine does not have it.
    pub values: Vec<Option<f64>>,
}

/// What the tolerance of a parameter does to the objective.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Sensitivity {
    /// The parameter.
    pub label: Label,
    /// Its value.
    pub value: f64,
    /// Its tolerance, both ways.
    pub tolerance: f64,
    /// Change of the objective at the upper end of the tolerance.
    pub effect: f64,
    /// Unit of the effect.
    pub effect_unit: String,
    /// Share of the objective's variance that comes with it alone (first Sobol index).
    pub share: Option<f64>,
    /// The same together with all others (total Sobol index).
    pub total: Option<f64>,
    /// The same of the variance of the place in the zone.
    pub margin: Option<f64>,
}

/// A way to bring the machine into its motion.
#[derive(Debug, Clone, Default, Serialize)]
pub struct RunUp {
    /// What is done, in a few words.
    pub way: String,
    /// Whether the machine then moves as designed.
    pub succeeds: bool,
    /// What else is to be known of it; may be empty.
    pub note: String,
}
