//! Table 1 as a picture.

use super::paper::{INTERVALS, PaperRow, ROWS};
use super::report::{RowReport, TableReport};
use softstop_draw::scale::power_of_ten;
use softstop_draw::table::TablePicture;

const NOTES: [&str; 5] = [
    "η: where the motion is lost; ends of branches located to 10⁻¹⁰, chaos by its lifetime, to 5 digits. After a soft flip",
    "with hysteresis (row 4) it is where the next motion begins. “Next from”: where the last motion first follows.",
    "G grazing, SN fold or jump, PD flip, ISN and IPD such a jump or a cascade of flips ending in chaos, OCH out of chaos.",
    "Types and hysteresis are as printed but where marked *; not all motions on the way. Behind a hard flip the doubled",
    "motion is unstable: the paper's z = 2/2, (4/8)B and 4/6 (rows 14, 16, 17) are not met, its (2/4)A (13 to 15) is z = 1/2.",
];

/// The rows with the paper's beside ours.
pub fn picture(report: &TableReport) -> TablePicture {
    let lines = report.rows.iter().zip(ROWS.iter());
    TablePicture {
        title: "Table 1 of Peterka 2003, found anew (unloaded, ρ = 10)".to_owned(),
        columns: vec![
            ("", 44.0),
            ("No.", 50.0),
            ("η", 122.0),
            ("paper", 106.0),
            ("η − paper", 96.0),
            ("transition", 330.0),
            ("flip", 54.0),
            ("next from", 122.0),
            ("hyst.", 54.0),
            ("type", 140.0),
        ],
        lines: lines.map(|(row, paper)| line(row, paper)).collect(),
        notes: NOTES.map(str::to_owned).to_vec(),
    }
}

fn line(row: &RowReport, paper: &PaperRow) -> (Vec<String>, bool) {
    let interval = INTERVALS.iter().position(|it| it.0 == paper.eta);
    let letter = interval.map(|index| ["(a)", "(b)", "(c)", "(d)"][index]);
    let same = (Some(&*paper.kind), Some(paper.hysteresis));
    let is_same = (row.kind.as_deref(), row.hysteresis) == same;
    let cells = vec![
        letter.unwrap_or_default().to_owned(),
        row.number.to_string(),
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
        row.kind.clone().unwrap_or_default().replace("->", "→") + if is_same { "" } else { " *" },
    ];
    (cells, interval.is_some())
}

/// One digit and a power of ten, with its sign.
fn difference(value: f64) -> String {
    let text = format!("{value:+.0e}");
    let (digit, power) = text.split_once('e').unwrap_or((&text, "0"));
    let power = power_of_ten(power.parse().unwrap_or(0));
    format!("{}×{power}", digit.replace('-', "−"))
}
