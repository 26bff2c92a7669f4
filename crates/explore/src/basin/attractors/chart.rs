//! Shares of the attractors over a parameter, one on the other; below them their basins' integrity factors and entropy.

use std::f64::consts::LN_2;

use softstop_draw::style::{self, motion};
use softstop_draw::{Axis, Chart, Layer, Panel, Stroke};
use softstop_dynamics::basin::{BasinsAt, wilson_interval};

use super::GlobalContinuation;
use super::report::{AttractorRow, FollowedAttractor, attractors};
use crate::palette::distinct_colors;

/// Sizes of the panel of shares and of those below it.
const SIZES: [(f64, f64); 2] = [(680.0, 300.0), (680.0, 150.0)];
/// Dashes of the line at ln 2 and of the entropy of boundaries.
const DASHES: (f64, f64) = (5.0, 3.0);
/// How dense an interval is drawn.
const INTERVAL: f64 = 0.4;

/// The chart of all values as an SVG document.
pub(super) fn svg(found: &GlobalContinuation<'_>, rows: &[AttractorRow<'_>]) -> String {
    let named = attractors(rows);
    let first = |it: &FollowedAttractor| {
        let row = rows.iter().find(|row| row.attractor == it.attractor);
        row.map(|row| row.class.motion.class())
    };
    let colors = distinct_colors(named.iter().filter_map(first));
    let mut shares = Vec::new();
    let mut intervals = Vec::new();
    let mut integrities = Vec::new();
    for (report, color) in named.iter().zip(colors) {
        let attractor = report.attractor;
        let name = format!("{attractor}: {}", report.name());
        let cells = found.places.iter().map(|at| stacked(at, attractor));
        let cells: Vec<(f64, [usize; 2], usize)> = cells.collect();
        let ends = cells.iter().map(|(value, ends, all)| {
            let share = |cells: usize| cells as f64 / *all as f64;
            (*value, ends.map(share))
        });
        shares.push(Layer::band(ends, color, 1.0).named(name));
        let top = cells
            .iter()
            .map(|(value, [_, high], all)| (*value, wilson_interval(*high, *all)));
        intervals.push(Layer::band(top, style::PAPER, INTERVAL));
        let own = rows.iter().filter(|row| row.attractor == attractor);
        let own = own.map(|row| (row.at.value, row.ball.map_or(0.0, |it| it.radius)));
        let color = if color == motion::ZERO {
            style::ASIDE
        } else {
            color
        };
        integrities.push(Layer::line(own, Stroke::solid(color, 2.0)));
    }
    shares.extend(intervals);
    let entropies = || found.places.iter().map(|at| (at.value, at.entropy));
    let whole = entropies().map(|(value, it)| (value, it.basin));
    let boundary = entropies().map(|(value, it)| (value, it.boundary.unwrap_or(f64::NAN)));
    let entropy = vec![
        Layer::horizontal(LN_2, Stroke::dashed(style::ASIDE, 1.0, DASHES), "ln 2"),
        Layer::line(whole, Stroke::solid(style::INK, 2.0)).named("of all boxes, S_b"),
        Layer::line(boundary, Stroke::dashed(style::INK, 1.5, DASHES))
            .named("of those on boundaries, S_bb"),
    ];
    let panel = |size, y: Axis, layers: Vec<Layer>| {
        let x = Axis::new(found.machine.label_of(found.parameter));
        Panel::new(x, y, layers).sized(size)
    };
    let share = |name: &str| Axis::new(name).range((0.0, 1.0));
    let [large, small] = SIZES;
    let panels = [
        panel(large, share("share of the starts"), shares),
        panel(small, share("integrity factor"), integrities),
        panel(small, Axis::new("basin entropy"), entropy),
    ];
    let places = found.places.len();
    let cells = found.places[0].basins.cells.len();
    let chart = Chart {
        subtitle: format!("{cells} starts at each of {places} values, with 95 % intervals"),
        shares_x: true,
        ..Chart::new(format!("Attractors of {}", found.title()), panels)
    };
    chart.in_columns(1).svg()
}

/// A value, the cells of all attractors below this one and with it, and of all.
fn stacked(at: &BasinsAt, attractor: usize) -> (f64, [usize; 2], usize) {
    let basins = at.attractors.iter().zip(&at.basins.classes);
    let below = |least: usize| {
        let own = basins.clone().filter(|(it, _)| **it < least);
        own.map(|(_, class)| class.starts).sum()
    };
    (
        at.value,
        [below(attractor), below(attractor + 1)],
        at.basins.cells.len(),
    )
}
