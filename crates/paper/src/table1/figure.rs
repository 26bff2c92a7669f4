//! Table 1 among the figures: its picture and its rows.

use crate::figure::{Drawn, Figure, Studio};
use crate::table1::report::{RowReport, TableReport};
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
    let finding = |row: &RowReport| Some((format!("row {:02}", row.number), row.eta?));
    Ok(Drawn {
        files: vec![
            picture(&report).svg().into_bytes(),
            output::csv(&report.rows)?,
        ],
        findings: report.rows.iter().filter_map(finding).collect(),
    })
}
