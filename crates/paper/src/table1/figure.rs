//! Table 1 among the figures.

use anyhow::Result;
use softstop_console::output;

use super::{TableReport, paper, picture};
use crate::figure::{Drawn, Figure, Findings, Studio};

/// Its picture and its rows.
pub(crate) fn draw(studio: &Studio, _: &Figure) -> Result<Drawn> {
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
