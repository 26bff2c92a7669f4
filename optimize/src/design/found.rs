//! What a search has found: the best design, its rivals, and how it goes on from a better one that is met elsewhere.

use serde::Serialize;

use super::ascent::ascend_from;
use super::check_finalists::check_finalists;
use super::check_trials::PassedDesign;
use super::constraint::ActiveLimit;
use super::coordinates::{Candidate, SearchStart};
use super::critical::CriticalMachines;
use super::judge::RequirementValue;
use super::multipliers::{ActiveLimits, held};
use super::robustify::{RobustDesign, enforce_tolerance_box, keep_as_is};
use super::trial_search::{COUNTED_GAIN, Resolution};
use super::{Design, GAIN, Problem};
use crate::order::sort_falling;

/// Share of the best score from which another design is a rival.
pub(super) const RIVAL: f64 = 0.97;
/// Distance along an axis, as a share of its range, from which on two designs are different hills.
pub(super) const APART: f64 = 0.12;

/// What a search has found.
#[derive(Debug, Clone)]
pub struct SearchResult {
    /// The best design.
    pub design: Design,
    /// Its point of the unit cube.
    pub unit: Vec<f64>,
    /// Machines within its tolerances that it has to keep within bounds.
    pub known: CriticalMachines,
    /// All that holds it back.
    pub limits: Vec<ActiveLimit>,
    /// Rate of the score, relative, by the edges of the unit cube, that nothing of it holds back; NaN where it is unknown.
    pub residue: f64,
    /// Others, far from it and nearly as good: a small change of the task can make one of them the best.
    pub rivals: Vec<Design>,
    /// What it has of what is tried; nothing of a search that was stopped.
    pub tried: Vec<RequirementValue>,
    /// How fine it was looked for, if trials were in the way.
    pub resolution: Option<Resolution>,
    /// What it took.
    pub ascents: Ascents,
    /// Where designs lie that keep their box and fail their trials, from which one that passes was sought.
    pub sought_from: Vec<SearchStart>,
}

/// The ascents of a search.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Ascents {
    /// All from distant points.
    pub made: usize,
    /// The last of them, as many as have bettered nothing.
    pub idle: usize,
    /// Distant points with a motion beyond as many as the evaluations allow.
    pub left_out: usize,
}

impl SearchResult {
    /// The best of some designs, and those of the others that are its rivals.
    pub(super) fn new(problem: &Problem, passed: PassedDesign, others: Vec<Design>) -> Self {
        let score = |it: &Design| problem.score(it);
        let best = passed.robust;
        let ActiveLimits { limits, residue } = held(problem, &best.candidate, &best.known);
        let mut all = vec![best.candidate.design];
        for other in others {
            let is_new = all.iter().all(|known| is_another(problem, known, &other));
            if is_new && score(&other) > RIVAL * score(&all[0]) {
                all.push(other);
            }
        }
        let rivals = all.split_off(1);
        Self {
            design: all.remove(0),
            unit: best.candidate.unit,
            known: best.known,
            limits,
            residue,
            rivals,
            tried: passed.tried,
            resolution: passed.resolution,
            ascents: Ascents::default(),
            sought_from: Vec::new(),
        }
    }

    /// Its place, to start from.
    pub fn start(&self) -> SearchStart {
        (self.unit.clone(), self.design.place)
    }

    pub(super) fn candidate(&self) -> Candidate {
        Candidate {
            unit: self.unit.clone(),
            design: self.design.clone(),
        }
    }

    /// Takes the design of another search, which is the better one or as good.
    pub(super) fn take_design(&mut self, problem: &Problem, other: &Self) {
        let problem = &problem.on_range_of(&other.design);
        let ActiveLimits { limits, residue } = held(problem, &other.candidate(), &other.known);
        *self = Self {
            limits,
            residue,
            rivals: std::mem::take(&mut self.rivals),
            sought_from: std::mem::take(&mut self.sought_from),
            ascents: self.ascents,
            ..other.clone()
        };
    }

    /// Goes on from a design of a problem like this one: true if that has led to a better design.
    pub fn go_on_from(&mut self, problem: &Problem, from: &Candidate) -> bool {
        let problem = &problem.on_range_of(&from.design);
        let mut start = from.clone();
        if let Some(design) = start.design.clone().with_own_values(problem) {
            start.design = design;
        }
        let place = (&start.unit[..], start.design.place);
        let top = ascend_from(problem, &CriticalMachines::default(), place);
        let start = Some(start).filter(|it| problem.is_allowed(&it.design));
        // Where trials hold a design back, its box moves it to one that fails them.
        let unmoved = start.as_ref().and_then(|it| keep_as_is(problem, it));
        let starts = start.into_iter().chain(top);
        let robust = starts.filter_map(|it| enforce_tolerance_box(problem, &it).ok());
        let robust = unmoved.into_iter().chain(robust);
        let score = |it: &RobustDesign| problem.score(&it.candidate.design);
        let is_counted = self.known.all_failed().next().is_some();
        let gain = if is_counted { COUNTED_GAIN } else { GAIN };
        let least = (1.0 + gain) * problem.score(&self.design);
        let mut finalists: Vec<RobustDesign> = robust.filter(|it| score(it) > least).collect();
        finalists.reverse();
        sort_falling(&mut finalists, score);
        finalists.dedup_by(|it, known| it.candidate.is_same(&known.candidate));
        let passing = check_finalists(problem, finalists, least, &mut self.sought_from);
        let passed = passing.ok().map(|(best, _)| best);
        let Some(passed) = passed.filter(|it| score(&it.robust) > least) else {
            return false;
        };
        let mut others = std::mem::take(&mut self.rivals);
        others.push(self.design.clone());
        *self = Self {
            ascents: self.ascents,
            sought_from: std::mem::take(&mut self.sought_from),
            ..Self::new(problem, passed, others)
        };
        true
    }
}

/// True if two designs differ by more than a small part of the range of some axis.
pub(super) fn is_another(problem: &Problem, one: &Design, other: &Design) -> bool {
    problem.axes.iter().any(|axis| {
        let [one, other] = [one, other].map(|it| it.machine.value(axis.parameter).unwrap_or(0.0));
        axis.apart(one, other) > APART
    })
}
