//! The map of the regimes z = p/n over drive frequency and clearance, with its boundaries g0, s_PD and s_SN.
//! The paper speaks of it at the beginning of its section 3.

mod boundaries;
mod chart;
mod report;
mod starts;
mod swept;

use anyhow::{Error, Result};
use serde::Serialize;
use softstop::Ratios;
use softstop_dynamics::Direction;
use softstop_dynamics::watch::Kept;

use crate::figure::{Detail, Drawn, Figure, Studio};
use boundaries::Boundaries;
use softstop_console::progress::Progress;
use softstop_explore::basin::cells::RegimeMap;
use swept::Sweep;

/// Regimes over eta and rho.
pub(crate) const FIGURE: Figure = Figure {
    title: "Regimes over eta and rho, and their boundaries g0, s_PD, s_SN",
    files: &["regimes.png", "regimes.csv", "regimes-boundaries.csv"],
    draw,
};

/// The paper's range of frequencies, and clearances up to the resonance peak of the free motion, 25.005.
const ALL: Window = Window {
    eta: (0.8, 1.8),
    rho: (0.0, 24.0),
};
/// Where subharmonic and chaotic motions are.
const ZOOM: Window = Window {
    eta: (0.9, 1.02),
    rho: (4.0, 24.0),
};
/// Cells across and up, for print and for a first look: whole pixels each. The loaded machine costs more.
const FREE: [(usize, usize); 2] = [(400, 400), (100, 80)];
const NEAR: [(usize, usize); 2] = [(600, 400), (120, 80)];
const LOADED: [(usize, usize); 2] = [(300, 200), (60, 40)];
/// Those of the map of hardest motions.
const MANY: [(usize, usize); 2] = [(240, 160), (60, 40)];
/// Drive periods at each frequency.
const PERIODS: u64 = 120;
/// Starts at each cell of the map of hardest motions.
const STARTS: usize = 12;

/// What a map is called in tables, among the findings and on the page.
struct Named {
    machine: &'static str,
    way: &'static str,
    finding: &'static str,
    page: &'static str,
}

macro_rules! named {
    ($($machine:literal $way:literal, $finding:literal, $page:literal;)*) => {
        [$(Named {
            machine: $machine,
            way: $way,
            finding: $finding,
            page: concat!($machine, $page),
        }),*]
    };
}

const MAPS: [Named; 6] = named! {
    "unloaded" "up", "rising", ", rising frequency";
    "unloaded" "down", "falling", ", falling frequency";
    "unloaded" "up, zoom", "zoom, rising", ", rising frequency: the subharmonic region";
    "unloaded" "hardest of several starts", "zoom, hardest of several starts",
        ": the hardest motion of 12 starts";
    "loaded" "up", "rising", ", rising frequency";
    "loaded" "down", "falling", ", falling frequency";
};

/// Whether a map is of the loaded machine.
fn is_loaded(map: usize) -> bool {
    map >= 4
}

/// A part of the plane of eta and rho.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct Window {
    eta: (f64, f64),
    rho: (f64, f64),
}

impl Window {
    /// The machine in the middle of a cell.
    fn machine(&self, machine: &Ratios, cell: (usize, usize), cells: (usize, usize)) -> Ratios {
        let machine = machine.at_frequency(middle(self.eta, cell.0, cells.0));
        machine.at_clearance(middle(self.rho, cell.1, cells.1))
    }
}

fn middle((from, to): (f64, f64), cell: usize, cells: usize) -> f64 {
    from + (cell as f64 + 0.5) / cells as f64 * (to - from)
}

fn draw(studio: &Studio) -> Result<Drawn> {
    let (detail, kept) = (studio.detail, studio.kept);
    let (maps, boundaries) = rayon::join(|| maps(detail, kept), boundaries);
    let (maps, boundaries) = (maps?, boundaries?);
    let png = chart::png(&maps, &boundaries).map_err(Error::msg)?;
    Ok(Drawn {
        files: vec![png, report::runs(&maps)?, report::boundaries(&boundaries)?],
        findings: report::findings(&maps, &boundaries),
    })
}

/// The maps.
fn maps(detail: Detail, kept: Kept<'_>) -> Result<[RegimeMap; 6]> {
    let [all, near, many, less] =
        [FREE, NEAR, MANY, LOADED].map(|[full, draft]| detail.pick(full, draft));
    let cells = |size: (usize, usize)| size.0 * size.1;
    let work = 2 * cells(all) + cells(near) + STARTS * cells(many) + 2 * cells(less);
    let progress = Progress::new(work as u64, "motions");
    let swept = |machine, window, way, size| {
        let sweep = Sweep {
            machine,
            window,
            way,
            size,
        };
        sweep.map(&progress, kept)
    };
    let (free, loaded) = (Ratios::unloaded(), Ratios::loaded());
    Ok([
        swept(free, ALL, Direction::Up, all)?,
        swept(free, ALL, Direction::Down, all)?,
        swept(free, ZOOM, Direction::Up, near)?,
        starts::hardest(&free, ZOOM, many, &progress, kept)?,
        swept(loaded, ALL, Direction::Up, less)?,
        swept(loaded, ALL, Direction::Down, less)?,
    ])
}

/// The boundaries of both machines.
fn boundaries() -> Result<[Boundaries; 2]> {
    let [free, loaded] = [Ratios::unloaded(), Ratios::loaded()];
    Ok([Boundaries::of(&free, &ALL)?, Boundaries::of(&loaded, &ALL)?])
}
