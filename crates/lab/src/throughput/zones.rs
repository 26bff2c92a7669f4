//! How many hysteresis zones a core computes in a second: the unloaded machine over clearance and stiffness.

use anyhow::Result;
use rayon::ThreadPool;
use serde::Serialize;
use softstop::{Ratios, Scene, SceneError};
use softstop_console::failure::check_interrupt;
use softstop_console::interrupt;
use softstop_dynamics::zone::hysteresis_batch;

use super::batch::Count;

/// Machines between two looks at whether to stop.
const BLOCK: usize = 256;

/// A square grid of machines.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Grid {
    /// The machine.
    pub machine: &'static str,
    /// Lowest and highest clearance ratio rho.
    pub clearances: (f64, f64),
    /// Lowest and highest stiffness k4/k1.
    pub stiffnesses: (f64, f64),
    /// Machines along each edge.
    pub edge: u32,
}

impl Grid {
    /// What the optimiser searches if nothing else is said, with so many machines or a few more.
    pub fn of(machines: u32) -> Self {
        Self {
            machine: "unloaded",
            clearances: (2.0, 22.0),
            stiffnesses: (1.0, 30.0),
            edge: f64::from(machines).sqrt().ceil().max(2.0) as u32,
        }
    }

    /// Its machines.
    ///
    /// # Errors
    /// [`SceneError`] if one is none.
    pub fn scenes(self) -> Result<Vec<Scene>, SceneError> {
        let place = |(low, high): (f64, f64), index: u32| {
            low + (high - low) * f64::from(index) / f64::from(self.edge - 1)
        };
        let scene = |index: u32| {
            let ratios = Ratios {
                clearance: place(self.clearances, index % self.edge),
                stiffness: place(self.stiffnesses, index / self.edge),
                ..Ratios::unloaded()
            };
            ratios.scene()
        };
        (0..self.edge * self.edge).map(scene).collect()
    }
}

/// Computes the zones of machines on the threads of `one`, and counts those that there are.
///
/// # Errors
/// [`Failure::Interrupted`](softstop_console::failure::Failure::Interrupted) after Ctrl-C.
pub fn count(scenes: &[Scene], one: &ThreadPool) -> Result<Count> {
    let mut count = Count::default();
    for block in scenes.chunks(BLOCK) {
        let zones = one.install(|| hysteresis_batch(block, &interrupt::watch));
        count.found += zones.iter().filter(|zone| zone.is_ok()).count() as u64;
        check_interrupt()?;
    }
    Ok(count)
}
