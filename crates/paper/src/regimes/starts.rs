//! The hardest periodic motion that starts spread over the plane of states reach. Sweeps do not come upon the
//! motions z = 2/3 and z = (2/4)B, which "belong to impact motion with higher level of kinetic energy" (Peterka
//! 2003, section 4).

use anyhow::Result;
use rayon::prelude::*;
use softstop::{Scene, Start};
use softstop_dynamics::attractors::{Arrival, SearchOptions, settle_starts};
use softstop_dynamics::internals::evenly_spread_point;
use softstop_dynamics::monitor::{OptionalMemory, recall_or_compute};
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::points::parallel_blocks;
use softstop_dynamics::settled::classify_wandering;
use softstop_dynamics::{MotionKind, Orbit, StroboscopicMap};

use super::{Map, STARTS};
use softstop_console::interrupt;
use softstop_console::progress::Progress;

/// Half of the ranges of position and velocity in which starts lie, in units of the clearance.
const REGION: (f64, f64) = (1.5, 2.0);
/// Drive periods before motions are looked at, and the longest period looked for.
const OPTIONS: (u64, usize) = (250, 12);
/// Drive periods in which small differences have to grow in chaos.
const WATCHED: u64 = 64;

/// The hardest periodic motion among those from some starts in each cell.
pub(super) fn cells(
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
                let found = hardest(&map.scene((column, row), size)?)?;
                progress.steps(STARTS as u64)?;
                Ok(found)
            });
            cells.collect::<Result<Vec<MotionKind>>>()
        })
    });
    Ok(cells.collect::<Result<Vec<_>>>()?.concat())
}

fn hardest(scene: &Scene) -> Result<MotionKind> {
    let options = SearchOptions {
        transient: OPTIONS.0,
        longest: OPTIONS.1,
        ..SearchOptions::default()
    };
    let arrivals = settle_starts(scene, &starts(scene.clearance), &options, &|_, _| {
        interrupt::go_on()
    });
    let arrivals = match arrivals {
        Ok(arrivals) => arrivals,
        Err(OrbitError::Motion(_)) => return Ok(MotionKind::Lost),
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
