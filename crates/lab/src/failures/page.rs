//! A page of the atlas: a map for each method, the strip of the exact one, the legend.

use crate::methods::Verdict;

use crate::failures::{Atlas, Cell, Map};
use softstop_draw::{Axis, Chart, Layer, Legend, Panel, Sign};

/// Width of a map in pixels, about, and height of the strip of the exact method.
const MAP: f64 = 168.0;
const STRIP: f64 = 18.0;
/// Dashes of the line where a contact is as short as a step.
const DASHES: (f64, f64) = (2.0, 3.0);

/// The page as an SVG document.
pub(super) fn page(atlas: &Atlas) -> String {
    let rows = atlas.maps.chunk_by(|a, b| a.family.row() == b.family.row());
    let rows: Vec<&[Map]> = rows.collect();
    let maps = rows.iter().enumerate().flat_map(|(row, maps)| {
        let maps = maps.iter().enumerate();
        maps.map(move |(column, map)| map_of(atlas, map, (column, row)))
    });
    let exact = exact(atlas, rows.len());
    let (view, percent) = (&atlas.view, 100.0 * atlas.tolerance);
    let plural = if view.periods == 1.0 { "" } else { "s" };
    let below = format!(
        "Each cell is one run: step h as a share of the drive period T, over the stop's stiffness k, for {} \
         drive period{plural}. Errors up to {percent} % of the motion pass.",
        view.periods
    );
    let chart = Chart {
        subtitle: below,
        legend: Legend::Below,
        letters: 12,
        shares_upwards: true,
        ..Chart::new(&view.title, maps.chain([exact]))
    };
    chart.svg()
}

/// The map of a method with the limits that theory sets.
fn map_of(atlas: &Atlas, map: &Map, at: (usize, usize)) -> Panel {
    let contacts = atlas.columns.iter().map(|column| column.contact);
    let limits = map.limit.iter().copied();
    let mut layers = cells(&map.columns);
    layers.extend(at.eq(&(0, 0)).then(|| key(atlas)).into_iter().flatten());
    layers.extend([
        line(atlas, limits, None).named("longest stable step in contact, theory"),
        line(atlas, contacts, Some(DASHES)).named("step as long as the shortest contact"),
    ]);
    Panel {
        title: map.family.title().to_owned(),
        at,
        size: (MAP, MAP),
        x: log_axis("", &atlas.axes.stiffness),
        y: log_axis(&format!("{}: step h/T", map.family.row()), &atlas.axes.step),
        layers,
        ..Panel::default()
    }
}

/// The strip of the exact method, the same for all steps; blank where nothing else knows the true motion.
fn exact(atlas: &Atlas, row: usize) -> Panel {
    let columns = atlas.columns.iter();
    let columns: Vec<Vec<Cell>> = columns.map(|column| Vec::from_iter(column.exact)).collect();
    Panel {
        title: "exact: no step".to_owned(),
        at: (0, row),
        size: (MAP, STRIP),
        x: log_axis("stiffness k (N/m)", &atlas.axes.stiffness),
        y: Axis::bare(),
        layers: cells(&columns),
        ..Panel::default()
    }
}

/// The verdicts, a column for each stiffness.
fn cells(columns: &[Vec<Cell>]) -> Vec<Layer> {
    let steps = columns.iter().map(Vec::len).max().unwrap_or(0);
    let verdict = |step: usize| {
        let cells = columns.iter().map(move |column| column.get(step));
        cells.map(|cell| cell.map_or("#ffffff", |cell| color(cell.verdict)))
    };
    let colors = (0..steps).flat_map(verdict);
    let cells = (steps > 0).then(|| Layer::cells(columns.len(), colors));
    cells.into_iter().collect()
}

/// What the colours mean.
fn key(atlas: &Atlas) -> impl Iterator<Item = Layer> + '_ {
    let occurs = |verdict: Verdict| {
        let mut cells = atlas.maps.iter().flat_map(|map| &map.columns).flatten();
        cells.any(|cell| cell.verdict == verdict)
    };
    let shown = Verdict::ALL.into_iter();
    let shown = shown.filter(move |it| *it != Verdict::Unsuited || occurs(*it));
    shown.map(|verdict| Layer::key(Sign::Patch(color(verdict)), verdict.name()))
}

/// A line of steps over stiffness.
fn line(
    atlas: &Atlas,
    steps: impl Iterator<Item = Option<f64>>,
    dashes: Option<(f64, f64)>,
) -> Layer {
    let steps = steps.map(|step| step.unwrap_or(f64::NAN));
    Layer::contour(atlas.axes.stiffness.iter().copied().zip(steps), dashes)
}

/// A logarithmic axis whose values are the middles of cells.
fn log_axis(name: &str, values: &[f64]) -> Axis {
    let (first, last) = (values[0], values[values.len() - 1]);
    let half = (last / first).powf(0.5 / (values.len() - 1) as f64);
    Axis::new(name).log().range((first / half, last * half))
}

/// The colour of a class of outcomes: blues where the motion is right at least in kind, all others apart from
/// them and from each other in lightness too, so that readers who see no green and red tell them apart.
const fn color(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Converged => "#0072B2",
        Verdict::Inaccurate => "#9CCDEC",
        Verdict::WrongCount => "#F0E442",
        Verdict::MissedContact => "#009E73",
        Verdict::EnergyGain => "#CC6D00",
        Verdict::BlownUp => "#3A3A3A",
        Verdict::Stuck => "#7F3B08",
        Verdict::Unsuited => "#EEEEEE",
    }
}
