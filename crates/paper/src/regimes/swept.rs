//! Regimes of sweeps along the frequency, one for each clearance.

use anyhow::Result;
use rayon::prelude::*;
use softstop::{Parameter, Ratios, Scene};
use softstop_dynamics::motion::MotionKind;
use softstop_dynamics::orbit::Orbit;
use softstop_dynamics::sweep::{Chain, Direction, Plan, Step};

use super::{PERIODS, Window};
use softstop_console::progress::Progress;
use softstop_explore::basin::cells::RegimeMap;

/// Chains that go together, and are forgotten together but for their regimes.
const TOGETHER: usize = 8;
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
    pub fn map(&self, progress: &Progress) -> Result<RegimeMap> {
        let (columns, rows) = self.size;
        let (first, last) = (
            self.window.eta_at(0, columns),
            self.window.eta_at(columns - 1, columns),
        );
        let ahead = AHEAD as f64 * (last - first) / (columns - 1) as f64;
        let range = match self.way {
            Direction::Up => (first - ahead, last),
            Direction::Down => (first, last + ahead),
        };
        let plan = Plan::new(Parameter::Frequency, range, columns + AHEAD, PERIODS)?;
        let rows: Vec<usize> = (0..rows).collect();
        let found: Vec<Vec<MotionKind>> = rows
            .par_chunks(TOGETHER)
            .map(|rows| self.cells(&plan, rows, progress))
            .collect::<Result<_, _>>()?;
        Ok(RegimeMap {
            eta: self.window.eta,
            rho: self.window.rho,
            columns,
            cells: found.into_iter().flatten().collect(),
        })
    }

    /// The cells of a few rows.
    fn cells(&self, plan: &Plan, rows: &[usize], progress: &Progress) -> Result<Vec<MotionKind>> {
        let chain = |row: &usize| {
            let clearance = self.window.rho_at(*row, self.size.1);
            let scene = self.machine.at_clearance(clearance).scene()?;
            Ok(Chain::new(scene, self.way))
        };
        let mut chains: Vec<Chain> = rows.iter().map(chain).collect::<Result<_>>()?;
        plan.run(&mut chains, &progress.watcher());
        progress.steps(0)?;
        Ok(chains.iter().flat_map(|chain| row(plan, chain)).collect())
    }
}

/// The cells of a chain; what it has not come to is lost.
fn row(plan: &Plan, chain: &Chain) -> Vec<MotionKind> {
    let mut cells: Vec<MotionKind> = chain
        .steps
        .iter()
        .skip(AHEAD)
        .map(|step| cell(&chain.machine.scene, step))
        .collect();
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
            let mut scene = scene.clone();
            scene.excitation.frequency = step.value;
            let orbit = Orbit::periodic(&scene, step.end.into(), regime.periods).ok();
            let orbit = orbit.filter(|orbit| orbit.regime() == regime);
            orbit.map_or_else(seen, |orbit| MotionKind::of(&orbit))
        }
        _ => seen(),
    }
}
