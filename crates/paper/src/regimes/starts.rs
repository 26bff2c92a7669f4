//! The hardest periodic motion that starts spread over the plane of states reach. Sweeps do not come upon the
//! motions z = 2/3 and z = (2/4)B, which "belong to impact motion with higher level of kinetic energy" (Peterka
//! 2003, section 4).

use anyhow::Result;
use rayon::prelude::*;
use softstop::{Ratios, Scene, Start};
use softstop_dynamics::attractors::{Arrival, Options, SurveyError, settle};
use softstop_dynamics::internals::evenly;
use softstop_dynamics::points::blocks;
use softstop_dynamics::settled::wanders;
use softstop_dynamics::watch::{Kept, piece};
use softstop_dynamics::{MotionKind, Orbit, StroboscopicMap};

use super::{STARTS, Window};
use softstop_console::interrupt;
use softstop_console::progress::Progress;
use softstop_explore::basin::cells::RegimeMap;

/// Half of the ranges of position and velocity in which starts lie, in units of the clearance.
const REGION: (f64, f64) = (1.5, 2.0);
/// Drive periods before motions are looked at, and the longest period looked for.
const OPTIONS: (u64, usize) = (250, 12);
/// Drive periods in which small differences have to grow in chaos.
const WATCHED: u64 = 64;

/// The map of the hardest periodic motion among those from some starts in each cell.
pub(super) fn hardest(
    machine: &Ratios,
    window: Window,
    (columns, rows): (usize, usize),
    progress: &Progress,
    kept: Kept<'_>,
) -> Result<RegimeMap> {
    let cell = |cell: (usize, usize)| -> Result<MotionKind> {
        let found = of_one(&window.machine(machine, cell, (columns, rows)), STARTS)?;
        progress.steps(STARTS as u64)?;
        Ok(found)
    };
    let cells = (columns * rows) as u64;
    let cells = blocks(0..cells, columns as u64).map(|row| {
        let row = row.start as usize / columns;
        let of = ("hardest", machine, window, (columns, rows), row);
        piece(kept, &of, || {
            let cells = (0..columns).map(|column| cell((column, row)));
            cells.collect::<Result<Vec<MotionKind>>>()
        })
    });
    Ok(RegimeMap {
        eta: window.eta,
        rho: window.rho,
        columns,
        cells: cells.collect::<Result<Vec<_>>>()?.concat(),
    })
}

fn of_one(machine: &Ratios, count: usize) -> Result<MotionKind> {
    let scene = machine.scene()?;
    let options = Options {
        transient: OPTIONS.0,
        longest: OPTIONS.1,
        ..Options::default()
    };
    let starts = starts(machine, count);
    let arrivals = settle(&scene, &starts, &options, &|_, _| interrupt::go_on());
    let arrivals = match arrivals {
        Ok(arrivals) => arrivals,
        Err(SurveyError::Motion(_)) => return Ok(MotionKind::Lost),
        Err(error) => return Err(error.into()),
    };
    let orbits = arrivals.iter().filter_map(|arrival| arrival.orbit.as_ref());
    let hardest = orbits.max_by(|a, b| {
        let velocity = Orbit::before_impact_velocity;
        velocity(a).total_cmp(&velocity(b))
    });
    Ok(match hardest {
        Some(orbit) if orbit.regime().impacts > 0 => MotionKind::of(orbit),
        // Chaos strikes harder than no impact at all.
        rest => wandering(&scene, &arrivals)
            .unwrap_or(rest.map_or(MotionKind::Unsettled, MotionKind::of)),
    })
}

/// Starts that fill the region evenly, the same for all machines.
fn starts(machine: &Ratios, count: usize) -> Vec<Start> {
    let within = |half: f64, share: f64| machine.clearance * half * (2.0 * share - 1.0);
    let start = |index| {
        let [across, up] = evenly([0.0; 2], index);
        Start::new(within(REGION.0, across), within(REGION.1, up))
    };
    (0..count).map(start).collect()
}

/// Chaos, if small differences grow along a motion that has not settled.
fn wandering(scene: &Scene, arrivals: &[Arrival]) -> Option<MotionKind> {
    let mut restless = arrivals.iter().filter(|arrival| arrival.orbit.is_none());
    let map = StroboscopicMap::new(scene, WATCHED).ok()?;
    let grows = |arrival: &Arrival| {
        let motion = wanders(&map, arrival.state);
        motion.is_ok_and(|(motion, _)| motion == MotionKind::Chaos)
    };
    restless.any(grows).then_some(MotionKind::Chaos)
}
