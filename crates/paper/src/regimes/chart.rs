//! The regimes z = p/n over drive frequency and clearance: a page of maps, their tables and findings.

use anyhow::Result;
use softstop_dynamics::continuation::CurvePoint;
use softstop_dynamics::motion_kind::MotionClass;
use softstop_dynamics::{MotionKind, Regime};

use super::{Map, RegimeMap, middle};
use crate::boundaries::Boundaries;
use crate::figure::{Figure, Findings, findings};
use softstop_console::columns;
use softstop_console::export::csv;
use softstop_console::machine::PaperMachine;
use softstop_draw::{Align, Chart, Layer, Mark, style};
use softstop_explore::palette::{motion_color, motion_keys};

/// Where on a map's height the names of curves stand, as a share of it.
const NAMES_AT: f64 = 0.2;
/// eta and rho of the points A and B.
const POINT: (f64, f64) = (1.15, 10.0);
/// Motions whose widest places are named.
const NAMED: [MotionClass; 3] = [MotionClass::Zero, MotionClass::One, MotionClass::TwoThirds];

/// The maps with their boundaries.
pub(super) fn chart(
    figure: &Figure,
    maps: &[RegimeMap<'_>],
    boundaries: &[Boundaries; 2],
) -> Result<Chart> {
    let layers = maps.iter().map(|map| {
        let own = &boundaries[usize::from(map.asked.machine == PaperMachine::Loaded)];
        layers(map, own)
    });
    let mut chart = figure.picture(layers)?;
    for (panel, map) in chart.panels.iter_mut().zip(maps) {
        let [eta, rho] = map.asked.window;
        panel.x.ends = [eta.0, eta.1].map(Some);
        panel.y.ends = [rho.0, rho.1].map(Some);
    }
    let keys = motion_keys(|class| maps.iter().any(|map| map.share(class) > 0.0));
    chart.panels[0].layers.extend(keys);
    Ok(chart)
}

/// A map with its boundaries, the point A or B, and names of wide regimes and of boundaries.
fn layers(map: &RegimeMap<'_>, boundaries: &Boundaries) -> Vec<Layer> {
    let (asked, [eta_range, rho_range]) = (map.asked, map.asked.window);
    let colors = map.cells.iter().map(|cell| motion_color(cell.class()));
    let mut layers = vec![Layer::cells(map.columns, colors)];
    let mut lines = vec![("g₀", boundaries.grazing.clone())];
    lines.extend(boundaries.curves.iter().map(|(name, _, curve)| {
        let points = curve.points.iter().map(|at| at.parameters.into());
        (*name, points.collect())
    }));
    for (name, points) in &lines {
        let dashes = match *name {
            "g₀" => Some((3.0, 4.0)),
            "s_PD" => Some((9.0, 5.0)),
            _ => None,
        };
        layers.push(Layer::contour(points.iter().copied(), dashes));
    }
    let name = |at, name: &str| {
        Layer::text(at, Align::Middle, name)
            .moved(0.0, 6.0)
            .plated()
    };
    let wide = NAMED.into_iter();
    layers.extend(wide.filter_map(|class| Some(name(map.widest(class)?, class.name()))));
    let rho = rho_range.0 + NAMES_AT * (rho_range.1 - rho_range.0);
    for (boundary, points) in &lines {
        let etas = crossings(points, rho);
        let inside = etas.filter(|eta| (eta_range.0..=eta_range.1).contains(eta));
        layers.extend(inside.map(|eta| name((eta, rho), boundary)));
    }
    if (eta_range.0..=eta_range.1).contains(&POINT.0) {
        let spot = Layer::marks([POINT], Mark::Hollow, style::INK);
        layers.extend([spot, name(POINT, asked.machine.point()).moved(18.0, -4.0)]);
    }
    layers
}

/// Where a curve is at this height.
fn crossings(points: &[(f64, f64)], height: f64) -> impl Iterator<Item = f64> {
    points.windows(2).filter_map(move |pair| {
        let (from, to) = (pair[0], pair[1]);
        let crosses = (from.1 < height) != (to.1 < height);
        crosses.then(|| from.0 + (to.0 - from.0) * (height - from.1) / (to.1 - from.1))
    })
}

/// A row for each run of cells of the same motion: from the middle of the first cell to that of the last.
pub(super) fn runs(maps: &[RegimeMap<'_>]) -> Result<Vec<u8>> {
    let columns = columns! { (&Map, f64, [f64; 2], String), it;
        "machine" [None], "unloaded or loaded" => it.0.machine.name();
        "way" [None], "by which the motions are reached" => it.0.names[0].as_str();
        "rho" [None], "clearance" => it.1;
        "eta_from" [None], "lowest drive frequency of the run" => it.2[0];
        "eta_to" [None], "highest one" => it.2[1];
        "motion" [None], "in all of its cells" => it.3.as_str();
    };
    let mut lines = Vec::new();
    for map in maps {
        let rows = map.cells.len() / map.columns;
        let [eta, rho] = map.asked.window;
        for (row, cells) in map.cells.chunks(map.columns).enumerate() {
            let rho = middle(rho, row, rows);
            let mut from = 0;
            for run in cells.chunk_by(|a, b| a == b) {
                let to = from + run.len() - 1;
                let ends = [from, to].map(|column| middle(eta, column, map.columns));
                from = to + 1;
                lines.push((map.asked, rho, ends, run[0].to_string()));
            }
        }
    }
    Ok(csv(&columns, lines)?)
}

/// A row for each point of a boundary.
pub(super) fn boundaries(boundaries: &[Boundaries; 2]) -> Result<Vec<u8>> {
    let columns = columns! { ([&str; 2], usize, [f64; 2], Option<f64>), it;
        "machine" [None], "unloaded or loaded" => it.0[0];
        "boundary" [None], "which one" => it.0[1];
        "curve" [None], "its number, where there are several" => it.1;
        "eta" [None], "drive frequency" => it.2[0];
        "rho" [None], "clearance" => it.2[1];
        "before_impact_velocity" [None], "X'_- of z = 1 there" => it.3;
    };
    let mut lines = Vec::new();
    for (machine, own) in ["unloaded", "loaded"].into_iter().zip(boundaries) {
        let grazing = own.grazing.iter();
        lines.extend(grazing.map(|&(eta, rho)| ([machine, "g0"], 0, [eta, rho], None)));
        lines.extend(own.curves.iter().flat_map(|(name, number, curve)| {
            curve.points.iter().map(move |point| {
                let velocity = Some(point.before_impact_velocity());
                ([machine, *name], *number, point.parameters, velocity)
            })
        }));
    }
    Ok(csv(&columns, lines)?)
}

/// Shares of the maps, and what the boundaries say.
pub(super) fn findings_of(maps: &[RegimeMap<'_>], boundaries: &[Boundaries; 2]) -> Findings {
    let mut findings = Findings::default();
    for map in maps {
        let name = format!("{}, {}", map.asked.machine.name(), map.asked.names[1]);
        for &class in MotionClass::ALL {
            let share = Some(map.share(class)).filter(|share| *share > 0.0);
            findings.add(format!("{name}: share of {}", class.name()), share);
        }
        let two_thirds = Regime {
            impacts: 2,
            periods: 3,
        };
        let is = |cell: &MotionKind| cell.regime() == Some(two_thirds);
        let rows = map.cells.chunks(map.columns);
        let rows = rows.filter(|row| row.iter().any(is)).count() as f64;
        findings.add(format!("{name}: rows with z = 2/3"), rows);
    }
    let ways = [("unloaded", &maps[..2]), ("loaded", &maps[4..])];
    for ((name, ways), own) in ways.into_iter().zip(boundaries) {
        let share = hysteresis(&ways[0], &ways[1]);
        let point = own.hardest();
        findings! { findings, |what| format!("{name}: {what}");
            "share of z = 1 or z = 0 by the way" => share;
            "largest velocity on s_SN" => point.map(CurvePoint::before_impact_velocity);
            "its clearance rho" => point.map(|at| at.parameters[1]);
            "its frequency eta" => point.map(|at| at.parameters[0]);
        }
    }
    findings
}

/// Share of the cells in which one way leads to z = 0 and the other to z = 1.
fn hysteresis(up: &RegimeMap<'_>, down: &RegimeMap<'_>) -> f64 {
    let is = |cell: &MotionKind, class| cell.class() == class;
    let differ = |(a, b): &(&MotionKind, &MotionKind)| {
        let (zero, one) = (MotionClass::Zero, MotionClass::One);
        (is(a, zero) && is(b, one)) || (is(a, one) && is(b, zero))
    };
    let count = up.cells.iter().zip(&down.cells).filter(differ).count();
    count as f64 / up.cells.len() as f64
}
