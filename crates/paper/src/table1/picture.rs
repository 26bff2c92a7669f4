//! Table 1 as a picture.

use super::paper::{INTERVALS, PaperRow, ROWS};
use super::report::{RowReport, TableReport};
use softstop_draw::{Align, Axis, Chart, Layer, Panel, Stroke, power_of_ten, style};

/// Below the rows; `{}` says which of them are not as printed.
const NOTES: &str = "η: where the motion is lost; ends of branches located to 10⁻¹⁰, chaos by its lifetime, to 5 digits. \
    After a soft flip with hysteresis (row 4) it is where the next motion begins. “Next from”: where the last motion first \
    follows. G grazing, SN fold or jump, PD flip, ISN and IPD such a jump or a cascade of flips ending in chaos, OCH out of \
    chaos. Types and hysteresis are as printed{}; not all motions on the way. Behind a hard flip the doubled motion is \
    unstable: the paper's z = 2/2, (4/8)B and 4/6 (rows 14, 16, 17) are not met, its (2/4)A (13 to 15) is z = 1/2.";

/// Names of the columns, and their widths in pixels.
const COLUMNS: [(&str, f64); 10] = [
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
];
/// Distance of lines, and where a rule stands above one, in units of it.
const LINE: f64 = 27.0;
const RULE: f64 = 0.7;

/// The rows with the paper's beside ours.
pub fn picture(report: &TableReport) -> Chart {
    let width: f64 = COLUMNS.iter().map(|column| column.1).sum();
    let names = COLUMNS.map(|column| column.0.to_owned());
    let lines = report.rows.iter().zip(ROWS.iter());
    let lines = lines.map(|(row, paper)| line(row, paper));
    let lines: Vec<(Vec<String>, bool)> =
        [(names.into(), false)].into_iter().chain(lines).collect();
    let differs = |(cells, _): &(Vec<String>, bool)| cells.iter().any(|cell| cell.ends_with(" *"));
    let but = match lines.iter().any(differs) {
        true => " but where marked *",
        false => "",
    };
    let rule = |row: f64| Layer::horizontal(RULE - row, Stroke::solid(style::INK, 1.0), "");
    let rows = lines.len() as f64;
    let mut layers = vec![rule(1.0), rule(rows)];
    for (row, (cells, is_ruled)) in lines.into_iter().enumerate() {
        let row = row as f64;
        layers.extend(is_ruled.then(|| rule(row)));
        let mut left = 0.0;
        for (cell, (_, wide)) in cells.into_iter().zip(COLUMNS) {
            layers.push(Layer::text((left, -row), Align::Left, cell));
            left += wide;
        }
    }
    let panel = Panel {
        size: (width, LINE * (rows + 0.5)),
        x: Axis::bare().range((0.0, width)),
        y: Axis::bare().range((0.5 - rows, 1.0)),
        layers,
        ..Panel::default()
    };
    Chart {
        letters: 15,
        notes: vec![NOTES.replace("{}", but)],
        ..Chart::new(
            "Table 1 of Peterka 2003, found anew (unloaded, ρ = 10)",
            [panel],
        )
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
