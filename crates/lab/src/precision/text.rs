//! The report of `chart precision` for people: best settings, leads, failures.

use super::lead::{Lead, Quantity, TARGETS};
use super::measure::Row;
use super::report::{PrecisionReport, SceneReport};
use softstop_console::column::{self, Column, Units};
use softstop_console::columns;
use softstop_console::table::heading;

/// All charts of a run.
pub fn text(report: &PrecisionReport) -> String {
    let mut text = String::new();
    for chart in &report.charts {
        text += &scene(chart);
        text.push('\n');
    }
    if report.charts.len() > 1 {
        text += &summary(report);
    }
    text + &format!("Machine: {}\n", report.machine.line())
}

fn scene(chart: &SceneReport) -> String {
    let mut text = heading(&format!(
        "Precision on {}: {}, {} drive periods, {} impacts",
        chart.scene, chart.title, chart.periods, chart.reference.impacts
    ));
    text += &format!(
        "Reference: {}; certain to {} digits\n",
        chart.reference.method, chart.reference.digits
    );
    text += "\nMost accurate setting of each method; errors relative to the motion\n";
    let best = names(&chart.rows)
        .into_iter()
        .map(|name| best(name, &chart.rows));
    text += &column::text(&columns(), best, &Units::SI);
    text += "\nTime of the next best over that of the exact method\n";
    text += &leads(&chart.lead.at);
    text += &failures(&chart.rows);
    text.push('\n');
    for (kind, path) in &chart.files {
        text += &format!("Written: {path} ({kind})\n");
    }
    text
}

/// The names of the methods, in order.
pub(super) fn names(rows: &[Row]) -> Vec<&str> {
    let mut names: Vec<&str> = rows.iter().map(|row| row.method.as_str()).collect();
    names.dedup();
    names
}

/// A method and its most accurate setting.
type Best<'a> = (&'a str, Option<&'a Row>);

fn columns<'a>() -> [Column<Best<'a>>; 8] {
    columns! { Best<'a>, it;
        "method" [None] Plain, "" => it.0;
        "knob" [None] Power(1), "" => it.1.and_then(|row| row.knob);
        "seconds" [None] Power(1), "" => it.1.and_then(|row| row.seconds);
        "evaluations" [None] Plain, "" => it.1.and_then(|row| row.evaluations);
        "end" [None] Power(1), "" => it.1.and_then(|row| row.end_error);
        "impact_time" [None] Power(1), "" => it.1.and_then(|row| row.impact_time_error);
        "velocity" [None] Power(1), "" => it.1.and_then(|row| row.impact_velocity_error);
        "impacts" [None] Plain, "" => it.1.map_or_else(|| "no answer".to_owned(), impacts);
    }
}

fn impacts(row: &Row) -> String {
    match row.impact_difference {
        Some(0) => "all".to_owned(),
        difference => difference.map_or_else(dash, |difference| format!("{difference:+}")),
    }
}

fn best<'a>(name: &'a str, rows: &'a [Row]) -> Best<'a> {
    let own = rows.iter().filter(|row| row.method == name);
    let answered = own.filter_map(|row| Some((row.end_error?, row)));
    let best = answered.min_by(|a, b| a.0.total_cmp(&b.0));
    (name, best.map(|(_, row)| row))
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
    lead.next
        .as_ref()
        .map_or_else(dash, |next| format!("{:.1}", next.ratio))
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
    let mut lines: Vec<(String, usize)> = Vec::new();
    for row in rows {
        if let Some(reason) = &row.reason {
            let line = format!("  {} {}: {reason}", row.method, row.status);
            match lines.last_mut() {
                Some((last, count)) if *last == line => *count += 1,
                _ => lines.push((line, 1)),
            }
        }
    }
    if lines.is_empty() {
        return String::new();
    }
    let line = |(line, count): &(String, usize)| match count {
        1 => format!("{line}\n"),
        _ => format!("{line} ({count} settings)\n"),
    };
    let lines: String = lines.iter().map(line).collect();
    format!("\nSettings without an answer\n{lines}")
}

/// The lead at each scene, as a table in Markdown for docs/accuracy.md.
fn summary(report: &PrecisionReport) -> String {
    let accuracies: Vec<String> = TARGETS.map(|target| format!("{target:.0e}")).into();
    let mut text = format!(
        "Lead at equal accuracy\n\n| scene | exact: time, worst error | by | {} |\n",
        accuracies.join(" | ")
    );
    text += &format!("|---|---|---|{}\n", "---|".repeat(TARGETS.len()));
    for chart in &report.charts {
        for quantity in Quantity::ALL {
            text += &summary_line(chart, quantity);
        }
    }
    text + "\n"
}

fn summary_line(chart: &SceneReport, quantity: Quantity) -> String {
    let own = chart
        .lead
        .at
        .iter()
        .filter(|lead| lead.quantity == quantity);
    let cells: Vec<String> = own
        .map(|lead| match &lead.next {
            Some(next) => format!("{} {}", ratio(lead), next.method),
            None => "none gets there".to_owned(),
        })
        .collect();
    let exact = chart.rows.first();
    let (time, worst) = exact.map_or((None, None), |row| (row.seconds, row.worst_error()));
    format!(
        "| {} | {} s, {} | {} | {} |\n",
        chart.scene,
        figure(time),
        figure(worst),
        name(quantity),
        cells.join(" | ")
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
