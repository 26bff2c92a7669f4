//! Table 1 as a picture.

use super::paper::{INTERVALS, PaperRow, ROWS};
use super::report::{RowReport, TableReport};
use softstop_draw::table::TablePicture;

/// The rows with the paper's beside ours.
pub fn picture(report: &TableReport) -> TablePicture {
    let lines = report.rows.iter().zip(&ROWS);
    TablePicture {
        title: "Table 1 of Peterka 2003, found anew (unloaded, ρ = 10)".to_owned(),
        columns: vec![
            ("", 44.0),
            ("No.", 50.0),
            ("η", 128.0),
            ("paper", 120.0),
            ("transition", 400.0),
            ("hyst.", 60.0),
            ("type", 160.0),
            ("as in the paper", 130.0),
        ],
        lines: lines.map(|(row, paper)| line(row, paper)).collect(),
        notes: vec![
            "η: where the motion is lost; ends of branches located to 1e-10, chaos by its lifetime."
                .to_owned(),
            "G grazing, SN fold or jump, PD flip, ISN and IPD such a jump or a cascade of flips ending in chaos, OCH out of chaos."
                .to_owned(),
        ],
    }
}

fn line(row: &RowReport, paper: &PaperRow) -> (Vec<String>, bool) {
    let interval = INTERVALS.iter().position(|it| it.0 == paper.eta);
    let letter = interval.map_or_else(String::new, |index| {
        format!("({})", ["a", "b", "c", "d"][index])
    });
    let is_same =
        row.kind.as_deref() == Some(paper.kind) && row.hysteresis == Some(paper.hysteresis);
    let eta = row
        .eta
        .map_or_else(|| "–".to_owned(), |eta| format!("{eta:.10}"));
    let hysteresis = row
        .hysteresis
        .map_or("–", |there| if there { "yes" } else { "no" });
    let cells = vec![
        letter,
        row.number.to_string(),
        eta,
        row.paper.to_string(),
        arrows(row),
        hysteresis.to_owned(),
        row.kind.clone().unwrap_or_default().replace("->", "→"),
        if is_same { "✓" } else { "–" }.to_owned(),
    ];
    (cells, interval.is_some())
}

/// From one motion to the other, in both directions where there is no hysteresis.
fn arrows(row: &RowReport) -> String {
    let (Some(from), Some(to)) = (&row.from, &row.to) else {
        return "not found".to_owned();
    };
    let arrow = if row.hysteresis == Some(false) {
        "↔"
    } else {
        "→"
    };
    format!("{from} {arrow} {}", to.replace("->", "→"))
}
