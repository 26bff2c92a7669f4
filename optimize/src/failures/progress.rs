//! The progress bar of an atlas, on stderr; nothing is drawn where stderr is not a terminal.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

const STYLE: &str = "{spinner} {bar:36} {pos}/{len} runs, {eta} left";

/// Counts runs.
#[derive(Debug)]
pub struct Progress(ProgressBar);

impl Progress {
    /// A bar for so many runs.
    #[must_use]
    pub fn new(runs: usize) -> Self {
        let bar = ProgressBar::new(runs as u64);
        let bar = match ProgressStyle::with_template(STYLE) {
            Ok(style) => bar.with_style(style),
            Err(_) => bar,
        };
        bar.enable_steady_tick(Duration::from_millis(200));
        Self(bar)
    }

    /// One that shows nothing.
    #[must_use]
    pub fn hidden() -> Self {
        Self(ProgressBar::hidden())
    }

    /// One run is done.
    pub fn advance(&self) {
        self.0.inc(1);
    }
}

/// The terminal is as before.
impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
