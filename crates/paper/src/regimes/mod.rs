//! The map of the regimes z = p/n over drive frequency and clearance, with its boundaries g0, s_PD and s_SN.
//! The paper speaks of it at the beginning of its section 3.

mod cells;
mod chart;

use anyhow::{Error, Result};
use serde::Deserialize;
use softstop::{Ratios, Scene, SceneError};
use softstop_console::machine::PaperMachine;
use softstop_dynamics::basin::find_largest_ball;
use softstop_dynamics::motion_kind::MotionClass;
use softstop_dynamics::{Axis, Direction, Grid, MotionKind};

use crate::boundaries::Boundaries;
use crate::figure::{Drawn, Figure, Studio};
use softstop_console::progress::Progress;

/// Drive periods at each frequency of a sweep.
const PERIODS: u64 = 120;
/// Starts at each cell of the map of hardest motions.
const STARTS: usize = 12;
/// Radius of a place, in units of half the map, that has room for its name.
const WIDE: f64 = 0.09;

/// How the motion in a cell is found.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Way {
    /// By a sweep along rising frequencies.
    Up,
    /// By a sweep along falling frequencies.
    Down,
    /// It is the hardest one of several starts.
    Hardest,
}

/// A map.
#[derive(Deserialize)]
struct Map {
    machine: PaperMachine,
    way: Way,
    /// What it is called in tables and among the findings.
    names: [String; 2],
    /// Ranges of eta and rho.
    window: [(f64, f64); 2],
    /// Cells across and up, for print and for a first look.
    sizes: [(usize, usize); 2],
}

impl Map {
    /// The machine in the middle of a cell.
    fn scene(&self, cell: (usize, usize), size: (usize, usize)) -> Result<Scene, SceneError> {
        let machine = self.machine.ratios();
        let machine = machine.at_frequency(middle(self.window[0], cell.0, size.0));
        let machine = machine.at_clearance(middle(self.window[1], cell.1, size.1));
        machine.scene()
    }
}

/// Cells over frequency and clearance.
struct RegimeMap<'a> {
    /// What was asked for.
    asked: &'a Map,
    /// Cells in a row.
    columns: usize,
    /// The cells, row by row, the lowest row first.
    cells: Vec<MotionKind>,
}

impl RegimeMap<'_> {
    /// Share of the cells that belong to a class.
    fn share(&self, class: MotionClass) -> f64 {
        let own = self.cells.iter().filter(|cell| cell.class() == class);
        own.count() as f64 / self.cells.len() as f64
    }

    /// The middle of the widest place of a class, if that is wide.
    fn widest(&self, class: MotionClass) -> Option<(f64, f64)> {
        let rows = self.cells.len() / self.columns;
        let [eta, rho] = self.asked.window;
        let grid = Grid::of_states(
            Axis::position(eta.0, eta.1, self.columns),
            Axis::velocity(rho.0, rho.1, rows),
            0.0,
        );
        let ball = find_largest_ball(&grid, |cell| self.cells[cell].class() == class)?;
        (ball.radius > WIDE).then_some((ball.centre[0], ball.centre[1]))
    }
}

fn middle((from, to): (f64, f64), cell: usize, cells: usize) -> f64 {
    from + (cell as f64 + 0.5) / cells as f64 * (to - from)
}

pub(super) fn draw(studio: &Studio, figure: &Figure) -> Result<Drawn> {
    let maps: Vec<Map> = figure.get("maps")?;
    let found = found(&maps, studio)?;
    let boundaries = [
        Boundaries::of(&Ratios::unloaded())?,
        Boundaries::of(&Ratios::loaded())?,
    ];
    let chart = chart::chart(figure, &found, &boundaries)?;
    let files = [
        chart.png().map_err(Error::msg)?,
        chart::runs(&found)?,
        chart::boundaries(&boundaries)?,
    ];
    Ok(Drawn::new(files, chart::findings_of(&found, &boundaries)))
}

/// The motions in the cells of the maps.
fn found<'a>(maps: &'a [Map], studio: &Studio) -> Result<Vec<RegimeMap<'a>>> {
    let size = |map: &Map| studio.detail.pick(map.sizes[0], map.sizes[1]);
    let work = maps.iter().map(|map| match (map.way, size(map)) {
        (Way::Hardest, (columns, rows)) => STARTS * columns * rows,
        (_, (columns, rows)) => columns * rows,
    });
    let progress = Progress::new(work.sum::<usize>() as u64, "motions");
    let found = maps.iter().map(|map| {
        let (size, kept) = (size(map), studio.kept);
        let cells = match map.way {
            Way::Up => cells::swept(map, Direction::Up, size, &progress, kept)?,
            Way::Down => cells::swept(map, Direction::Down, size, &progress, kept)?,
            Way::Hardest => cells::hardest(map, size, &progress, kept)?,
        };
        Ok(RegimeMap {
            asked: map,
            columns: size.0,
            cells,
        })
    });
    found.collect()
}
