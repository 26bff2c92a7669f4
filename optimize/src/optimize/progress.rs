//! The progress bar on stderr; nothing is drawn where stderr is not a terminal.

use std::sync::Mutex;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use crate::design::search::Watch;
use crate::interrupt;

const STYLE: &str = "{spinner} {bar:36} {pos}/{len} zones, {eta} left, best X'- {msg}";

/// Counts zones and shows the best velocity so far.
pub(super) struct Progress {
    bar: ProgressBar,
    best: Mutex<f64>,
}

impl Progress {
    pub(super) fn new(evaluations: u64) -> Self {
        let bar = ProgressBar::new(evaluations).with_message("-");
        if let Ok(style) = ProgressStyle::with_template(STYLE) {
            bar.set_style(style);
        }
        bar.enable_steady_tick(Duration::from_millis(200));
        Self {
            bar,
            best: Mutex::new(f64::NEG_INFINITY),
        }
    }

    /// Takes the bar away: the terminal is as before.
    pub(super) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Watch for Progress {
    fn evaluated(&self, velocity: Option<f64>) {
        self.bar.inc(1);
        let Some(velocity) = velocity else { return };
        let Ok(mut best) = self.best.lock() else {
            return;
        };
        if velocity > *best {
            *best = velocity;
            self.bar.set_message(format!("{velocity:.4}"));
        }
    }

    fn stop(&self) -> bool {
        interrupt::requested()
    }
}
