//! The best design that a search has met so far: what an interrupted search ends with.

use std::sync::{Mutex, PoisonError};

use super::coordinates::Candidate;
use super::problem::Problem;

/// How much of a design is checked.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub(super) enum CheckLevel {
    /// The motion alone.
    Motion,
    /// All machines within the tolerances.
    Tolerances,
    /// The trials too.
    Trials,
}

/// The best design of the highest rank.
pub(super) struct Incumbent<'a> {
    problem: &'a Problem,
    best: Mutex<Option<(CheckLevel, f64, Candidate)>>,
}

impl<'a> Incumbent<'a> {
    pub(super) fn new(problem: &'a Problem) -> Self {
        Self {
            problem,
            best: Mutex::new(None),
        }
    }

    /// The best design so far.
    pub(super) fn take(&self) -> Option<Candidate> {
        let mut best = self.best.lock().unwrap_or_else(PoisonError::into_inner);
        best.take().map(|(_, _, candidate)| candidate)
    }

    /// True if a motion of this score would be the best so far.
    pub(super) fn is_beaten_by(&self, score: f64) -> bool {
        let best = self.best.lock().unwrap_or_else(PoisonError::into_inner);
        is_below(best.as_ref(), (CheckLevel::Motion, score))
    }

    /// Replaces the best design by a better one, or by one of a higher rank.
    pub(super) fn update(&self, candidate: &Candidate, rank: CheckLevel) {
        let score = self.problem.score(&candidate.design);
        let mut best = self.best.lock().unwrap_or_else(PoisonError::into_inner);
        if is_below(best.as_ref(), (rank, score)) {
            *best = Some((rank, score, candidate.clone()));
        }
    }
}

fn is_below(best: Option<&(CheckLevel, f64, Candidate)>, other: (CheckLevel, f64)) -> bool {
    best.is_none_or(|(rank, score, _)| (*rank, *score) < other)
}
