//! The motion in each cell of a map: that of a sweep along the frequency, or the hardest periodic one that starts spread
//! over the plane of states reach. Sweeps do not come upon the motions z = 2/3 and z = (2/4)B, which "belong to impact
//! motion with higher level of kinetic energy" (Peterka 2003, section 4).

use anyhow::Result;
use rayon::prelude::*;
use softstop::{Parameter, Scene, Start};
use softstop_dynamics::attractors::{Arrival, SearchOptions, settle_starts};
use softstop_dynamics::internals::evenly_spread_point;
use softstop_dynamics::monitor::{OptionalMemory, recall_or_compute};
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::parallel::parallel_blocks;
use softstop_dynamics::settled::classify_wandering;
use softstop_dynamics::{Chain, Direction, MotionKind, Orbit, Plan, StroboscopicMap};

use super::{Map, PERIODS, STARTS, middle};
use crate::diagram;
use softstop_console::interrupt;
use softstop_console::progress::Progress;

/// Frequencies before the first column, in which the motion settles from rest.
const AHEAD: usize = 6;
/// Half of the ranges of position and velocity in which starts lie, in units of the clearance.
const REGION: (f64, f64) = (1.5, 2.0);
/// Drive periods before motions are looked at, and the longest period looked for.
const OPTIONS: (u64, usize) = (250, 12);
/// Drive periods in which small differences have to grow in chaos.
const WATCHED: u64 = 64;

/// The regime of a sweep in each cell.
pub(super) fn swept(
    map: &Map,
    way: Direction,
    size: (usize, usize),
    progress: &Progress,
    kept: OptionalMemory<'_>,
) -> Result<Vec<MotionKind>> {
    let (columns, rows) = size;
    let [first, last] = [0, columns - 1].map(|column| middle(map.window[0], column, columns));
    let ahead = AHEAD as f64 * (last - first) / (columns - 1) as f64;
    let range = match way {
        Direction::Up => (first - ahead, last),
        Direction::Down => (first, last + ahead),
    };
    let plan = Plan {
        heights: false,
        ..Plan::new(Parameter::Frequency, range, columns + AHEAD, PERIODS)?
    };
    let of = (map.machine, map.window, way.name(), size);
    // Chains that go together are forgotten together but for their regimes.
    let found = parallel_blocks(0..rows as u64, Plan::MAX_CHAINS_TOGETHER as u64).map(|rows| {
        recall_or_compute(kept, &("regimes", of, rows.start), || {
            let chain = |row| Ok(Chain::new(map.scene((0, row as usize), size)?, way));
            let mut chains: Vec<Chain> = rows.map(chain).collect::<Result<_>>()?;
            plan.run_chains(&mut chains, &progress.watcher());
            progress.steps(0)?;
            Ok(chains.iter().flat_map(|chain| row(&plan, chain)).collect())
        })
    });
    Ok(found.collect::<Result<Vec<Vec<MotionKind>>>>()?.concat())
}

/// The cells of a chain; what it has not come to is lost.
fn row(plan: &Plan, chain: &Chain) -> Vec<MotionKind> {
    let steps = chain.steps.iter().skip(AHEAD);
    let cells = steps.map(|step| diagram::motion(&chain.machine.scene, step));
    let mut cells: Vec<MotionKind> = cells.collect();
    cells.resize(plan.steps - AHEAD, MotionKind::Lost);
    if chain.direction == Direction::Down {
        cells.reverse();
    }
    cells
}

/// The hardest periodic motion among those from some starts in each cell.
pub(super) fn hardest(
    map: &Map,
    size: (usize, usize),
    progress: &Progress,
    kept: OptionalMemory<'_>,
) -> Result<Vec<MotionKind>> {
    let (columns, rows) = size;
    let cells = parallel_blocks(0..(columns * rows) as u64, columns as u64).map(|row| {
        let row = row.start as usize / columns;
        recall_or_compute(kept, &("hardest", map.window, size, row), || {
            let cells = (0..columns).map(|column| {
                let found = hardest_of(&map.scene((column, row), size)?)?;
                progress.steps(STARTS as u64)?;
                Ok(found)
            });
            cells.collect::<Result<Vec<MotionKind>>>()
        })
    });
    Ok(cells.collect::<Result<Vec<_>>>()?.concat())
}

fn hardest_of(scene: &Scene) -> Result<MotionKind> {
    let options = SearchOptions {
        transient: OPTIONS.0,
        longest: OPTIONS.1,
        ..SearchOptions::default()
    };
    let starts = starts(scene.clearance);
    let arrivals = match settle_starts(scene, &starts, &options, &interrupt::watch) {
        Ok(arrivals) => arrivals,
        Err(OrbitError::Motion(_)) => return Ok(MotionKind::Lost),
        Err(error) => return Err(error.into()),
    };
    let orbits = arrivals.iter().filter_map(|arrival| arrival.orbit.as_ref());
    let velocity = Orbit::before_impact_velocity;
    let hardest = orbits.max_by(|a, b| velocity(a).total_cmp(&velocity(b)));
    Ok(match hardest {
        Some(orbit) if orbit.regime().impacts > 0 => MotionKind::of(orbit),
        // Chaos strikes harder than no impact at all.
        rest => wandering(scene, &arrivals)
            .unwrap_or(rest.map_or(MotionKind::Unsettled, MotionKind::of)),
    })
}

/// Starts that fill the region evenly, the same for all machines.
fn starts(clearance: f64) -> Vec<Start> {
    let within = |half: f64, share: f64| clearance * half * (2.0 * share - 1.0);
    let start = |index| {
        let [across, up] = evenly_spread_point([0.0; 2], index);
        Start::new(within(REGION.0, across), within(REGION.1, up))
    };
    (0..STARTS).map(start).collect()
}

/// Chaos, if small differences grow along a motion that has not settled.
fn wandering(scene: &Scene, arrivals: &[Arrival]) -> Option<MotionKind> {
    let mut restless = arrivals.iter().filter(|arrival| arrival.orbit.is_none());
    let map = StroboscopicMap::new(&scene.check().ok()?, WATCHED);
    let grows = |arrival: &Arrival| {
        let motion = classify_wandering(&map, arrival.state);
        motion.is_ok_and(|(motion, _)| motion == MotionKind::Chaos)
    };
    restless.any(grows).then_some(MotionKind::Chaos)
}
