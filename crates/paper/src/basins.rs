//! Basins of attraction of four machines: point A (two planes), near the fold, and three motions at once.

use std::f64::consts::TAU;

use anyhow::{Error, Result};
use softstop::{Ratios, Scene, Start};
use softstop_dynamics::basin::{Options, basins};
use softstop_dynamics::{Axis, Basins, Grid, MotionKind};
use softstop_lanes::{Job, Machine, Watch};

use crate::figure::{self, Drawn, Figure, Findings, Studio};
use softstop_console::interrupt;
use softstop_console::progress::Progress;
use softstop_explore::basin::picture::{BasinPage, BasinPicture};

/// Basins of attraction.
pub(crate) const FIGURE: Figure = Figure {
    title: "Basins of attraction",
    files: &["basins.png", "basins.csv"],
    draw,
};

/// Cells on each side.
const CELLS: [usize; 2] = [600, 100];
/// States of chaos that are drawn, after so many drive periods.
const STATES: (u64, u64) = (6000, 500);

/// One of the planes: name, title, frequency eta, and the axes across and up, whose cells are not yet known.
type Plane = (&'static str, &'static str, f64, [Axis; 2]);

const fn position(from: f64, to: f64) -> Axis {
    Axis::position(from, to, 0)
}

const fn velocity(from: f64, to: f64) -> Axis {
    Axis::velocity(from, to, 0)
}

const PLANES: [Plane; 4] = [
    (
        "A",
        "(a) Point A: η = 1.15, ρ = 10, at drive angle 0",
        1.15,
        [position(-20.0, 20.0), velocity(-20.0, 20.0)],
    ),
    (
        "A, started at rest",
        "(b) Point A, started at rest at X, at any drive angle",
        1.15,
        [Axis::angle(0.0, TAU, 0), position(-20.0, 20.0)],
    ),
    (
        "near the fold",
        "(c) Near the fold: η = 1.3, ρ = 10, at drive angle 0",
        1.3,
        [position(-20.0, 20.0), velocity(-20.0, 20.0)],
    ),
    (
        "coexistence",
        "(d) Three at once: η = 0.9875, ρ = 10, at drive angle 0",
        0.9875,
        [position(5.0, 11.0), velocity(-2.0, 10.0)],
    ),
];

fn draw(studio: &Studio) -> Result<Drawn> {
    let cells = studio.detail.pick(CELLS[0], CELLS[1]);
    let each = (cells * cells) as u64;
    let progress = Progress::new(each * PLANES.len() as u64, "cells");
    let mut found = Vec::new();
    for (index, (_, title, frequency, axes)) in PLANES.into_iter().enumerate() {
        let watcher = |done, _| {
            progress.at(each * index as u64 + done);
            interrupt::go_on()
        };
        let ratios = Ratios::unloaded().at_frequency(frequency);
        let machine = softstop::Machine::of_ratios(&ratios)?;
        let [across, up] = axes.map(|axis| Axis { cells, ..axis });
        let (scene, grid) = (&machine.scene, Grid::states(across, up, 0.0));
        let basins = basins(scene, &grid, &Options::default(), &watcher, studio.kept)?;
        let wandering = wandering(scene, &basins)?;
        found.push((machine, basins, wandering, title));
    }
    drop(progress);
    let pictures = found.iter().map(|(machine, basins, wandering, title)| {
        BasinPicture::new(machine, basins, title).with_wandering(wandering)
    });
    let page = BasinPage {
        pictures: pictures.collect(),
    };
    let png = page.png().map_err(Error::msg)?;
    let basins: Vec<&Basins> = found.iter().map(|found| &found.1).collect();
    Ok(Drawn {
        files: vec![png, table(&basins)?],
        findings: findings(&basins),
    })
}

/// The states of one motion, period by period.
struct Log(Vec<(f64, f64)>);

impl Watch for Log {
    const PERIODS: bool = true;

    fn period(&mut self, _: usize, cycle: u64, state: Start) {
        if cycle >= STATES.1 {
            self.0.push((state.position, state.velocity));
        }
    }
}

/// States of chaos at drive angle 0, if a basin is its.
fn wandering(scene: &Scene, basins: &Basins) -> Result<Vec<(f64, f64)>> {
    let mut classes = basins.classes.iter();
    let chaos = classes.position(|class| class.motion == MotionKind::Chaos);
    let cell = chaos.and_then(|chaos| {
        let mut cells = basins.cells.iter();
        cells.position(|class| usize::from(*class) == chaos)
    });
    let Some(cell) = cell else {
        return Ok(Vec::new());
    };
    let machine = Machine::new(scene)?;
    let job = Job {
        machine: 0,
        start: basins.grid.start(cell).0,
        periods: STATES.0 + STATES.1,
    };
    let mut log = Log(Vec::new());
    softstop_lanes::run(&[machine], &[job], &mut log);
    Ok(log.0)
}

/// The basins of all planes with their numbers, and name and frequency of the plane.
fn classes<'a>(all: &'a [&Basins]) -> impl Iterator<Item = (&'static str, f64, &'a Basins, usize)> {
    let planes = PLANES.iter().zip(all);
    planes.flat_map(|((name, _, frequency, _), basins)| {
        (0..basins.classes.len()).map(|index| (*name, *frequency, *basins, index))
    })
}

/// A row for each basin of each plane.
fn table(all: &[&Basins]) -> Result<Vec<u8>> {
    let columns = "plane,eta,motion,impact_pattern,before_impact_velocity,cells,share,share_low,share_high,\
        largest_ball,ball_across,ball_up";
    let rows = classes(all).map(|(plane, frequency, basins, index)| {
        let (class, ball) = (&basins.classes[index], basins.largest_ball(index));
        let orbit = class.orbit.as_ref();
        (
            (plane, frequency, class.motion.to_string()),
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
fn findings(all: &[&Basins]) -> Findings {
    let mut findings = Findings::default();
    for (plane, _, basins, index) in classes(all) {
        let (class, ball) = (&basins.classes[index], basins.largest_ball(index));
        let order = class.motion.told_order();
        let order = order.map_or_else(String::new, |order| format!(" ({order})"));
        let mut add = |what: &str, value: Option<f64>| {
            findings.add(format!("{plane}, {}{order}: {what}", class.motion), value);
        };
        add("share", Some(class.share));
        add("share at least", Some(class.interval[0]));
        add("share at most", Some(class.interval[1]));
        add("largest ball", ball.map(|ball| ball.radius));
    }
    findings
}
