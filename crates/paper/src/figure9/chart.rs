//! The pictures of figure 9: for each motion its time series, phase plane and section (Peterka 2003).

use anyhow::Result;

use super::found::FoundMotion;
use super::{CLEARANCE, SHALLOW};
use crate::figure::Figure;
use crate::path::Path;
use softstop_draw::{Align, Chart, Layer, Panel, Stroke, around, style};
use softstop_explore::palette::line_color;

const FACE: Stroke = Stroke::dashed(style::ASIDE, 1.1, (6.0, 4.0));
/// Every other drive period, and the states of other motions.
const BAND: &str = style::GRID;
const OTHERS: &str = style::FAINT;
/// Points for each drive period, of all of a motion and of what is near the stop; and fewest of an arc.
const FINENESS: [(u32, u32); 2] = [(72, 8), (1440, 8)];
/// Room before the stop near it, in units of the depth beyond it.
const NEAR: f64 = 5.0;
/// More dots than this are many; size of a dot of few, and of many.
const MANY: usize = 64;
const DOTS: (f64, f64) = (4.2, 1.0);

/// The letter of a motion, time in drive periods, position and velocity.
type Sample = (char, [f64; 3]);

/// A page of motions, their time series over so many drive periods; and the points of these.
pub(super) fn page(
    figure: &Figure,
    motions: &[FoundMotion],
    all: &[FoundMotion],
    shown: u64,
) -> Result<(Chart, Vec<Sample>)> {
    let (mut panels, mut points) = (Vec::new(), Vec::new());
    for (row, motion) in motions.iter().enumerate() {
        let path = motion.path(Some(shown), FINENESS[0])?;
        let plane = motion.path(None, FINENESS[0])?.states();
        let near = motion.path(None, FINENESS[1])?.states();
        let period = motion.scene.period();
        let mut own = figure.chart.panels.clone();
        series(motion, &path, shown, period, &mut own[0]);
        let whole = around(plane.iter().map(|at| at.0), 0.1);
        phase_plane(motion, plane, whole, 1.3, &mut own[1]);
        let close = near_stop(&near);
        phase_plane(motion, near, close, 1.1, &mut own[2]);
        own[3].layers = section(motion, all);
        for panel in &mut own {
            panel.at.1 = row;
            // The names of axes across stand in the last row only.
            if row + 1 < motions.len() {
                panel.x.name.clear();
            }
        }
        panels.extend(own);
        let letter = motion.asked.letter;
        let path = path.points.iter();
        points.extend(path.map(|at| (letter, [at.time / period, at.position, at.velocity])));
    }
    let letter = |motion: Option<&FoundMotion>| motion.map_or(' ', |it| it.asked.letter);
    let (first, last) = (letter(motions.first()), letter(motions.last()));
    let chart = Chart {
        title: format!("Fig. 9({first})–({last}): motions of the unloaded machine, ρ = 10"),
        panels,
        ..figure.chart.clone()
    };
    Ok((chart, points))
}

fn color(motion: &FoundMotion) -> &'static str {
    line_color(motion.class())
}

/// The time series, its impacts, and how long it takes to repeat.
fn series(motion: &FoundMotion, path: &Path, shown: u64, period: f64, panel: &mut Panel) {
    let (low, high) = around(path.points.iter().map(|at| at.position), 0.0);
    let y = (1.1 * low, 1.42 * high.max(CLEARANCE));
    let unit = y.1 - y.0;
    let bands = (0..shown).step_by(2);
    let bands = bands.map(|it| [(it as f64, it as f64 + 1.0), y]);
    let points = path.points.iter().map(|at| (at.time / period, at.position));
    let mut layers = vec![
        Layer::boxes(bands, BAND, 0.5),
        Layer::horizontal(CLEARANCE, FACE, ""),
        Layer::line(points, Stroke::solid(color(motion), 1.3)),
    ];
    let [tip, tail] = [0.024, 0.1].map(|share| CLEARANCE + share * unit);
    layers.extend(path.impacts.iter().map(|time| {
        let x = time / period;
        Layer::arrow((x, tail), (x, tip), Stroke::solid(style::INK, 1.2))
    }));
    if let Some(periods) = motion.period().filter(|periods| *periods > 1) {
        let (middle, low) = (0.5 * periods as f64, y.0 + 0.054 * unit);
        let line = Stroke::solid(style::INK, 1.1);
        let name = Layer::text((middle, low), Align::Middle, format!("{periods} T"));
        layers.extend([
            Layer::arrow((middle, low), (0.0, low), line),
            Layer::arrow((middle, low), (periods as f64, low), line),
            name.moved(0.0, 5.0).plated(),
        ]);
    }
    let remark = motion.remark();
    let dash = if remark.is_empty() { "" } else { " — " };
    let (letter, title) = (motion.asked.letter, motion.title());
    panel.title = format!("({letter})  {title}{dash}{remark}");
    panel.x.ends = [0.0, shown as f64].map(Some);
    panel.y.ends = [y.0, y.1].map(Some);
    panel.layers = layers;
}

/// The phase plane over a range of positions.
fn phase_plane(
    motion: &FoundMotion,
    points: Vec<(f64, f64)>,
    x: (f64, f64),
    width: f64,
    panel: &mut Panel,
) {
    let shown = points.iter().filter(|point| point.0 > x.0);
    panel.x = panel.x.clone().range(x);
    panel.y = panel.y.clone().range(around(shown.map(|at| at.1), 0.1));
    let width = if motion.is_chaotic() { 0.45 } else { width };
    let line = Layer::line(points, Stroke::solid(color(motion), width));
    panel.layers = vec![Layer::vertical(CLEARANCE, FACE, ""), line];
}

/// The positions near the stop.
fn near_stop(points: &[(f64, f64)]) -> (f64, f64) {
    let (_, high) = around(points.iter().map(|point| point.0), 0.0);
    let depth = (high - CLEARANCE).max(SHALLOW * CLEARANCE);
    (CLEARANCE - NEAR * depth, CLEARANCE + 1.6 * depth)
}

/// The states at drive angle 0, behind them those of the other motions of the same machine.
fn section(motion: &FoundMotion, all: &[FoundMotion]) -> Vec<Layer> {
    let asked = &motion.asked;
    let coexists = |it: &&FoundMotion| it.asked.letter != asked.letter && it.asked.eta == asked.eta;
    let others = all.iter().filter(coexists).map(|other| (other, OTHERS));
    let all = others.chain([(motion, color(motion))]);
    let layers = all.map(|(motion, color)| {
        let states = &motion.section.states;
        let radius = if states.len() > MANY { DOTS.1 } else { DOTS.0 };
        Layer::dots(states.iter().copied(), radius, color)
    });
    layers.collect()
}
