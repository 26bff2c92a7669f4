//! Table 1 among the figures.

use anyhow::Result;
use softstop_console::output;

use super::{TableReport, markdown, paper};
use crate::figure::{Drawn, Figure, Findings, Studio};

/// The table in Markdown, and its rows.
pub(crate) fn draw(studio: &Studio, _: &Figure) -> Result<Drawn> {
    let report = TableReport::new(&paper::ROWS, studio.transitions()?, &studio.rules());
    let mut findings = Findings::default();
    for row in &report.rows {
        findings.add(format!("row {:02}", row.number), row.eta);
    }
    let markdown = markdown(&report).into_bytes();
    Ok(Drawn::new([markdown, output::csv(&report.rows)?], findings))
}
