//! The progress bar of a long run, on stderr: nothing is drawn where stderr is not a terminal, or before the
//! run has taken two seconds.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::failure::Failure;
use crate::interrupt;

/// A run that is over sooner shows no bar.
const PATIENCE: Duration = Duration::from_secs(2);
/// How often a bar that is shown is drawn anew.
const TICK: Duration = Duration::from_millis(200);

/// Counts what is done of a run. When it is dropped, the terminal is as before.
#[derive(Debug)]
pub struct Progress {
    begin: Instant,
    bar: ProgressBar,
    is_shown: AtomicBool,
}

impl Progress {
    /// A bar for so many things called `what`.
    #[must_use]
    pub fn new(total: u64, what: &str) -> Self {
        let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::hidden());
        let style = format!("{{spinner}} {{bar:36}} {{pos}}/{{len}} {what}, {{eta}} left{{msg}}");
        if let Ok(style) = ProgressStyle::with_template(&style) {
            bar.set_style(style);
        }
        Self::of(bar)
    }

    /// A count of things called `what`, nobody knows how many.
    #[must_use]
    pub fn open(what: &str) -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        if let Ok(style) =
            ProgressStyle::with_template(&format!("{{spinner}} {{pos}} {what}{{msg}}"))
        {
            bar.set_style(style);
        }
        Self::of(bar)
    }

    fn of(bar: ProgressBar) -> Self {
        Self {
            begin: Instant::now(),
            bar,
            is_shown: AtomicBool::new(false),
        }
    }

    /// The run is under way; shows the bar once it has taken long.
    pub fn beat(&self) {
        if self.begin.elapsed() > PATIENCE && !self.is_shown.swap(true, Ordering::Relaxed) {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
            self.bar.enable_steady_tick(TICK);
        }
    }

    /// One more is done.
    pub fn one(&self) {
        self.bar.inc(1);
        self.beat();
    }

    /// One more is done, and the run may go on.
    ///
    /// # Errors
    /// [`Failure::Interrupted`] after Ctrl-C.
    pub fn step(&self) -> Result<(), Failure> {
        self.steps(1)
    }

    /// So many more are done, and the run may go on.
    ///
    /// # Errors
    /// [`Failure::Interrupted`] after Ctrl-C.
    pub fn steps(&self, count: u64) -> Result<(), Failure> {
        self.bar.inc(count);
        self.beat();
        if interrupt::requested() {
            return Err(Failure::Interrupted);
        }
        Ok(())
    }

    /// So many are done.
    pub fn at(&self, done: u64) {
        self.bar.set_position(done);
        self.beat();
    }

    /// So many are done of so many.
    pub fn at_of(&self, done: u64, total: u64) {
        self.bar.set_length(total);
        self.at(done);
    }

    /// So many more are done.
    pub fn more(&self, count: u64) {
        self.bar.inc(count);
        self.beat();
    }

    /// What else there is to say.
    pub fn say(&self, what: &str) {
        self.bar.set_message(format!(", {what}"));
        self.beat();
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
