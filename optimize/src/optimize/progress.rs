//! The progress of a search: how many zones it has seen, the best so far, and when it ends.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, OnceLock, mpsc};
use std::thread;
use std::time::Duration;

use crate::design::Problem;
use crate::design::search::SearchMonitor;
use softstop_console::interrupt;
use softstop_console::progress::Progress;

/// Between two looks whether it is time to say how far a search is.
const BEAT: Duration = Duration::from_secs(1);

/// Watches a search.
pub(super) struct SearchProgress<'a> {
    problem: &'a Problem,
    /// The progress over zones, and the best value; none once a front is searched.
    zones: Mutex<Option<(Progress, Option<f64>)>>,
    front: OnceLock<Progress>,
    evaluations: AtomicU64,
    budget: u64,
}

impl<'a> SearchProgress<'a> {
    pub(super) fn new(problem: &'a Problem, evaluations: u64, budget: u64) -> Self {
        Self {
            problem,
            zones: Mutex::new(Some((Progress::at_most(evaluations, "zones"), None))),
            front: OnceLock::new(),
            evaluations: AtomicU64::new(0),
            budget,
        }
    }

    /// Does the work of a search, and says how far it is also while the zones that are computed together take long.
    pub(super) fn while_beating<T>(&self, work: impl FnOnce() -> T) -> T {
        let (end, ended) = mpsc::channel::<()>();
        thread::scope(|scope| {
            scope.spawn(move || {
                while ended.recv_timeout(BEAT) == Err(mpsc::RecvTimeoutError::Timeout) {
                    if let Ok(zones) = self.zones.lock()
                        && let Some((zones, _)) = &*zones
                    {
                        zones.beat();
                    }
                }
            });
            let done = work();
            drop(end);
            done
        })
    }

    /// Zones that were computed.
    pub(super) fn evaluations(&self) -> u64 {
        self.evaluations.load(Ordering::Relaxed)
    }
}

impl SearchMonitor for SearchProgress<'_> {
    fn evaluated(&self, value: Option<f64>) {
        self.evaluations.fetch_add(1, Ordering::Relaxed);
        let Ok(mut zones) = self.zones.lock() else {
            return;
        };
        let Some((zones, best)) = &mut *zones else {
            return;
        };
        zones.more(1);
        let Some(value) = value else { return };
        let Problem {
            objective, machine, ..
        } = self.problem;
        if best.is_none_or(|best| objective.score(value) > objective.score(best)) {
            *best = Some(value);
            let unit = machine.unit(objective.figure.dimension());
            let what = self.problem.words();
            zones.say(format!("{what} {value:.4} {unit}").trim_end());
        }
    }

    fn posed(&self, done: u64, all: u64) {
        if let Ok(mut zones) = self.zones.lock() {
            *zones = None;
        }
        let front = || Progress::new(all, "problems of the front");
        self.front.get_or_init(front).at(done);
    }

    fn stop(&self) -> bool {
        interrupt::requested()
    }

    fn budget(&self) -> u64 {
        self.budget
    }
}
