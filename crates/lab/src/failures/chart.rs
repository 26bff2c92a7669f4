//! A page of the atlas: a map of verdicts for each method with the limits that theory sets, and the strip of the exact one.

use softstop_draw::{Axis, Chart, Layer, Legend, Panel, Sign, power_of_ten, style};

use super::{Atlas, Map};
use crate::methods::Verdict;

/// Maps beside each other.
const COLUMNS: usize = 3;
/// Width of a map in pixels, about, and height of the strip of the exact method.
const MAP: f64 = 168.0;
const STRIP: f64 = 18.0;
/// Dashes of the line where a contact is as short as a step.
const DASHES: Option<(f64, f64)> = Some((2.0, 3.0));

/// The page.
pub(super) fn chart(atlas: &Atlas) -> Chart {
    let (case, percent) = (&atlas.case, 100.0 * atlas.tolerance);
    let periods = case.periods;
    let plural = if periods == 1.0 { "" } else { "s" };
    let rows = atlas.maps.chunk_by(|a, b| a.family.row() == b.family.row());
    let rows = rows.flat_map(|maps| maps.chunks(COLUMNS));
    let maps = rows.clone().enumerate().flat_map(|(row, maps)| {
        let column = move |(column, own)| Panel {
            at: (column, row),
            ..map(atlas, own)
        };
        maps.iter().enumerate().map(column)
    });
    let exact = Panel {
        at: (0, rows.count()),
        ..exact(atlas)
    };
    Chart {
        subtitle: format!(
            "Each cell is one run: step h as a share of the drive period T, over the stop's stiffness k, for {periods} \
             drive period{plural}. Errors up to {percent} % of the motion pass."
        ),
        legend: Legend::Below,
        letters: 13,
        shares_y: true,
        ..Chart::new(&case.title, maps.chain([exact]))
    }
}

fn map(atlas: &Atlas, map: &Map) -> Panel {
    let (stiffness, step) = (&atlas.axes.stiffness, &atlas.axes.step);
    let size = |cells: usize| (MAP / stiffness.len() as f64).round().max(1.0) * cells as f64;
    let row = |row: usize| {
        map.columns
            .iter()
            .map(move |cells| cells[row].verdict.color())
    };
    let line = |steps: Vec<Option<f64>>, dashes| {
        let points = stiffness.iter().zip(steps);
        Layer::contour(
            points.map(|(k, step)| (*k, step.unwrap_or(f64::NAN))),
            dashes,
        )
    };
    let contacts = atlas.columns.iter().map(|column| column.contact).collect();
    let cells = Layer::cells(stiffness.len(), (0..step.len()).flat_map(row));
    let lines = [
        line(map.limit.clone(), None).named("longest stable step in contact, theory"),
        line(contacts, DASHES).named("step as long as the shortest contact"),
    ];
    let up = axis(&format!("{}: step h/T", map.family.row()), step, 1);
    let layers = [cells].into_iter().chain(keys(atlas)).chain(lines);
    let panel = Panel::new(axis("", stiffness, 2), up, layers);
    Panel {
        title: map.family.title().to_owned(),
        ..panel.sized((size(stiffness.len()), size(step.len())))
    }
}

/// The strip of the exact method, alike for all steps; blank where nothing else knows the true motion.
fn exact(atlas: &Atlas) -> Panel {
    let stiffness = &atlas.axes.stiffness;
    let cells = atlas.columns.iter().map(|column| column.exact);
    let colors = cells.map(|cell| cell.map_or(style::PAPER, |cell| cell.verdict.color()));
    let across = axis("stiffness k (N/m)", stiffness, 2);
    let cells = Layer::cells(stiffness.len(), colors);
    Panel {
        title: "exact: no step".to_owned(),
        ..Panel::new(across, Axis::bare().range((0.0, 1.0)), [cells]).sized((MAP, STRIP))
    }
}

/// The logarithmic axis of cells around these values; every so many powers of ten have their number.
fn axis(name: &str, values: &[f64], each: i32) -> Axis {
    let (first, last) = (values[0], values[values.len() - 1]);
    let half = (last / first).powf(0.5 / (values.len() - 1) as f64);
    let (low, high) = (first / half, last * half);
    let powers = low.log10().ceil() as i32..=high.log10().floor() as i32;
    let text = |power: i32| match power % each {
        0 => power_of_ten(power),
        _ => String::new(),
    };
    let ticks = powers.map(|power| (10_f64.powi(power), text(power)));
    Axis::new(name).log().range((low, high)).ticks(ticks)
}

/// What the colours mean; a method that is unsuited is explained where there is one.
fn keys(atlas: &Atlas) -> impl Iterator<Item = Layer> {
    let mut cells = atlas.maps.iter().flat_map(|map| &map.columns).flatten();
    let unsuited = cells.any(|cell| cell.verdict == Verdict::Unsuited);
    let shown = Verdict::ALL.into_iter();
    let shown = shown.filter(move |verdict| unsuited || *verdict != Verdict::Unsuited);
    shown.map(|verdict| Layer::key(Sign::Patch(verdict.color()), verdict.name()))
}
