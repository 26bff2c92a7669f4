//! The map of the regimes z = p/n over drive frequency and clearance, with its boundaries g0, s_PD and s_SN.
//! The paper speaks of it at the beginning of its section 3.

mod chart;
mod report;
mod starts;
mod swept;

use anyhow::{Error, Result};
use softstop::{Ratios, Scene, SceneError};
use softstop_dynamics::Direction;

use crate::boundaries::Boundaries;
use crate::figure::{Drawn, Figure, Studio};
use softstop_console::progress::Progress;
use softstop_explore::basin::cells::RegimeMap;

/// Regimes over eta and rho.
pub(crate) const FIGURE: Figure = Figure {
    title: "Regimes over eta and rho, and their boundaries g0, s_PD, s_SN",
    files: &["regimes.png", "regimes.csv", "regimes-boundaries.csv"],
    draw,
};

/// Ranges of eta and rho.
type Window = [(f64, f64); 2];

/// The paper's range of frequencies, and clearances up to the resonance peak of the free motion, 25.005.
const ALL: Window = [(0.8, 1.8), (0.0, 24.0)];
/// Where subharmonic and chaotic motions are.
const ZOOM: Window = [(0.9, 1.02), (4.0, 24.0)];
/// Least clearance of the boundaries: at 0 the scale of the motion changes.
const LEAST: f64 = 0.1;
/// Drive periods at each frequency of a sweep.
const PERIODS: u64 = 120;
/// Starts at each cell of the map of hardest motions.
const STARTS: usize = 12;

/// How the motion in a cell is found.
#[derive(Debug, Clone, Copy)]
enum Way {
    /// By a sweep along the frequency.
    Swept(Direction),
    /// It is the hardest one of several starts.
    Hardest,
}

/// A map: what it is called in tables, among the findings and on the page, and what it shows.
struct Map {
    is_loaded: bool,
    way: Way,
    names: [&'static str; 3],
    window: Window,
    /// Cells across and up, for print and for a first look: whole pixels each. The loaded machine costs more.
    sizes: [(usize, usize); 2],
}

const fn map(
    is_loaded: bool,
    way: Way,
    names: [&'static str; 3],
    window: Window,
    sizes: [(usize, usize); 2],
) -> Map {
    Map {
        is_loaded,
        way,
        names,
        window,
        sizes,
    }
}

const FREE: [(usize, usize); 2] = [(400, 400), (100, 80)];
const NEAR: [(usize, usize); 2] = [(600, 400), (120, 80)];
const MANY: [(usize, usize); 2] = [(240, 160), (60, 40)];
const LOADED: [(usize, usize); 2] = [(300, 200), (60, 40)];
const UP: Way = Way::Swept(Direction::Up);
const DOWN: Way = Way::Swept(Direction::Down);
const RISING: [&str; 3] = ["up", "rising", ", rising frequency"];
const FALLING: [&str; 3] = ["down", "falling", ", falling frequency"];
const CLOSER: [&str; 3] = [
    "up, zoom",
    "zoom, rising",
    ", rising frequency: the subharmonic region",
];
const HARDEST: [&str; 3] = [
    "hardest of several starts",
    "zoom, hardest of several starts",
    ": the hardest motion of 12 starts",
];

static MAPS: [Map; 6] = [
    map(false, UP, RISING, ALL, FREE),
    map(false, DOWN, FALLING, ALL, FREE),
    map(false, UP, CLOSER, ZOOM, NEAR),
    map(false, Way::Hardest, HARDEST, ZOOM, MANY),
    map(true, UP, RISING, ALL, LOADED),
    map(true, DOWN, FALLING, ALL, LOADED),
];

impl Map {
    fn machine(&self) -> &'static str {
        if self.is_loaded { "loaded" } else { "unloaded" }
    }

    /// The machine in the middle of a cell.
    fn scene(&self, cell: (usize, usize), size: (usize, usize)) -> Result<Scene, SceneError> {
        let machine = match self.is_loaded {
            false => Ratios::unloaded(),
            true => Ratios::loaded(),
        };
        let machine = machine.at_frequency(middle(self.window[0], cell.0, size.0));
        let machine = machine.at_clearance(middle(self.window[1], cell.1, size.1));
        machine.scene()
    }
}

fn middle((from, to): (f64, f64), cell: usize, cells: usize) -> f64 {
    from + (cell as f64 + 0.5) / cells as f64 * (to - from)
}

fn draw(studio: &Studio) -> Result<Drawn> {
    let maps = maps(studio)?;
    let boundaries = |machine| Boundaries::of(&machine, ALL[0], (LEAST, ALL[1].1));
    let boundaries = [
        boundaries(Ratios::unloaded())?,
        boundaries(Ratios::loaded())?,
    ];
    let chart = chart::chart(&maps, &boundaries);
    Ok(Drawn {
        files: vec![
            chart.png().map_err(Error::msg)?,
            report::runs(&maps)?,
            report::boundaries(&boundaries)?,
        ],
        findings: report::findings(&maps, &boundaries),
    })
}

/// The maps.
fn maps(studio: &Studio) -> Result<Vec<RegimeMap>> {
    let size = |map: &Map| studio.detail.pick(map.sizes[0], map.sizes[1]);
    let work = MAPS.iter().map(|map| match (map.way, size(map)) {
        (Way::Swept(_), (columns, rows)) => columns * rows,
        (Way::Hardest, (columns, rows)) => STARTS * columns * rows,
    });
    let progress = Progress::new(work.sum::<usize>() as u64, "motions");
    let found = MAPS.iter().map(|map| {
        let size = size(map);
        let cells = match map.way {
            Way::Swept(way) => swept::cells(map, way, size, &progress, studio.kept)?,
            Way::Hardest => starts::cells(map, size, &progress, studio.kept)?,
        };
        Ok(RegimeMap {
            eta: map.window[0],
            rho: map.window[1],
            columns: size.0,
            cells,
        })
    });
    found.collect()
}
