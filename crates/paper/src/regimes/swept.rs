//! Regimes of sweeps along the frequency, one for each clearance.

use anyhow::Result;
use rayon::prelude::*;
use softstop::Ratios;
use softstop_dynamics::continuation::{Adjustable, Parameter};
use softstop_dynamics::orbit::{Orbit, Regime};
use softstop_dynamics::sweep::{Chain, Direction, Plan, Settled, Step};

use super::{PERIODS, Window};
use softstop_console::progress::Progress;
use softstop_explore::basin::cells::{RegimeCell, RegimeMap};

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
        let found: Vec<Vec<RegimeCell>> = rows
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
    fn cells(&self, plan: &Plan, rows: &[usize], progress: &Progress) -> Result<Vec<RegimeCell>> {
        let chain = |row: &usize| {
            let clearance = self.window.rho_at(*row, self.size.1);
            let machine = self.machine.at_clearance(clearance);
            Chain::new(machine, self.way)
        };
        let mut chains: Vec<Chain<Ratios>> = rows.iter().map(chain).collect();
        plan.run(&mut chains, &|steps| progress.steps(steps).is_ok());
        progress.steps(0)?;
        Ok(chains.iter().flat_map(|chain| row(plan, chain)).collect())
    }
}

/// The cells of a chain; what it has not come to is lost.
fn row(plan: &Plan, chain: &Chain<Ratios>) -> Vec<RegimeCell> {
    let mut cells: Vec<RegimeCell> = chain
        .steps
        .iter()
        .skip(AHEAD)
        .map(|step| cell(&chain.machine, step))
        .collect();
    cells.resize(plan.steps - AHEAD, RegimeCell::Lost);
    if chain.direction == Direction::Down {
        cells.reverse();
    }
    cells
}

fn cell(machine: &Ratios, step: &Step) -> RegimeCell {
    match step.settled {
        Settled::Periodic(regime) => {
            polished(machine, step, regime).unwrap_or(RegimeCell::Periodic {
                regime,
                is_paired: false,
            })
        }
        Settled::Chaotic { .. } => RegimeCell::Chaos,
        Settled::Unsettled { .. } => RegimeCell::Unsettled,
    }
}

/// The regime with the order of its impacts, where that makes a difference.
fn polished(machine: &Ratios, step: &Step, regime: Regime) -> Option<RegimeCell> {
    if regime.periods < 4 || 2 * regime.impacts != regime.periods {
        return None;
    }
    let mut machine = *machine;
    machine.set(Parameter::Frequency, step.value);
    let scene = machine.scene().ok()?;
    let orbit = Orbit::periodic(&scene, step.end.into(), regime.periods).ok()?;
    (orbit.regime() == regime).then(|| RegimeCell::of(&orbit))
}
