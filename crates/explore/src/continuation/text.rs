//! The result for people.

use super::report::{BranchReport, ContinuationReport, CurveReport, SpecialReport};
use softstop_console::table::{heading, row, table};

/// The branches with their special points, the curves, and where the files are.
pub(super) fn text(report: &ContinuationReport) -> String {
    let mut text = String::new();
    for branch in &report.branches {
        text += &branch_text(report.parameter, branch);
    }
    if let Some(curves) = &report.curves {
        text += &heading(&format!(
            "Curves in {} and {}",
            report.parameter, curves.parameter
        ));
        text += &table(&curves.curves.iter().map(curve_row).collect::<Vec<_>>());
        text.push('\n');
    }
    for place in &report.files {
        text += &format!("Written: {place}\n");
    }
    text
}

fn branch_text(parameter: &str, branch: &BranchReport) -> String {
    let title = format!(
        "Branch of period {}: {parameter} from {:.10} to {:.10}, {} points",
        branch.periods, branch.from, branch.to, branch.points
    );
    let head = row(
        "special point",
        [parameter.to_owned(), "impact velocities".to_owned()],
    );
    let rows: Vec<_> = [head]
        .into_iter()
        .chain(branch.specials.iter().map(special_row))
        .collect();
    let table = if branch.specials.is_empty() {
        "No special points.\n".to_owned()
    } else {
        table(&rows)
    };
    let [first, last] = &branch.ends;
    heading(&title) + &table + &format!("Ends: {first}; {last}.\n\n")
}

fn special_row(special: &SpecialReport) -> (String, Vec<String>) {
    let velocities = special.before_impact_velocities.iter();
    let velocities: Vec<_> = velocities
        .map(|velocity| format!("{velocity:.6}"))
        .collect();
    let velocities = if velocities.is_empty() {
        "none".to_owned()
    } else {
        velocities.join(" ")
    };
    row(
        &format!("{} {}", special.symbol, special.name),
        [format!("{:.12}", special.parameter), velocities],
    )
}

fn curve_row(curve: &CurveReport) -> (String, Vec<String>) {
    let place = |[p, q]: [f64; 2]| format!("({p:.8}, {q:.8})");
    row(
        curve.symbol,
        [
            format!("{} to {}", place(curve.from), place(curve.to)),
            curve.ends.join("; "),
        ],
    )
}
