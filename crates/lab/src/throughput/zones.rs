//! How many hysteresis zones a core computes in a second: the unloaded machine over clearance and stiffness.

use std::time::Instant;

use anyhow::Context;
use rayon::ThreadPool;
use serde::Serialize;
use softstop::{Ratios, Scene, SceneError};
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::median::median;
use softstop_console::progress::Progress;
use softstop_dynamics::zone::hysteresis_batch;

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

/// Zones of a grid on one core.
#[derive(Debug, Clone, Serialize)]
pub struct Zones {
    /// The machines.
    pub grid: Grid,
    /// How many of them have a zone.
    pub found: usize,
    /// Machines per second, the median.
    pub zones_per_second_per_core: f64,
    /// Slowest and fastest measurement.
    pub spread: (f64, f64),
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

    /// Measures so many rounds after one that is not counted, on the threads of `one`.
    ///
    /// # Errors
    /// [`Failure::Run`] if a machine is none, [`Failure::Interrupted`] after Ctrl-C.
    pub fn measure(
        self,
        repeats: usize,
        one: &ThreadPool,
        progress: &Progress,
    ) -> Result<Zones, Failure> {
        let scenes = self.scenes().context("the machines of the zones")?;
        let (mut rates, mut found) = (Vec::new(), 0);
        for round in 0..=repeats {
            let begin = Instant::now();
            found = 0;
            for block in scenes.chunks(BLOCK) {
                let zones = one.install(|| hysteresis_batch(block, &interrupt::watch));
                found += zones.iter().filter(|zone| zone.is_ok()).count();
                progress.steps(0)?;
            }
            if round > 0 {
                rates.push(scenes.len() as f64 / begin.elapsed().as_secs_f64());
            }
            progress.step()?;
        }
        rates.sort_by(f64::total_cmp);
        Ok(Zones {
            grid: self,
            found,
            zones_per_second_per_core: median(rates.clone()),
            spread: (rates[0], rates[rates.len() - 1]),
        })
    }
}
