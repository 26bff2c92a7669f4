//! How a design was searched, as records.

use std::collections::BTreeMap;

use serde::Serialize;
use softstop::Parameter;
use softstop_console::column::Column;
use softstop_console::columns;
use softstop_console::number::NumberStyle::Six;
use softstop_console::record::Record;

use crate::design::Problem;
use crate::design::search::{Ascents, EVALUATIONS_PER_START, Resolution};
use crate::design::space::Axis;
use crate::optimize::outcome::{Interrupted, Outcome};

/// How the design was searched.
#[derive(Debug, Serialize)]
pub struct SearchReport {
    /// Values held and ranges searched, in words.
    pub bounds: BTreeMap<String, String>,
    /// What was searched, by the keys of the machine's file.
    pub axes: Vec<Record>,
    /// Parameters that follow others.
    pub links: usize,
    /// Zones computed at most.
    pub evaluations: u64,
    /// Zones that were computed.
    pub evaluations_used: u64,
    /// Ascents from the best distant zones, and the last of them that bettered nothing.
    pub ascents: Ascents,
    /// How fine it was looked for, if trials were in the way.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resolution: Option<Resolution>,
    /// What was interrupted, if the run was asked to end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interrupted: Option<Interrupted>,
}

/// The name of a parameter in [`SearchReport::bounds`]: the last word of its key, as the paper's ratios are called.
fn short_name(parameter: Parameter) -> String {
    match parameter {
        Parameter::StopStiffness => "stiffness".to_owned(),
        Parameter::Suspension => "suspension_stiffness".to_owned(),
        Parameter::Frequency => "frequency".to_owned(),
        other => other.name().replace('.', "_"),
    }
}

type AxisRow<'a> = (&'a Problem, &'a Axis);

fn columns<'a>() -> [Column<AxisRow<'a>>; 7] {
    columns! { AxisRow<'a>, (problem, axis);
        "parameter" [None] Plain, "its key in the machine's file" => problem.machine.name(axis.parameter);
        "name" [None] Plain, "its key in rivals" => problem.machine.name(axis.parameter);
        "meaning" [None] Plain, "what it is" => problem.machine.meaning_of(axis.parameter).0;
        "unit" [None] Plain, "unit of its values" => problem.machine.unit_of(axis.parameter);
        "low" [None] Six, "lower end" => axis.range.low;
        "high" [None] Six, "upper end" => Some(axis.range.high).filter(|high| high.is_finite());
        "values" [None] Six, "the values of a catalogue" => axis.catalogue.clone();
    }
}

impl SearchReport {
    /// How this outcome was found with so many zones at most.
    pub(crate) fn new(problem: &Problem, evaluations: u64, outcome: &Outcome) -> Self {
        let found = &outcome.solution.found;
        let frequency = Axis::new(Parameter::Frequency, problem.frequency);
        let all = || problem.axes.iter().chain([&frequency]);
        let bounds = all().map(|it| (short_name(it.parameter), it.range.to_string()));
        let axes = all().filter(|it| !it.range.is_held());
        Self {
            bounds: bounds.collect(),
            axes: axes
                .map(|it| Record::of(&columns(), &(problem, it)))
                .collect(),
            links: problem.links.len(),
            evaluations,
            evaluations_used: outcome.evaluations,
            ascents: found.ascents,
            resolution: found.resolution,
            interrupted: outcome.interrupted,
        }
    }

    /// What has to be known of the design, for people.
    pub(crate) fn text(&self) -> String {
        let interrupted = self
            .interrupted
            .map(|it| format!("Interrupted: {}.\n", it.words()));
        let resolution = self.resolution.map(|it| {
            format!(
                "What takes many motions is counted on some, and has no derivatives: searched in steps of {} % of each range \
                 and {} % of the zone.\n",
                Six.format(100.0 * it.axes),
                Six.format(100.0 * it.place)
            )
        });
        let Ascents {
            made,
            idle,
            left_out,
        } = self.ascents;
        let ended = self.interrupted.is_none().then(|| {
            let zones = format!("{} of {} zones", self.evaluations_used, self.evaluations);
            let why = match (idle, left_out) {
                (0, 0) => "the survey has no further start; more evaluations make it finer".to_owned(),
                (0, left_out) => format!(
                    "each ascent counts as {EVALUATIONS_PER_START} zones, so that {left_out} further starts are left out; more \
                     evaluations take them up"
                ),
                (idle, _) => format!("the last {idle} bettered nothing"),
            };
            format!("Ended after a survey of {zones} and {made} ascents: {why}.\n")
        });
        let all = interrupted.into_iter().chain(ended);
        all.chain(resolution).collect()
    }
}
