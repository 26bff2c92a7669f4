//! The progress of a search: how many zones it has seen, the best so far, and when it ends.

use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::design::Problem;
use crate::design::problem::Objective;
use crate::design::search::Watch;
use softstop_console::interrupt;
use softstop_console::progress::Progress;

/// Watches a search.
pub(super) struct Best {
    progress: Progress,
    best: Mutex<Option<f64>>,
    evaluations: AtomicU64,
    budget: u64,
    objective: Objective,
    unit: &'static str,
}

impl Best {
    pub(super) fn new(problem: &Problem, evaluations: u64, budget: u64) -> Self {
        let objective = problem.objective;
        Self {
            progress: Progress::at_most(evaluations, "zones"),
            best: Mutex::new(None),
            evaluations: AtomicU64::new(0),
            budget,
            objective,
            unit: problem.machine.unit(objective.figure.dimension()),
        }
    }

    /// Zones that were computed.
    pub(super) fn evaluations(&self) -> u64 {
        self.evaluations.load(Ordering::Relaxed)
    }
}

impl Watch for Best {
    fn evaluated(&self, value: Option<f64>) {
        self.evaluations.fetch_add(1, Ordering::Relaxed);
        self.progress.more(1);
        let Some(value) = value else { return };
        let Ok(mut best) = self.best.lock() else {
            return;
        };
        let score = |value| self.objective.score(value);
        if best.is_none_or(|best| score(value) > score(best)) {
            *best = Some(value);
            let (what, unit) = (self.objective.words(), self.unit);
            self.progress
                .say(format!("{what} {value:.4} {unit}").trim_end());
        }
    }

    fn stop(&self) -> bool {
        interrupt::requested()
    }

    fn budget(&self) -> u64 {
        self.budget
    }
}
