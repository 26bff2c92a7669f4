//! Basins of attraction of four machines: point A (two planes), near the fold, and three motions at once.

use std::f64::consts::TAU;

use anyhow::{Error, Result};
use serde::Deserialize;
use softstop::{Machine, Ratios, Scene};
use softstop_dynamics::basin::{Options, basins};
use softstop_dynamics::{Axis, Basins, Grid, MotionKind, StroboscopicMap};

use crate::figure::{self, Drawn, Figure, Findings, Studio};
use crate::figure9::section::Section;
use softstop_console::progress::Progress;
use softstop_draw::{Chart, Legend, Panel};
use softstop_explore::basin::chart;

/// Cells on each side.
const CELLS: [usize; 2] = [600, 100];
/// States of chaos that are drawn, after so many drive periods.
const STATES: (u64, u64) = (6000, 500);

#[derive(Deserialize)]
struct What {
    planes: Vec<Plane>,
}

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

impl Plane {
    fn grid(&self, cells: usize) -> Grid {
        let position = Axis::position(self.x[0], self.x[1], cells);
        let (across, up) = match self.v {
            Some([low, high]) => (position, Axis::velocity(low, high, cells)),
            None => (Axis::angle(0.0, TAU, cells), position),
        };
        Grid::states(across, up, 0.0)
    }
}

pub(super) fn draw(studio: &Studio, figure: &Figure) -> Result<Drawn> {
    let planes = figure.what::<What>()?.planes;
    let cells = studio.detail.pick(CELLS[0], CELLS[1]);
    let progress = Progress::new((cells * cells * planes.len()) as u64, "cells");
    let found = planes.iter().map(|plane| {
        let machine = Machine::of_ratios(&Ratios::unloaded().at_frequency(plane.eta))?;
        let (scene, watcher) = (&machine.scene, progress.watcher());
        let grid = plane.grid(cells);
        let basins = basins(scene, &grid, &Options::default(), &watcher, studio.kept)?;
        let wandering = wandering(scene, &basins)?;
        Ok((plane, machine, basins, wandering))
    });
    let found = found.collect::<Result<Vec<_>>>()?;
    drop(progress);
    let panels = found
        .iter()
        .map(|(plane, machine, basins, wandering)| Panel {
            title: plane.title.clone(),
            legend: Some(Legend::Right),
            ..chart::panel(machine, basins, wandering)
        });
    let title = "Basins of attraction: which start leads to which motion";
    let chart = Chart {
        letters: 17,
        ..Chart::new(title, panels)
    };
    let png = chart.in_columns(2).png().map_err(Error::msg)?;
    let basins = found.iter().flat_map(|(plane, _, basins, _)| {
        (0..basins.classes.len()).map(move |index| (*plane, basins, index))
    });
    let basins: Vec<Basin<'_>> = basins.collect();
    Ok(Drawn {
        files: vec![png, table(&basins)?],
        findings: findings(&basins),
    })
}

/// One of the basins of a plane, by its number.
type Basin<'a> = (&'a Plane, &'a Basins, usize);

/// States of chaos at drive angle 0, if a basin is its.
fn wandering(scene: &Scene, basins: &Basins) -> Result<Vec<(f64, f64)>> {
    let mut classes = basins.classes.iter();
    let chaos = classes.position(|class| class.motion == MotionKind::Chaos);
    let mut cells = basins.cells.iter();
    let cell = cells.position(|class| Some(usize::from(*class)) == chaos);
    let Some(cell) = cell else {
        return Ok(Vec::new());
    };
    let (start, _) = basins.grid.start(cell);
    let map = StroboscopicMap::new(scene, 1)?;
    let mut states = Section::of(&map, start, STATES.0 + STATES.1, usize::MAX)?.states;
    Ok(states.split_off(STATES.1 as usize))
}

/// A row for each basin of each plane.
fn table(all: &[Basin<'_>]) -> Result<Vec<u8>> {
    let columns = "plane,eta,motion,impact_pattern,before_impact_velocity,cells,share,share_low,share_high,\
        largest_ball,ball_across,ball_up";
    let rows = all.iter().map(|(plane, basins, index)| {
        let (class, ball) = (&basins.classes[*index], basins.largest_ball(*index));
        let orbit = class.orbit.as_ref();
        (
            (&plane.name, plane.eta, class.motion.to_string()),
            orbit.map(|orbit| orbit.pattern().to_string()),
            orbit.map(|orbit| orbit.before_impact_velocity()),
            (class.cells, class.share, class.interval),
            ball.map(|ball| ball.radius),
            ball.map(|ball| ball.centre[0]),
            ball.map(|ball| ball.centre[1]),
        )
    });
    figure::table(columns, rows)
}

/// Shares with their intervals, and the largest balls.
fn findings(all: &[Basin<'_>]) -> Findings {
    let mut findings = Findings::default();
    for (plane, basins, index) in all {
        let (class, ball) = (&basins.classes[*index], basins.largest_ball(*index));
        let order = class.motion.told_order();
        let order = order.map_or_else(String::new, |order| format!(" ({order})"));
        let name = format!("{}, {}{order}: ", plane.name, class.motion);
        findings.group(
            &name,
            [
                ("share", Some(class.share)),
                ("share at least", Some(class.interval[0])),
                ("share at most", Some(class.interval[1])),
                ("largest ball", ball.map(|ball| ball.radius)),
            ],
        );
    }
    findings
}
