//! The report of `chart precision`: a record for programs; for people best settings, leads, failures.

use super::case::Case;
use super::computer::Computer;
use super::errors::Scale;
use super::family::short_name;
use super::lead::{HOW, Lead, Quantity, TARGETS};
use super::measure::Row;
use super::truth::Truth;
use serde_json::json;
use softstop_console::column::{self, Column, Units};
use softstop_console::columns;
use softstop_console::record::Record;
use softstop_console::table::heading;
use std::collections::BTreeMap;

/// What was measured on a scene.
pub struct SceneMeasurement<'a> {
    /// The scene.
    pub case: &'a Case,
    /// What errors are measured against.
    pub truth: Truth,
    /// What errors are divided by.
    pub scale: Scale,
    /// One for each setting of each method.
    pub rows: Vec<Row>,
    /// By how much the exact method leads, for each error and target.
    pub leads: Vec<Lead>,
    /// The files written, by their kinds.
    pub files: BTreeMap<&'static str, String>,
}

impl SceneMeasurement<'_> {
    /// The number of impacts that are compared.
    fn impact_count(&self) -> usize {
        self.scale.told(&self.truth.solution.impacts).len()
    }

    /// For programs, with the computer on which times were taken.
    pub(super) fn record(&self, machine: &Computer) -> Record {
        let (case, truth) = (self.case, &self.truth);
        let reference = Record::default()
            .hidden("method", truth.method)
            .hidden("digits", u64::from(truth.digits()))
            .hidden("end", json!(truth.solution.end))
            .hidden("impacts", self.impact_count())
            .hidden("slowest", self.scale.slowest());
        let lead = Record::default()
            .hidden("how", HOW)
            .hidden("at", json!(self.leads));
        Record::default()
            .hidden("scene", case.name.as_str())
            .hidden("title", case.title.as_str())
            .hidden("periods", case.periods)
            .hidden("machine", json!(machine))
            .hidden("reference", reference)
            .hidden("scale", json!(self.scale))
            .hidden("rows", json!(self.rows))
            .hidden("lead", lead)
            .hidden("files", json!(self.files))
    }
}

/// What people read.
pub(super) fn text(scenes: &[SceneMeasurement<'_>], machine: &Computer) -> String {
    let mut text: String = scenes.iter().map(|it| scene(it) + "\n").collect();
    if scenes.len() > 1 {
        text += &summary(scenes);
    }
    text + &format!("Machine: {}\n", machine.line())
}

fn scene(measured: &SceneMeasurement<'_>) -> String {
    let (case, truth) = (measured.case, &measured.truth);
    let title = heading(&format!(
        "Precision on {}: {}, {} drive periods, {} impacts",
        case.name,
        case.title,
        case.periods,
        measured.impact_count()
    ));
    let runs = measured.rows.chunk_by(|a, b| a.method == b.method);
    let written = measured.files.iter();
    let written = written.map(|(kind, path)| format!("Written: {path} ({kind})\n"));
    format!(
        "{title}Reference: {}; certain to {} digits\n\n\
         Most accurate setting of each method; errors relative to the motion\n{}\n\
         Time of the next best over that of the exact method\n{}{}\n{}",
        truth.method,
        truth.digits(),
        column::text(&columns(), runs.map(best), &Units::SI),
        leads(&measured.leads),
        failures(&measured.rows),
        written.collect::<String>()
    )
}

/// The most accurate run of a method.
struct Best<'a> {
    method: &'a str,
    /// None if no run of it got to the end.
    row: Option<&'a Row>,
}

fn columns<'a>() -> [Column<Best<'a>>; 8] {
    columns! { Best<'a>, it;
        "method" [None] Plain, "" => it.method;
        "knob" [None] Power(1), "" => it.row.and_then(|row| row.knob);
        "seconds" [None] Power(1), "" => it.row.and_then(|row| row.seconds);
        "evaluations" [None] Plain, "" => it.row.and_then(|row| row.evaluations);
        "end" [None] Power(1), "" => it.row.and_then(|row| row.end_error);
        "impact_time" [None] Power(1), "" => it.row.and_then(|row| row.impact_time_error);
        "velocity" [None] Power(1), "" => it.row.and_then(|row| row.impact_velocity_error);
        "impacts" [None] Plain, "" => it.row.map_or_else(|| "no answer".to_owned(), impacts);
    }
}

