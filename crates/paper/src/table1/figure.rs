//! Table 1 among the figures: its picture and its rows.

use crate::figure::{Drawn, Figure, Findings, Studio};
use crate::table1::report::TableReport;
use crate::table1::{paper, picture};
use anyhow::Result;
use softstop_console::output;

/// Table 1.
pub(crate) const FIGURE: Figure = Figure {
    title: "Table 1: the bifurcations of rho = 10",
    files: &["table-1.svg", "table-1.csv"],
    draw,
};

fn draw(studio: &Studio) -> Result<Drawn> {
    let report = TableReport::new(&paper::ROWS, studio.transitions()?, &studio.rules());
    let mut findings = Findings::default();
    for row in &report.rows {
        findings.add(format!("row {:02}", row.number), row.eta);
    }
    let picture = picture(&report).svg().into_bytes();
    Ok(Drawn {
        files: vec![picture, output::csv(&report.rows)?],
        findings,
    })
}
