//! The progress bar of a measurement, on stderr; nothing is drawn where stderr is not a terminal.

use indicatif::{ProgressBar, ProgressStyle};

const STYLE: &str = "{spinner} {bar:36} {pos}/{len} {msg}, {eta} left";

/// Counts settings.
pub struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// So many steps of work are to be done.
    #[must_use]
    pub fn new(total: usize) -> Self {
        let bar = ProgressBar::new(total as u64);
        let style = ProgressStyle::with_template(STYLE);
        Self {
            bar: style.map_or_else(|_| bar.clone(), |style| bar.clone().with_style(style)),
        }
    }

    /// What is being done.
    pub fn on(&self, what: &str) {
        self.bar.set_message(what.to_owned());
    }

    /// One more is done.
    pub fn one(&self) {
        self.bar.inc(1);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
