//! The progress of a search: how many zones it has seen, the best velocity so far, and when it ends.

use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::design::search::Watch;
use softstop::{Dimension, Machine};
use softstop_console::interrupt;
use softstop_console::progress::Progress;

/// Watches a search.
pub(super) struct Best {
    progress: Progress,
    velocity: Mutex<f64>,
    evaluations: AtomicU64,
    unit: &'static str,
}

impl Best {
    pub(super) fn new(machine: &Machine, evaluations: u64) -> Self {
        Self {
            progress: Progress::new(evaluations, "zones"),
            velocity: Mutex::new(f64::NEG_INFINITY),
            evaluations: AtomicU64::new(0),
            unit: machine.unit(Dimension::Velocity),
        }
    }

    /// Zones that were computed.
    pub(super) fn evaluations(&self) -> u64 {
        self.evaluations.load(Ordering::Relaxed)
    }
}

impl Watch for Best {
    fn evaluated(&self, velocity: Option<f64>) {
        self.evaluations.fetch_add(1, Ordering::Relaxed);
        self.progress.more(1);
        let Some(velocity) = velocity else { return };
        let Ok(mut best) = self.velocity.lock() else {
            return;
        };
        if velocity > *best {
            *best = velocity;
            let unit = self.unit;
            self.progress
                .say(format!("best velocity {velocity:.4} {unit}").trim_end());
        }
    }

    fn stop(&self) -> bool {
        interrupt::requested()
    }
}
