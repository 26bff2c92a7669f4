//! The map of the regimes z = p/n over drive frequency and clearance, that the paper speaks of at the beginning
//! of its section 3, with its boundaries g0, s_PD and s_SN.

mod boundaries;
mod findings;
mod starts;
mod swept;
mod table;

use anyhow::anyhow;
use softstop::Ratios;
use softstop::sweep::Direction;

use super::{Detail, Drawn, Figure};
use crate::chart::{RegimeMap, RegimePage, RegimePanel};
use crate::failure::Failure;
use crate::progress::Progress;
use boundaries::Boundaries;
use swept::Sweep;

/// Regimes over eta and rho.
pub(super) const FIGURE: Figure = Figure {
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
/// Cells across and up, for print and for a first look.
const CELLS: [(usize, usize); 2] = [(600, 400), (120, 80)];
/// Drive periods at each frequency.
const PERIODS: u64 = 120;
/// Starts at each cell of the map of hardest motions.
const STARTS: [usize; 2] = [12, 8];

/// A part of the plane of eta and rho.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Window {
    eta: (f64, f64),
    rho: (f64, f64),
}

impl Window {
    /// The middle of a column.
    fn eta_at(&self, column: usize, columns: usize) -> f64 {
        middle(self.eta, column, columns)
    }

    /// The middle of a row.
    fn rho_at(&self, row: usize, rows: usize) -> f64 {
        middle(self.rho, row, rows)
    }
}

fn middle((from, to): (f64, f64), cell: usize, cells: usize) -> f64 {
    from + (cell as f64 + 0.5) / cells as f64 * (to - from)
}

fn draw(detail: Detail) -> Result<Drawn, Failure> {
    let size = detail.pick(CELLS[0], CELLS[1]);
    // The map of many starts is half as fine.
    let coarse = (size.0 / 2, size.1 / 2);
    let starts = detail.pick(STARTS[0], STARTS[1]);
    let work = 5 * size.0 * size.1 + coarse.0 * coarse.1 * starts;
    let progress = Progress::new(work as u64, "motions");
    let swept = |machine, window, way| {
        let sweep = Sweep {
            machine,
            window,
            way,
            size,
        };
        sweep.map(&progress)
    };
    let (free, loaded) = (Ratios::unloaded(), Ratios::loaded());
    let maps = [
        swept(free, ALL, Direction::Up)?,
        swept(free, ALL, Direction::Down)?,
        swept(free, ZOOM, Direction::Up)?,
        starts::hardest(&free, ZOOM, coarse, starts, &progress)?,
        swept(loaded, ALL, Direction::Up)?,
        swept(loaded, ALL, Direction::Down)?,
    ];
    drop(progress);
    let boundaries = [Boundaries::of(&free, &ALL)?, Boundaries::of(&loaded, &ALL)?];
    let findings = findings::of(&maps, &boundaries);
    let tables = [table::runs(&maps)?, table::boundaries(&boundaries)?];
    let png = RegimePage::new(panels(maps, &boundaries))
        .png()
        .map_err(|error| anyhow!("cannot draw regimes.png: {error}"))?;
    let [runs, lines] = tables;
    Ok(Drawn {
        files: vec![png, runs, lines],
        findings,
    })
}

/// What the panels are called.
const NAMES: [&str; 6] = [
    "unloaded, rising frequency",
    "unloaded, falling frequency",
    "unloaded, rising frequency: the subharmonic region",
    "unloaded: the hardest periodic motion of 12 starts each",
    "loaded, rising frequency",
    "loaded, falling frequency",
];

fn panels(maps: [RegimeMap; 6], boundaries: &[Boundaries; 2]) -> Vec<RegimePanel> {
    let panel = |(index, (map, name)): (usize, (RegimeMap, &str))| {
        let is_loaded = index >= 4;
        RegimePanel {
            name: name.to_owned(),
            map,
            curves: boundaries[usize::from(is_loaded)].curves(),
            point: (if is_loaded { "B" } else { "A" }, (1.15, 10.0)),
        }
    };
    maps.into_iter().zip(NAMES).enumerate().map(panel).collect()
}
