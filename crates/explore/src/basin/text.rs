//! What basins came to, for people.

use std::fmt::Write;

use super::report::{BasinReport, CertaintyReport};

pub(super) fn basins(report: &BasinReport) -> String {
    let grid = &report.grid;
    let mut text = format!(
        "{}: {} x {} initial states\n\n",
        report.machine, grid.across.cells, grid.up.cells
    );
    text.push_str("motion                  share    95 % interval        integrity  velocity\n");
    for class in &report.basins {
        let name = match &class.pattern {
            Some(pattern) if pattern.len() > 1 => format!("{} ({pattern})", class.motion),
            _ => class.motion.clone(),
        };
        let [low, high] = class.interval;
        let number = |value: Option<f64>| {
            value.map_or_else(|| "-".to_owned(), |value| format!("{value:.4}"))
        };
        let _ = writeln!(
            text,
            "{name:22}  {:.5}  {low:.5} to {high:.5}   {:>9}  {:>8}",
            class.share,
            number(class.integrity),
            number(class.velocity)
        );
    }
    files(&mut text, &report.files);
    text
}

pub(super) fn certainty(report: &CertaintyReport) -> String {
    let grid = &report.grid;
    let mut text = format!(
        "Establishing certainty of z = 1 from g0 (place 0) to s_SN (place 1), {} x {} initial states\n\n",
        grid.across.cells, grid.up.cells
    );
    text.push_str("place   frequency  certainty  95 % interval        integrity\n");
    for place in &report.places {
        let [low, high] = place.interval;
        let integrity = place
            .integrity
            .map_or_else(|| "-".to_owned(), |value| format!("{value:.4}"));
        let _ = writeln!(
            text,
            "{:.4}  {:.6}   {:.5}    {low:.5} to {high:.5}   {integrity:>9}",
            place.place, place.frequency, place.certainty
        );
    }
    files(&mut text, &report.files);
    text
}

fn files(text: &mut String, files: &[String]) {
    text.push('\n');
    for file in files {
        let _ = writeln!(text, "wrote {file}");
    }
}
