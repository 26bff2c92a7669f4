//! The data of a report's tables and pictures as CSV, numbers with all their digits.

use super::data::{Basin, Curve, Label, Map, Report};

/// A table: its file's name, its columns, its rows.
type Sheet = (String, Vec<String>, Vec<Vec<String>>);

/// The files, each with its name and its bytes; those of absent data are left out.
///
/// # Errors
/// If a table cannot be written to memory.
pub fn csv(report: &Report) -> Result<Vec<(String, Vec<u8>)>, csv::Error> {
    let sheets = sheets(report)
        .into_iter()
        .filter(|(_, _, rows)| !rows.is_empty());
    let written = sheets.map(|(name, columns, rows)| {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(&columns)?;
        for row in &rows {
            writer.write_record(row)?;
        }
        let bytes = writer.into_inner().map_err(|error| error.into_error())?;
        Ok((format!("{name}.csv"), bytes))
    });
    written.collect()
}

fn sheets(report: &Report) -> Vec<Sheet> {
    let mut sheets = Vec::new();
    if let Some(of) = &report.comparison {
        let head = ["quantity", "unit", "chosen"]
            .map(str::to_owned)
            .into_iter();
        let rows = of.rows.iter().map(|row| {
            let told = [
                row.label.name.clone(),
                row.label.unit.clone(),
                row.is_chosen.to_string(),
            ];
            told.into_iter()
                .chain(row.values.iter().map(|value| optional(*value)))
                .collect()
        });
        sheets.push((
            "comparison".to_owned(),
            head.chain(of.machines.clone()).collect(),
            rows.collect(),
        ));
    }
    let rows = report.requirements.iter().map(|it| {
        let words = [&it.name, &it.meaning, &it.unit, &it.required].map(String::clone);
        let values = [digits(it.value), digits(it.margin), it.met.to_string()];
        words
            .into_iter()
            .chain(values)
            .chain([it.note.clone()])
            .collect()
    });
    let head = words(&[
        "name", "meaning", "unit", "required", "value", "margin", "met", "note",
    ]);
    sheets.push(("requirements".to_owned(), head, rows.collect()));
    for (index, map) in report.maps.iter().enumerate() {
        let number = index + 1;
        sheets.push((
            format!("map-{number}"),
            columns(&[&map.x, &map.y, &map.shade]),
            cells(map),
        ));
        let name = format!("map-{number}-boundaries");
        sheets.push(lines(name, "boundary", [&map.x, &map.y], &map.curves));
    }
    if let Some(of) = &report.response {
        sheets.push(lines(
            "response".to_owned(),
            "motion",
            [&of.x, &of.y],
            &of.curves,
        ));
    }
    if let Some(of) = &report.portrait {
        sheets.push(lines(
            "portrait".to_owned(),
            "motion",
            [&of.x, &of.y],
            &of.curves,
        ));
    }
    if let Some(of) = &report.basin {
        let head = [columns(&[&of.x, &of.y]), words(&["motion"])].concat();
        sheets.push(("basin".to_owned(), head, starts(of)));
    }
    if let Some(of) = &report.erosion {
        let head = words(&[
            "place",
            "frequency",
            "share",
            "share_low",
            "share_high",
            "integrity",
        ]);
        let rows = of.points.iter().map(|it| {
            let [low, high] = it.interval;
            let values = [it.place, it.frequency, it.share, low, high].map(digits);
            values.into_iter().chain([optional(it.integrity)]).collect()
        });
        sheets.push(("erosion".to_owned(), head, rows.collect()));
    }
    for front in &report.fronts {
        let rows = front.points.iter().map(|point| point.map(digits).to_vec());
        sheets.push((
            format!("front-{}", front.name),
            columns(&[&front.x, &front.y]),
            rows.collect(),
        ));
    }
    if let Some(of) = &report.histogram {
        let [low, high] = of.range;
        let step = (high - low) / of.counts.len().max(1) as f64;
        let end = |index: usize| digits(low + step * index as f64);
        let rows = of.counts.iter().enumerate();
        let rows = rows.map(|(index, count)| vec![end(index), end(index + 1), count.to_string()]);
        let [from, to] = ["from", "to"].map(|end| format!("{end}: {}", of.x.line()));
        let head = vec![from, to, "machines".to_owned()];
        sheets.push(("histogram".to_owned(), head, rows.collect()));
    }
    let rows = report.sensitivities.iter().map(|it| {
        let named = [it.label.name.clone(), it.label.unit.clone()];
        let values = [it.value, it.tolerance, it.effect].map(digits);
        let shares = [it.share, it.total, it.margin].map(optional);
        named
            .into_iter()
            .chain(values)
            .chain([it.effect_unit.clone()])
            .chain(shares)
            .collect()
    });
    let head = words(&[
        "parameter",
        "unit",
        "value",
        "tolerance",
        "effect",
        "effect_unit",
        "share",
        "total",
        "margin",
    ]);
    sheets.push(("sensitivities".to_owned(), head, rows.collect()));
    sheets
}

fn words(words: &[&str]) -> Vec<String> {
    words.iter().map(|word| (*word).to_owned()).collect()
}

fn columns(labels: &[&Label]) -> Vec<String> {
    labels.iter().map(|label| label.line()).collect()
}

/// The shortest text that reads back as the same number; empty for what is none.
fn digits(value: f64) -> String {
    if value.is_finite() {
        value.to_string()
    } else {
        String::new()
    }
}

fn optional(value: Option<f64>) -> String {
    value.map_or(String::new(), digits)
}

fn lines(name: String, what: &str, [x, y]: [&Label; 2], curves: &[Curve]) -> Sheet {
    let rows = curves.iter().flat_map(|curve| {
        let row = |[x, y]: &[f64; 2]| vec![curve.name.clone(), digits(*x), digits(*y)];
        curve.points.iter().map(row)
    });
    (
        name,
        [words(&[what]), columns(&[x, y])].concat(),
        rows.collect(),
    )
}

/// The middle of a cell of a row or column.
fn middle([low, high]: [f64; 2], index: usize, of: usize) -> String {
    digits(low + (high - low) * (index as f64 + 0.5) / of.max(1) as f64)
}

fn cells(map: &Map) -> Vec<Vec<String>> {
    let columns = map.columns.max(1);
    let rows = map.cells.len() / columns;
    let cell = |(index, value): (usize, &Option<f64>)| {
        let x = middle(map.x_range, index % columns, columns);
        vec![
            x,
            middle(map.y_range, index / columns, rows),
            optional(*value),
        ]
    };
    map.cells.iter().enumerate().map(cell).collect()
}

fn starts(basin: &Basin) -> Vec<Vec<String>> {
    let columns = basin.columns.max(1);
    let rows = basin.cells.len() / columns;
    let cell = |(index, class): (usize, &u16)| {
        let motion = basin.motions.get(usize::from(*class));
        let x = middle(basin.x_range, index % columns, columns);
        let y = middle(basin.y_range, index / columns, rows);
        vec![
            x,
            y,
            motion.map_or(String::new(), |motion| motion.name.clone()),
        ]
    };
    basin.cells.iter().enumerate().map(cell).collect()
}
