//! The regimes z = p/n over drive frequency and clearance, as a page of maps.

use anyhow::Result;
use softstop_dynamics::motion::MotionClass;

use super::RegimeMap;
use crate::boundaries::Boundaries;
use crate::figure::Figure;
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
