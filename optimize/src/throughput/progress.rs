//! The progress bar on stderr, and the user's wish to stop.

use std::sync::Once;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::failure::Failure;
use crate::interrupt;

/// A run that is over sooner shows none.
const PATIENCE: Duration = Duration::from_secs(2);

/// Counts what is done, on any number of threads.
pub struct Progress {
    begin: Instant,
    bar: ProgressBar,
    shown: Once,
}

impl Progress {
    /// A bar for so many things called `what`.
    #[must_use]
    pub fn new(count: u64, what: &str) -> Self {
        let bar = ProgressBar::hidden();
        bar.set_length(count);
        let style = format!("{{spinner}} {{bar:36}} {{pos}}/{{len}} {what}, {{eta}} left");
        if let Ok(style) = ProgressStyle::with_template(&style) {
            bar.set_style(style);
        }
        Self {
            begin: Instant::now(),
            bar,
            shown: Once::new(),
        }
    }

    /// So many more are done.
    ///
    /// # Errors
    /// [`Failure::Interrupted`] after Ctrl-C.
    pub fn step(&self, count: u64) -> Result<(), Failure> {
        if self.begin.elapsed() > PATIENCE {
            let show = || self.bar.set_draw_target(ProgressDrawTarget::stderr());
            self.shown.call_once(show);
        }
        self.bar.inc(count);
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
