//! The paper's Table 1.

use softstop::transitions::Rules;

use super::{Detail, Drawn, Figure};
use crate::failure::Failure;
use crate::output;
use crate::table1;

/// Table 1.
pub(super) const FIGURE: Figure = Figure {
    title: "Table 1: the bifurcations of rho = 10",
    files: &["table-1.svg", "table-1.csv"],
    draw,
};

fn draw(_: Detail) -> Result<Drawn, Failure> {
    let report = table1::table(&Rules::default())?;
    let finding = |row: &table1::report::RowReport| Some((format!("row {}", row.number), row.eta?));
    Ok(Drawn {
        files: vec![
            table1::picture(&report).svg().into_bytes(),
            output::csv(&report.rows)?,
        ],
        findings: report.rows.iter().filter_map(finding).collect(),
    })
}
