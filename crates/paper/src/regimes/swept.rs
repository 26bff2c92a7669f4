//! Regimes of sweeps along the frequency, one for each clearance.

use anyhow::Result;
use rayon::prelude::*;
use softstop::Parameter;
use softstop_dynamics::monitor::{OptionalMemory, recall_or_compute};
use softstop_dynamics::points::parallel_blocks;
use softstop_dynamics::{Chain, Direction, MotionKind, Plan};

use super::{Map, PERIODS, middle};
use crate::diagram;
use softstop_console::progress::Progress;

/// Frequencies before the first column, in which the motion settles from rest.
const AHEAD: usize = 6;

/// The regime in each cell.
pub(super) fn cells(
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
