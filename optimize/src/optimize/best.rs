//! The progress of a search: how many zones it has seen, and the best velocity so far.

use std::sync::Mutex;

use crate::design::search::Watch;
use softstop_console::interrupt;
use softstop_console::progress::Progress;

/// Watches a search.
pub(super) struct Best {
    progress: Progress,
    velocity: Mutex<f64>,
}

impl Best {
    pub(super) fn new(evaluations: u64) -> Self {
        Self {
            progress: Progress::new(evaluations, "zones"),
            velocity: Mutex::new(f64::NEG_INFINITY),
        }
    }
}

impl Watch for Best {
    fn evaluated(&self, velocity: Option<f64>) {
        self.progress.one();
        let Some(velocity) = velocity else { return };
        let Ok(mut best) = self.velocity.lock() else {
            return;
        };
        if velocity > *best {
            *best = velocity;
            self.progress.say(&format!("best X'- {velocity:.4}"));
        }
    }

    fn stop(&self) -> bool {
        interrupt::requested()
    }
}
