//! The progress bar of a long run, on stderr; nothing is drawn where stderr is not a terminal.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

const STYLE: &str = "{spinner} {bar:36} {pos}/{len} periods, {eta} left";
/// A run that is over sooner shows none.
const PATIENCE: Duration = Duration::from_secs(2);

/// Counts drive periods.
pub(super) struct Progress {
    begin: Instant,
    periods: u64,
    bar: Option<ProgressBar>,
}

impl Progress {
    pub(super) fn new(periods: u64) -> Self {
        Self {
            begin: Instant::now(),
            periods,
            bar: None,
        }
    }

    /// So many periods are done.
    pub(super) fn at(&mut self, cycle: u64) {
        if self.bar.is_none() && self.begin.elapsed() > PATIENCE {
            self.bar = Some(bar(self.periods, self.begin.elapsed()));
        }
        if let Some(bar) = &self.bar {
            bar.set_position(cycle);
        }
    }

    /// Takes the bar away: the terminal is as before.
    pub(super) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.finish();
    }
}

fn bar(periods: u64, elapsed: Duration) -> ProgressBar {
    let bar = ProgressBar::new(periods).with_elapsed(elapsed);
    match ProgressStyle::with_template(STYLE) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}
