//! Table 1 for people.

use super::report::{RowReport, TableReport};
use softstop_console::table::heading;

/// The rows one under the other, their remarks below.
pub(super) fn text(report: &TableReport) -> String {
    let mut text = heading("Table 1 of Peterka 2003, found anew (unloaded, rho = 10)");
    text += &format!(
        "\n{:>3}  {:<12}  {:<10}  {:<5}  {:<16}  transition\n",
        "No.", "eta", "paper", "hyst.", "type"
    );
    for row in &report.rows {
        text += &line(row);
    }
    text += "\nRemarks\n";
    for row in &report.rows {
        text += &format!("{:>3}  {}\n", row.number, row.remark);
    }
    text
}

fn line(row: &RowReport) -> String {
    let eta = row.eta.map_or("-".to_owned(), |eta| format!("{eta:.10}"));
    let hysteresis = match row.hysteresis {
        Some(true) => "yes",
        Some(false) => "no",
        None => "-",
    };
    let transition = match (&row.from, &row.to, row.hysteresis) {
        (Some(from), Some(to), Some(false)) => format!("{from} <-> {to}"),
        (Some(from), Some(to), _) => format!("{from} -> {to}"),
        _ => "not found".to_owned(),
    };
    format!(
        "{:>3}  {eta:<12}  {:<10}  {hysteresis:<5}  {:<16}  {transition}\n",
        row.number,
        row.paper,
        row.kind.as_deref().unwrap_or("-")
    )
}
