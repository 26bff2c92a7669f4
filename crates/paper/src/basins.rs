//! Basins of attraction of four machines: point A (two planes), near the fold, and three motions at once.

use std::f64::consts::TAU;

use anyhow::{Error, Result};
use softstop::{Ratios, Scene, Start};
use softstop_dynamics::basin::{Axis, Basins, Grid, Options, basins_watched};
use softstop_dynamics::motion::MotionKind;
use softstop_lanes::{Job, Machine, Watch};

use crate::figure::{self, Drawn, Figure, Studio};
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

/// One of the planes.
struct Plane {
    name: &'static str,
    title: &'static str,
    frequency: f64,
    across: Axis,
    up: Axis,
}

/// A range of an axis whose cells are not yet known.
const fn position(from: f64, to: f64) -> Axis {
    Axis::position(from, to, 0)
}

const fn velocity(from: f64, to: f64) -> Axis {
    Axis::velocity(from, to, 0)
}

const PLANES: [Plane; 4] = [
    Plane {
        name: "A",
        title: "(a) Point A: η = 1.15, ρ = 10, at drive angle 0",
        frequency: 1.15,
        across: position(-20.0, 20.0),
        up: velocity(-20.0, 20.0),
    },
    Plane {
        name: "A, started at rest",
        title: "(b) Point A, started at rest at X, at any drive angle",
        frequency: 1.15,
        across: Axis::angle(0.0, TAU, 0),
        up: position(-20.0, 20.0),
    },
    Plane {
        name: "near the fold",
        title: "(c) Near the fold: η = 1.3, ρ = 10, at drive angle 0",
        frequency: 1.3,
        across: position(-20.0, 20.0),
        up: velocity(-20.0, 20.0),
    },
    Plane {
        name: "coexistence",
        title: "(d) Three at once: η = 0.9875, ρ = 10, at drive angle 0",
        frequency: 0.9875,
        across: position(5.0, 11.0),
        up: velocity(-2.0, 10.0),
    },
];

impl Plane {
    fn machine(&self) -> Result<softstop::Machine> {
        let ratios = Ratios::unloaded().at_frequency(self.frequency);
        Ok(softstop::Machine::of_ratios(&ratios)?)
    }

    fn grid(&self, cells: usize) -> Grid {
        let with = |axis: Axis| Axis { cells, ..axis };
        Grid::states(with(self.across), with(self.up), 0.0)
    }
}

fn draw(studio: &Studio) -> Result<Drawn> {
    let detail = studio.detail;
    let cells = detail.pick(CELLS[0], CELLS[1]);
    let each = (cells * cells) as u64;
    let progress = Progress::new(each * PLANES.len() as u64, "cells");
    let mut found = Vec::new();
    for (index, plane) in PLANES.iter().enumerate() {
        let watcher = |done, _| {
            progress.at(each * index as u64 + done);
            interrupt::go_on()
        };
        let machine = plane.machine()?;
        let scene = &machine.scene;
        let basins = basins_watched(scene, &plane.grid(cells), &Options::default(), &watcher)?;
        let wandering = wandering(scene, &basins)?;
        found.push((machine, basins, wandering));
    }
    drop(progress);
    let mut pictures = Vec::new();
    for (plane, (machine, basins, wandering)) in PLANES.iter().zip(&found) {
        let picture = BasinPicture::new(machine, basins, plane.title);
        pictures.push(picture.with_wandering(wandering));
    }
    let png = BasinPage { pictures }.png().map_err(Error::msg)?;
    let basins: Vec<&Basins> = found.iter().map(|(_, basins, _)| basins).collect();
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

/// A row for each basin of each plane.
fn table(all: &[&Basins]) -> Result<Vec<u8>> {
    let columns = "plane,eta,motion,impact_pattern,before_impact_velocity,cells,share,share_low,share_high,\
        largest_ball,ball_across,ball_up";
    let rows = PLANES.iter().zip(all).flat_map(|(plane, basins)| {
        basins
            .classes
            .iter()
            .enumerate()
            .map(move |(index, class)| {
                let orbit = class.orbit.as_ref();
                let ball = basins.largest_ball(index);
                (
                    plane.name,
                    plane.frequency,
                    class.motion.to_string(),
                    orbit.map(|orbit| orbit.pattern().to_string()),
                    orbit.map(|orbit| orbit.before_impact_velocity()),
                    class.cells,
                    class.share,
                    class.interval,
                    ball.map(|ball| ball.radius),
                    ball.map(|ball| ball.centre[0]),
                    ball.map(|ball| ball.centre[1]),
                )
            })
    });
    figure::table(columns, rows)
}

/// Shares with their intervals, and the largest balls.
fn findings(all: &[&Basins]) -> Vec<(String, f64)> {
    let mut findings = Vec::new();
    for (plane, basins) in PLANES.iter().zip(all) {
        for (index, class) in basins.classes.iter().enumerate() {
            let name = match class.motion.told_order() {
                Some(order) => format!("{}, {} ({order})", plane.name, class.motion),
                None => format!("{}, {}", plane.name, class.motion),
            };
            findings.push((format!("{name}: share"), class.share));
            findings.push((format!("{name}: share at least"), class.interval[0]));
            findings.push((format!("{name}: share at most"), class.interval[1]));
            if let Some(ball) = basins.largest_ball(index) {
                findings.push((format!("{name}: largest ball"), ball.radius));
            }
        }
    }
    findings
}
