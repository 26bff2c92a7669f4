//! Where a swept run loses the z = 1 motion: later than it ends.

use softstop::Ratios;
use softstop::orbit::{StroboscopicMap, find};

/// How fast a run is swept.
#[derive(Debug, Clone, Copy)]
pub struct Sweep {
    /// Rise of eta.
    pub step: f64,
    /// Drive periods for each.
    pub periods: u64,
}

impl Sweep {
    /// A rate at which the loss is where the paper's row 19 has it.
    pub const PAPER: Self = Self {
        step: 1e-3,
        periods: 50,
    };
}

/// Steps before the end at which the run begins.
const BEFORE: f64 = 20.0;
/// Steps after it at which it is given up.
const AFTER: f64 = 50.0;

/// The first frequency ratio of a rising sweep in which not every drive period has its impact.
#[must_use]
pub fn lost_at(end: f64, sweep: Sweep) -> Option<f64> {
    let scene = |eta: f64| {
        let ratios = Ratios {
            frequency: eta,
            ..Ratios::unloaded()
        };
        ratios.scene().ok()
    };
    // On whole steps, as a run by hand would go.
    let first = (end / sweep.step).floor() - BEFORE;
    let mut state = find(&scene(first * sweep.step)?).ok()?.state();
    for step in 0..(BEFORE + AFTER) as u64 {
        let eta = (first + step as f64) * sweep.step;
        let map = StroboscopicMap::new(&scene(eta)?, sweep.periods).ok()?;
        let passage = map.apply(state).ok()?;
        if (passage.impacts.len() as u64) < sweep.periods {
            return Some(eta);
        }
        state = passage.end;
    }
    None
}
