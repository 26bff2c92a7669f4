//! The progress bar of a search, on stderr; nothing is drawn where stderr is not a terminal.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

const STYLE: &str = "{spinner} {bar:36} {percent} % of at most {human_len} drive periods";
/// A run that is over sooner shows none.
const PATIENCE: Duration = Duration::from_secs(2);

/// Counts drive periods.
pub(super) struct Progress {
    begin: Instant,
    bar: ProgressBar,
}

impl Progress {
    pub(super) fn new() -> Self {
        let bar = ProgressBar::hidden();
        if let Ok(style) = ProgressStyle::with_template(STYLE) {
            bar.set_style(style);
        }
        Self {
            begin: Instant::now(),
            bar,
        }
    }

    /// So many are done, of so many at most.
    pub(super) fn at(&self, done: u64, planned: u64) {
        if self.bar.is_hidden() && self.begin.elapsed() > PATIENCE {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        self.bar.set_length(planned);
        self.bar.set_position(done);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
