//! Table 1 in Markdown.

use super::paper::{INTERVALS, PaperRow, ROWS};
use super::report::{RowReport, TableReport};
use softstop_draw::power_of_ten;

/// The columns.
const COLUMNS: [&str; 9] = [
    "no.",
    "η",
    "paper",
    "η − paper",
    "transition",
    "flip",
    "next from",
    "hyst.",
    "type",
];

/// The rows with the paper's beside ours; a type or hysteresis that is not as printed is marked with an asterisk.
pub fn markdown(report: &TableReport) -> String {
    let rows = report.rows.iter().zip(ROWS.iter());
    let rows = rows.map(|(row, paper)| cells(row, paper));
    let lines = [COLUMNS.map(str::to_owned), ["---"; 9].map(str::to_owned)];
    let lines = lines.into_iter().chain(rows);
    lines
        .map(|it| format!("| {} |\n", it.join(" | ")))
        .collect()
}

/// The first row of a part of the paper's figure has its letter.
fn cells(row: &RowReport, paper: &PaperRow) -> [String; 9] {
    let interval = INTERVALS.iter().position(|it| it.0 == paper.eta);
    let letter = interval.map_or("", |index| ["(a) ", "(b) ", "(c) ", "(d) "][index]);
    let same = (Some(&*paper.kind), Some(paper.hysteresis));
    let is_same = (row.kind.as_deref(), row.hysteresis) == same;
    [
        format!("{letter}{}", row.number),
        row.figure().unwrap_or_else(|| "–".to_owned()),
        row.paper.to_string(),
        row.eta
            .map_or_else(String::new, |eta| difference(eta - row.paper)),
        row.transition(" → ", " ↔ ").replace("->", "→"),
        row.flip.unwrap_or_default().to_owned(),
        row.follows().unwrap_or_default(),
        match row.hysteresis {
            Some(true) => "yes",
            Some(false) => "no",
            None => "–",
        }
        .to_owned(),
        row.kind.clone().unwrap_or_default().replace("->", "→") + if is_same { "" } else { " \\*" },
    ]
}

/// One digit and a power of ten, with its sign.
fn difference(value: f64) -> String {
    let text = format!("{value:+.0e}");
    let (digit, power) = text.split_once('e').unwrap_or((&text, "0"));
    let power = power_of_ten(power.parse().unwrap_or(0));
    format!("{}×{power}", digit.replace('-', "−"))
}