fn impacts(row: &Row) -> String {
    match row.impact_difference {
        Some(0) => "all".to_owned(),
        difference => difference.map_or_else(dash, |difference| format!("{difference:+}")),
    }
}

fn best(runs: &[Row]) -> Best<'_> {
    let answered = runs.iter().filter_map(|row| Some((row.end_error?, row)));
    let best = answered.min_by(|a, b| a.0.total_cmp(&b.0));
    Best {
        method: &runs[0].method,
        row: best.map(|(_, row)| row),
    }
}

fn leads(leads: &[Lead]) -> String {
    let line = |lead: &Lead| {
        let what = name(lead.quantity);
        let (accuracy, ratio, next) = (lead.accuracy, ratio(lead), next(lead));
        format!("  {what:19}   {accuracy:>5.0e}   {ratio:>7}   {next}\n")
    };
    leads.iter().map(line).collect()
}

/// The lead as a factor.
fn ratio(lead: &Lead) -> String {
    let next = lead.next.as_ref();
    next.map_or_else(dash, |next| format!("{:.1}", next.ratio))
}

fn next(lead: &Lead) -> String {
    match (&lead.next, &lead.closest) {
        (Some(next), _) => next.method.clone(),
        (None, Some(closest)) => format!(
            "none gets there; {} has {:.0e} in {:.1} times the time",
            closest.method,
            closest.error.unwrap_or(f64::NAN),
            closest.ratio
        ),
        (None, None) => "none has an answer".to_owned(),
    }
}

/// Failures, counted by reason, and methods cut short.
fn failures(rows: &[Row]) -> String {
    let line = |row: &Row| {
        let reason = row.reason.as_ref()?;
        Some(format!("  {} {}: {reason}", row.method, row.status))
    };
    let lines: Vec<String> = rows.iter().filter_map(line).collect();
    let counted = lines.chunk_by(|a, b| a == b).map(|same| match same.len() {
        1 => format!("{}\n", same[0]),
        count => format!("{} ({count} settings)\n", same[0]),
    });
    match lines.len() {
        0 => String::new(),
        _ => format!(
            "\nSettings without an answer\n{}",
            counted.collect::<String>()
        ),
    }
}

/// The lead at each scene by the worst of all errors, as a table in Markdown for docs/accuracy.md.
fn summary(scenes: &[SceneMeasurement<'_>]) -> String {
    let accuracies: Vec<String> = TARGETS.map(|target| format!("{target:.0e}")).into();
    let mut text = format!(
        "Lead at equal accuracy\n\n| scene | exact: time, error | {} |\n",
        accuracies.join(" | ")
    );
    text += &format!("|---|---|{}\n", "---|".repeat(TARGETS.len()));
    text.extend(scenes.iter().map(summary_line));
    text + "\n"
}

fn summary_line(measured: &SceneMeasurement<'_>) -> String {
    let leads = measured.leads.iter();
    let own = leads.filter(|lead| lead.quantity == Quantity::Worst);
    let cells = own.map(|lead| match &lead.next {
        Some(next) => format!("{} {}", ratio(lead), short_name(&next.method)),
        None => "none".to_owned(),
    });
    let exact = measured.rows.first();
    let (time, worst) = exact.map_or((None, None), |row| (row.seconds, row.worst_error()));
    format!(
        "| {} | {} s, {} | {} |\n",
        measured.case.name,
        figure(time),
        figure(worst),
        cells.collect::<Vec<_>>().join(" | ")
    )
}

const fn name(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::End => "error at the end",
        Quantity::Worst => "worst of all errors",
    }
}

fn dash() -> String {
    "-".to_owned()
}

/// Two significant digits.
fn figure(value: Option<f64>) -> String {
    value.map_or_else(dash, |value| format!("{value:.1e}"))
}
