//! The progress of a long run, on stderr: a bar on a terminal once the run has taken two seconds, elsewhere a
//! line every ten seconds.

use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::failure::{Failure, check_interrupt};
use crate::interrupt;

/// A run that is over sooner shows no bar.
const PATIENCE: Duration = Duration::from_secs(2);
/// Seconds between two lines where there is no terminal.
const PAUSE: u64 = 10;
/// How often a bar that is shown is drawn anew.
const TICK: Duration = Duration::from_millis(200);

/// True while a program that calls this one as a library shows the progress of runs itself.
static IS_SHOWN_ELSEWHERE: AtomicBool = AtomicBool::new(false);
/// What the run under way counts, for that program.
static UNDER_WAY: Mutex<Option<(String, ProgressBar)>> = Mutex::new(None);

fn under_way() -> MutexGuard<'static, Option<(String, ProgressBar)>> {
    UNDER_WAY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// How far a run is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Done {
    /// What is counted.
    pub what: String,
    /// How much is done.
    pub done: u64,
    /// Of how much, if that is known.
    pub total: Option<u64>,
}

/// Does work whose progress is written nowhere: the program that calls this one as a library asks for it ([`done`]).
pub fn shown_elsewhere<T>(work: impl FnOnce() -> T) -> T {
    IS_SHOWN_ELSEWHERE.store(true, Ordering::SeqCst);
    let value = work();
    IS_SHOWN_ELSEWHERE.store(false, Ordering::SeqCst);
    value
}

/// How far the run under way is, if it counts what it does.
pub fn done() -> Option<Done> {
    let under_way = under_way();
    let (what, bar) = under_way.as_ref()?;
    Some(Done {
        what: what.clone(),
        done: bar.position(),
        total: bar.length(),
    })
}

/// Counts what is done of a run. When it is dropped, the terminal is as before.
#[derive(Debug)]
pub struct Progress {
    begin: Instant,
    bar: ProgressBar,
    what: String,
    is_terminal: bool,
    /// Lines written, or 1 once the bar is shown.
    shown: AtomicU64,
    /// What was done before.
    before: AtomicU64,
    /// The rest goes on as what is done.
    is_even: bool,
}

impl Progress {
    /// A bar for so many things called `what`.
    pub fn new(total: u64, what: &str) -> Self {
        Self::of(Some(total), what, "{bar:36} {pos}/{len}", ", {eta} left")
    }

    /// So many things called `what` at most, among other work that is not counted: how long the rest takes nobody knows.
    pub fn at_most(total: u64, what: &str) -> Self {
        let mut progress = Self::of(Some(total), what, "{bar:36} {pos}/{len}", "");
        progress.is_even = false;
        progress
    }

    /// A count of things called `what`, nobody knows how many.
    pub fn open(what: &str) -> Self {
        Self::of(None, what, "{pos}", "")
    }

    fn of(total: Option<u64>, what: &str, count: &str, rest: &str) -> Self {
        let bar = ProgressBar::with_draw_target(total, ProgressDrawTarget::hidden());
        let style = format!("{{spinner}} {count} {what}{rest}{{msg}}");
        if let Ok(style) = ProgressStyle::with_template(&style) {
            bar.set_style(style);
        }
        if IS_SHOWN_ELSEWHERE.load(Ordering::SeqCst) {
            *under_way() = Some((what.to_owned(), bar.clone()));
        }
        Self {
            begin: Instant::now(),
            bar,
            what: what.to_owned(),
            is_terminal: io::stderr().is_terminal(),
            shown: AtomicU64::new(0),
            before: AtomicU64::new(0),
            is_even: true,
        }
    }

    /// The run is under way; says so once it has taken long.
    pub fn beat(&self) {
        if IS_SHOWN_ELSEWHERE.load(Ordering::Relaxed) {
            return;
        }
        let (elapsed, shown) = (self.begin.elapsed(), self.shown.load(Ordering::Relaxed));
        let due = if self.is_terminal {
            u64::from(elapsed > PATIENCE)
        } else {
            elapsed.as_secs() / PAUSE
        };
        // Of several threads one says it.
        if due <= shown || self.shown.fetch_max(due, Ordering::Relaxed) >= due {
            return;
        }
        if self.is_terminal {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
            self.bar.enable_steady_tick(TICK);
        } else {
            self.line();
        }
    }

    /// How far the run is, in a line.
    fn line(&self) {
        let all = self.bar.length();
        let all = all.map_or_else(String::new, |all| format!(" of {all}"));
        let (done, seconds) = (self.bar.position(), self.begin.elapsed().as_secs());
        let left = self
            .left()
            .filter(|_| self.is_even)
            .map(|left| format!(", {left:.0} s left"));
        let left = left.unwrap_or_default();
        let _ = writeln!(
            io::stderr(),
            "{done}{all} {} after {seconds} s{left}",
            self.what
        );
    }

    /// How long the rest takes in s, if it goes on as it has.
    fn left(&self) -> Option<f64> {
        let (done, before) = (self.bar.position(), self.before.load(Ordering::Relaxed));
        let made = done.checked_sub(before).filter(|made| *made > 0)?;
        let rest = self.bar.length()?.checked_sub(done)?;
        Some(self.begin.elapsed().as_secs_f64() * rest as f64 / made as f64)
    }

    /// So many were done before the run began.
    pub fn begin_at(&self, done: u64) {
        self.before.store(done, Ordering::Relaxed);
        self.bar.set_position(done);
        self.bar.reset_eta();
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
        self.more(count);
        check_interrupt()
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

    /// A watcher of one of the works that make up the run: counts what it has done, and stops it after Ctrl-C.
    pub fn watcher(&self) -> impl Fn(u64, u64) -> ControlFlow<()> + Sync + '_ {
        let told = AtomicU64::new(0);
        move |done, _| {
            let before = told.fetch_max(done, Ordering::Relaxed);
            self.more(done.saturating_sub(before));
            interrupt::go_on()
        }
    }

    /// What else there is to say.
    pub fn say(&self, what: &str) {
        self.bar.set_message(format!(", {what}"));
        self.beat();
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        *under_way() = None;
        self.bar.finish_and_clear();
    }
}
