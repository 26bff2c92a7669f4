//! The data of a report's tables and pictures as CSV, numbers with all their digits.

use softstop_console::column::Cell;
use softstop_console::failure::Failure;
use softstop_console::output;
use softstop_console::record::Record;

use super::data::{
    Basin, Comparison, Curve, ErosionPoint, Histogram, Label, Map, Report, Sensitivity,
};

/// A table: its file's name, its columns, its rows.
struct Sheet {
    name: String,
    head: Vec<String>,
    rows: Vec<Vec<Cell>>,
}

/// A row of cells.
macro_rules! row {
    ($($cell:expr),*) => { vec![$(Cell::from($cell)),*] };
}

/// The files, each with its name and its bytes; those of absent data are left out.
///
/// # Errors
/// If a table cannot be written to memory.
pub fn csv(report: &Report) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let all = sheets(report).into_iter();
    let all = all.filter(|sheet| !sheet.rows.is_empty());
    all.map(|Sheet { name, head, rows }| {
        let head = head.into_iter().map(Cell::from).collect();
        Ok((
            format!("{name}.csv"),
            output::csv([head].into_iter().chain(rows))?,
        ))
    })
    .collect()
}

fn sheets(report: &Report) -> Vec<Sheet> {
    let mut sheets = Vec::from_iter(report.comparison.as_ref().map(comparison));
    sheets.push(requirements(&report.requirements));
    for (map, number) in report.maps.iter().zip(1..) {
        sheets.push(cells(map, format!("map-{number}")));
        let name = format!("map-{number}-boundaries");
        sheets.push(lines(&name, "boundary", [&map.x, &map.y], &map.curves));
    }
    let response = report.response.as_ref();
    sheets.extend(response.map(|it| lines("response", "motion", [&it.x, &it.y], &it.curves)));
    let portrait = report.portrait.as_ref();
    sheets.extend(portrait.map(|it| lines("portrait", "motion", [&it.x, &it.y], &it.curves)));
    sheets.extend(report.basin.as_ref().map(starts));
    sheets.extend(report.erosion.as_ref().map(|it| erosion(&it.points)));
    sheets.extend(report.fronts.iter().map(|it| {
        let rows = it.points.iter().map(|[x, y]| row![*x, *y]);
        sheet(
            &format!("front-{}", it.name),
            columns(&[&it.x, &it.y]),
            rows,
        )
    }));
    sheets.extend(report.histogram.as_ref().map(histogram));
    sheets.push(sensitivities(&report.sensitivities));
    sheets
}

/// A table; what is no number is left empty.
fn sheet(name: &str, head: Vec<String>, rows: impl IntoIterator<Item = Vec<Cell>>) -> Sheet {
    let finite = |cell| match cell {
        Cell::Number(number) if !number.is_finite() => Cell::Empty,
        cell => cell,
    };
    let rows = rows.into_iter();
    Sheet {
        name: name.to_owned(),
        head,
        rows: rows
            .map(|row| row.into_iter().map(finite).collect())
            .collect(),
    }
}

fn words(words: &str) -> Vec<String> {
    words.split_whitespace().map(str::to_owned).collect()
}

fn columns(labels: &[&Label]) -> Vec<String> {
    labels.iter().map(|label| label.line()).collect()
}

fn comparison(of: &Comparison) -> Sheet {
    let head = [words("quantity unit chosen"), of.machines.clone()].concat();
    let rows = of.rows.iter().map(|it| {
        let label = row![&*it.label.name, &*it.label.unit, it.is_chosen.to_string()];
        let values = it.values.iter().copied().map(Cell::from);
        label.into_iter().chain(values).collect()
    });
    sheet("comparison", head, rows)
}

fn requirements(all: &[Record]) -> Sheet {
    let head = words("name meaning unit required value margin met note");
    let cell = |record: &Record, name| match record.cell(name) {
        Some(Cell::Flag(flag)) => Cell::from(flag.to_string()),
        cell => cell.cloned().unwrap_or(Cell::Empty),
    };
    let rows = all.iter();
    let rows = rows.map(|it| head.iter().map(|name| cell(it, name)).collect());
    let rows: Vec<Vec<Cell>> = rows.collect();
    sheet("requirements", head, rows)
}

fn lines(name: &str, what: &str, axes: [&Label; 2], curves: &[Curve]) -> Sheet {
    let rows = curves.iter().flat_map(|curve| {
        let row = |[x, y]: &[f64; 2]| row![&*curve.name, *x, *y];
        curve.points.iter().map(row)
    });
    sheet(name, [words(what), columns(&axes)].concat(), rows)
}

/// The middle of a cell of a row or column.
fn middle([low, high]: [f64; 2], index: usize, of: usize) -> f64 {
    low + (high - low) * (index as f64 + 0.5) / of.max(1) as f64
}

fn cells(map: &Map, name: String) -> Sheet {
    let across = map.columns.max(1);
    let rows = map.cells.len() / across;
    let cells = map.cells.iter().enumerate().map(|(index, value)| {
        let x = middle(map.x_range, index % across, across);
        row![x, middle(map.y_range, index / across, rows), *value]
    });
    sheet(&name, columns(&[&map.x, &map.y, &map.shade]), cells)
}

fn starts(basin: &Basin) -> Sheet {
    let across = basin.columns.max(1);
    let rows = basin.cells.len() / across;
    let cells = basin.cells.iter().enumerate().map(|(index, class)| {
        let x = middle(basin.x_range, index % across, across);
        let y = middle(basin.y_range, index / across, rows);
        let motion = basin.motions.get(usize::from(*class));
        row![x, y, motion.map(|motion| &*motion.name)]
    });
    sheet(
        "basin",
        [columns(&[&basin.x, &basin.y]), words("motion")].concat(),
        cells,
    )
}

fn erosion(points: &[ErosionPoint]) -> Sheet {
    let head = words("place frequency share share_low share_high integrity");
    let rows = points.iter().map(|it| {
        let [low, high] = it.interval;
        row![it.place, it.frequency, it.share, low, high, it.integrity]
    });
    sheet("erosion", head, rows)
}

fn histogram(of: &Histogram) -> Sheet {
    let [low, high] = of.range;
    let step = (high - low) / of.counts.len().max(1) as f64;
    let end = |index: usize| low + step * index as f64;
    let rows = of.counts.iter().enumerate();
    let rows = rows.map(|(index, count)| row![end(index), end(index + 1), *count]);
    let [from, to] = ["from", "to"].map(|end| format!("{end}: {}", of.x.line()));
    sheet("histogram", vec![from, to, "machines".to_owned()], rows)
}

fn sensitivities(all: &[Sensitivity]) -> Sheet {
    let head = words("parameter unit value tolerance effect effect_unit share total margin");
    let rows = all.iter().map(|it| {
        let (name, unit) = (&*it.label.name, &*it.label.unit);
        let effect = row![
            name,
            unit,
            it.value,
            it.tolerance,
            it.effect,
            &*it.effect_unit
        ];
        [effect, row![it.share, it.total, it.margin]].concat()
    });
    sheet("sensitivities", head, rows)
}
