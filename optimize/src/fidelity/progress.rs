//! The progress bar on stderr, and the user's wish to stop.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::failure::Failure;
use crate::interrupt;

/// A run that is over sooner shows none.
const PATIENCE: Duration = Duration::from_secs(2);

/// Counts motions.
pub(super) struct Progress {
    begin: Instant,
    bar: ProgressBar,
    shown: bool,
}

impl Progress {
    /// A bar for so many things called `what`.
    pub(super) fn new(count: usize, what: &str) -> Self {
        let bar = ProgressBar::hidden();
        bar.set_length(count as u64);
        let style = format!("{{spinner}} {{bar:36}} {{pos}}/{{len}} {what}, {{eta}} left");
        if let Ok(style) = ProgressStyle::with_template(&style) {
            bar.set_style(style);
        }
        Self {
            begin: Instant::now(),
            bar,
            shown: false,
        }
    }

    /// One more is done.
    ///
    /// # Errors
    /// [`Failure::Interrupted`] after Ctrl-C.
    pub(super) fn step(&mut self) -> Result<(), Failure> {
        if !self.shown && self.begin.elapsed() > PATIENCE {
            self.bar
                .set_draw_target(indicatif::ProgressDrawTarget::stderr());
            self.shown = true;
        }
        self.bar.inc(1);
        if interrupt::requested() {
            return Err(Failure::Interrupted);
        }
        Ok(())
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
