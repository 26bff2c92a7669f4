//! Regimes of sweeps along the frequency, one for each clearance.

use std::ops::Range;

use anyhow::Result;
use rayon::prelude::*;
use softstop::{Parameter, Ratios, Scene};
use softstop_dynamics::points::blocks;
use softstop_dynamics::watch::{Kept, piece};
use softstop_dynamics::{Chain, Direction, MotionKind, Orbit, Plan, Step};

use super::{PERIODS, Window, middle};
use softstop_console::progress::Progress;
use softstop_explore::basin::cells::RegimeMap;

/// Frequencies before the first column, in which the motion settles from rest.
const AHEAD: usize = 6;

/// What is swept, and which way.
pub(super) struct Sweep {
    pub machine: Ratios,
    pub window: Window,
    pub way: Direction,
    /// Cells across and up.
    pub size: (usize, usize),
}

impl Sweep {
    /// The regime in each cell.
    pub fn map(&self, progress: &Progress, kept: Kept<'_>) -> Result<RegimeMap> {
        let (columns, rows) = self.size;
        let [first, last] = [0, columns - 1].map(|column| middle(self.window.eta, column, columns));
        let ahead = AHEAD as f64 * (last - first) / (columns - 1) as f64;
        let range = match self.way {
            Direction::Up => (first - ahead, last),
            Direction::Down => (first, last + ahead),
        };
        let plan = Plan {
            heights: false,
            ..Plan::new(Parameter::Frequency, range, columns + AHEAD, PERIODS)?
        };
        let of = (&self.machine, self.window, self.way.name(), self.size);
        // Chains that go together are forgotten together but for their regimes.
        let found = blocks(0..rows as u64, Plan::TOGETHER as u64).map(|rows| {
            let of = ("regimes", of, rows.start);
            piece(kept, &of, || self.cells(&plan, rows, progress))
        });
        Ok(RegimeMap {
            eta: self.window.eta,
            rho: self.window.rho,
            columns,
            cells: found.collect::<Result<Vec<_>>>()?.concat(),
        })
    }

    /// The cells of a few rows.
    fn cells(&self, plan: &Plan, rows: Range<u64>, progress: &Progress) -> Result<Vec<MotionKind>> {
        let chain = |row| {
            let machine = self
                .window
                .machine(&self.machine, (0, row as usize), self.size);
            Ok(Chain::new(machine.scene()?, self.way))
        };
        let mut chains: Vec<Chain> = rows.map(chain).collect::<Result<_>>()?;
        plan.run(&mut chains, &progress.watcher());
        progress.steps(0)?;
        Ok(chains.iter().flat_map(|chain| row(plan, chain)).collect())
    }
}

/// The cells of a chain; what it has not come to is lost.
fn row(plan: &Plan, chain: &Chain) -> Vec<MotionKind> {
    let steps = chain.steps.iter().skip(AHEAD);
    let cells = steps.map(|step| cell(&chain.machine.scene, step));
    let mut cells: Vec<MotionKind> = cells.collect();
    cells.resize(plan.steps - AHEAD, MotionKind::Lost);
    if chain.direction == Direction::Down {
        cells.reverse();
    }
    cells
}

/// The motion with the order of its impacts as Newton's method has it, where that tells its colour.
fn cell(scene: &Scene, step: &Step) -> MotionKind {
    let seen = || step.motion.clone();
    match step.motion.regime() {
        Some(regime) if regime.periods >= 4 && 2 * regime.impacts == regime.periods => {
            let scene = scene.at_frequency(step.value);
            let orbit = Orbit::periodic(&scene, step.end.into(), regime.periods).ok();
            let orbit = orbit.filter(|orbit| orbit.regime() == regime);
            orbit.map_or_else(seen, |orbit| MotionKind::of(&orbit))
        }
        _ => seen(),
    }
}
