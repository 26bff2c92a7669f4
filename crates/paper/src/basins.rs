//! Basins of attraction of four machines: point A (two planes), near the fold, and three motions at once.

use std::f64::consts::TAU;

use anyhow::{Error, Result};
use serde::Deserialize;
use softstop::{Machine, Ratios, Scene};
use softstop_dynamics::attractors::Attractor;
use softstop_dynamics::basin::{BasinBall, BasinOptions, find_basins};
use softstop_dynamics::{Axis, Basins, Grid, MotionKind, StroboscopicMap};

use crate::figure::{Drawn, Figure, Findings, Studio};
use crate::figure9::section::Section;
use softstop_console::column::Column;
use softstop_console::columns;
use softstop_console::export::csv;
use softstop_console::progress::Progress;
use softstop_draw::{Legend, Panel};
use softstop_explore::basin::chart;

/// Cells on each side.
const CELLS: [usize; 2] = [600, 100];
/// States of chaos that are drawn, after so many drive periods.
const STATES: (u64, u64) = (6000, 500);

/// A plane of starts.
#[derive(Deserialize)]
struct Plane {
    name: String,
    title: String,
    eta: f64,
    /// Range of positions.
    x: [f64; 2],
    /// Range of velocities at drive angle 0; if there is none, starts are at rest at any drive angle.
    v: Option<[f64; 2]>,
}

/// Starts in a range of positions: at drive angle 0 with velocities of another range or, without one, at rest at any drive
/// angle.
pub(super) fn grid(x: [f64; 2], v: Option<[f64; 2]>, cells: usize) -> Grid {
    let position = Axis::position(x[0], x[1], cells);
    let (across, up) = match v {
        Some([low, high]) => (position, Axis::velocity(low, high, cells)),
        None => (Axis::angle(0.0, TAU, cells), position),
    };
    Grid::of_states(across, up, 0.0)
}

pub(super) fn draw(studio: &Studio, figure: &Figure) -> Result<Drawn> {
    let planes: Vec<Plane> = figure.get("planes")?;
    let cells = studio.detail.pick(CELLS[0], CELLS[1]);
    let progress = Progress::new((cells * cells * planes.len()) as u64, "cells");
    let found = planes.iter().map(|plane| {
        let machine = Machine::of_ratios(&Ratios::unloaded().at_frequency(plane.eta))?;
        let (scene, watcher) = (&machine.scene, progress.watcher());
        let grid = grid(plane.x, plane.v, cells);
        let options = BasinOptions::default();
        let basins = find_basins(scene, &grid, &options, &watcher, studio.kept)?;
        let wandering = wandering(scene, &basins)?;
        Ok((plane, machine, basins, wandering))
    });
    let found = found.collect::<Result<Vec<_>>>()?;
    drop(progress);
    let mut chart = figure.chart.clone();
    let panels = found.iter();
    chart
        .panels
        .extend(panels.map(|(plane, machine, basins, wandering)| Panel {
            title: plane.title.clone(),
            legend: Some(Legend::Right),
            ..chart::panel(machine, basins, wandering)
        }));
    let png = chart.in_columns(2).png().map_err(Error::msg)?;
    let basins = found.iter().flat_map(|(plane, _, basins, _)| {
        let classes = basins.classes.iter().enumerate();
        classes.map(move |(index, class)| Basin {
            plane,
            class,
            ball: basins.largest_ball(index),
        })
    });
    let basins: Vec<Basin<'_>> = basins.collect();
    let mut findings = Findings::default();
    for basin in &basins {
        let motion = &basin.class.motion;
        let order = motion.order_beyond_regime();
        let order = order.map_or_else(String::new, |order| format!(" ({order})"));
        let name = format!("{}, {motion}{order}: ", basin.plane.name);
        findings.add_numbers(&name, &columns(), basin);
    }
    Ok(Drawn::new([png, csv(&columns(), &basins)?], findings))
}

/// One of the basins of a plane.
struct Basin<'a> {
    plane: &'a Plane,
    class: &'a Attractor,
    ball: Option<BasinBall>,
}

/// A row for each basin of each plane; numbers that are findings are shown.
fn columns<'a>() -> [Column<Basin<'a>>; 12] {
    columns! { Basin<'a>, it;
        "plane" [None], "which starts" => it.plane.name.as_str();
        "eta" [None], "drive frequency" => it.plane.eta;
        "motion" [None], "on which they settle" => it.class.motion.to_string();
        "impact_pattern" [None], "its impacts in each drive period" => it.class.orbit.as_ref().map(|orbit| orbit.pattern().to_string());
        "before_impact_velocity" [None], "of its hardest impact" => it.class.orbit.as_ref().map(|orbit| orbit.before_impact_velocity());
        "cells" [None], "of the plane" => it.class.starts;
        "share" [None] Plain, "share" => it.class.share;
        "share_low" [None] Plain, "share at least" => it.class.interval[0];
        "share_high" [None] Plain, "share at most" => it.class.interval[1];
        "largest_ball" [None] Plain, "largest ball" => it.ball.map(|ball| ball.radius);
        "ball_across" [None], "its centre" => it.ball.map(|ball| ball.centre[0]);
        "ball_up" [None], "its centre" => it.ball.map(|ball| ball.centre[1]);
    }
}

/// States of chaos at drive angle 0, if a basin is its.
fn wandering(scene: &Scene, basins: &Basins) -> Result<Vec<(f64, f64)>> {
    let mut classes = basins.classes.iter();
    let chaos = classes.position(|class| class.motion == MotionKind::Chaos);
    let mut cells = basins.cells.iter();
    let cell = cells.position(|class| Some(usize::from(*class)) == chaos);
    let Some(cell) = cell else {
        return Ok(Vec::new());
    };
    let (start, _) = basins.grid.start_of_cell(cell);
    let map = StroboscopicMap::new(&scene.check()?, 1);
    let mut states = Section::of(&map, start, STATES.0 + STATES.1, usize::MAX)?.states;
    Ok(states.split_off(STATES.1 as usize))
}
