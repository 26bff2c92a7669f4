//! The outer search over the axes: a survey on a lattice, a particle swarm that starts from it until it gains little,
//! gradients from the best particle and from the best points far from it, then
//! Nelder-Mead from the best of them, restarted with a fresh, smaller simplex until nothing is gained. The survey is
//! there because the best design can stand on a narrow ridge that a random swarm misses; Nelder-Mead is, because it can
//! stand where gradients end: where a zone gains a second fold inside it, the velocity jumps. What was found has to keep
//! its whole box of tolerances (`hold`), is compared with what else catalogues hold (`exchange`), and has to pass its
//! trials (`pass`).
//!
//! All see the unit cube. The swarm keeps to it by itself; Nelder-Mead does not, so points
//! outside are pulled in, and an optimum on the boundary (common here) is met exactly.

use std::mem::swap;
use std::slice;

use argmin::core::Error;
use rayon::prelude::*;
use softstop_dynamics::watch::Kept;

use super::conflict::stated;
use super::coordinates::Summit;
use super::cost::{Cost, Point, Rank};
pub use super::cost::{Unwatched, Watch};
use super::exchange::exchange;
use super::gradient::ascend;
use super::hold::{Held, hold};
pub use super::pass::Resolution;
use super::pass::pass;
use super::polish::polish;
use super::space::Space;
use super::survey::survey;
use super::swarm::swarm_best;
use super::trial::FULL;
use super::{Design, Infeasible, Problem};

/// Fewest zones a search makes sense with.
pub const LEAST_EVALUATIONS: u64 = 100;
/// Share of the evaluations that the survey takes for each coordinate, as 1 / share.
const SURVEY: u64 = 15;
/// Points from which gradients are followed, how far apart along an axis they are at least, and the gap of a point that
/// has no motion to begin with.
const STARTS: usize = 4;
const APART: f64 = 0.12;
const DISTANT: f64 = 10.0;
/// Share of the best score from which another design is a rival.
const RIVAL: f64 = 0.97;

/// How to search.
#[derive(Debug, Clone, Copy)]
pub struct Settings {
    /// The same seed gives the same result, on any number of cores.
    pub seed: u64,
    /// Zones to compute at most, at least [`LEAST_EVALUATIONS`].
    pub evaluations: u64,
}

/// Why a search has no design to show.
#[derive(Debug, thiserror::Error)]
pub enum SearchError {
    /// Nothing within the bounds is feasible.
    #[error(
        "no stable z = 1 motion in a hysteresis zone is as the task asks within the bounds; nearest try{place}: {reason}"
    )]
    NoDesign {
        /// The least infeasible point: names and values.
        place: String,
        /// What is wrong there.
        reason: String,
    },
    /// The watcher said stop; the best design until then, if there was one that is as asked as far as was looked at.
    #[error("stopped")]
    Stopped(Option<Box<Found>>),
    /// Survey, swarm and polish cost more than they may.
    #[error("over its budget")]
    OverBudget,
    /// The optimiser failed.
    #[error("the optimiser failed: {0}")]
    Optimizer(#[from] Error),
}

/// What a search has found.
#[derive(Debug, Clone)]
pub struct Found {
    /// The best design.
    pub design: Design,
    /// Its point of the unit cube.
    pub unit: Vec<f64>,
    /// Others, far from it and nearly as good: a small change of the task can make one of them the best.
    pub rivals: Vec<Design>,
    /// How fine it was looked for, if trials were in the way.
    pub resolution: Option<Resolution>,
}

/// The feasible design that is best by the problem's objective. What is known of the search is recalled.
///
/// # Errors
/// [`SearchError`] if nothing feasible was met or the watcher stopped the search.
pub fn search(
    problem: &Problem,
    settings: Settings,
    watch: &dyn Watch,
    kept: Kept<'_>,
) -> Result<Found, SearchError> {
    let cost = Cost::new(problem, watch, kept);
    let found = outer(&cost, settings).and_then(|seen| match cost.is_over_budget() {
        true => Err(SearchError::OverBudget),
        false => finish(&cost, seen),
    });
    // What was cut short may be among the best.
    if cost.is_over_budget() {
        return Err(SearchError::OverBudget);
    }
    if watch.stop() {
        let best = cost.best().map(|it| Box::new(Found::new(problem, it, &[])));
        return Err(SearchError::Stopped(best));
    }
    found
}

impl Found {
    /// The best of some designs, and those that are its rivals.
    fn new(problem: &Problem, best: Summit, others: &[Summit]) -> Self {
        let score = |it: &Design| problem.objective.score(it.value);
        let mut all = vec![best.design];
        for other in others {
            let is_new = all
                .iter()
                .all(|known| is_another(problem, known, &other.design));
            if is_new && score(&other.design) > RIVAL * score(&all[0]) {
                all.push(other.design.clone());
            }
        }
        let rivals = all.split_off(1);
        Self {
            design: all.remove(0),
            unit: best.unit,
            rivals,
            resolution: None,
        }
    }
}

/// What the outer search has seen.
struct Seen {
    /// Its best point.
    best: Vec<f64>,
    /// What gradients have found, the best first.
    summits: Vec<Summit>,
    /// Points of the survey that are apart from those from which gradients were followed, the best first.
    spare: Vec<Point>,
}

/// The best design of what was seen, with the whole box of tolerances, the neighbours of catalogues and all trials.
fn finish(cost: &Cost<'_>, seen: Seen) -> Result<Found, SearchError> {
    let problem = cost.problem;
    let values = Space(&problem.axes).values(&seen.best);
    let none = |infeasible: Infeasible| SearchError::NoDesign {
        place: place(problem, &values),
        reason: infeasible.reason,
    };
    let polished = problem
        .at(&values)
        .or_else(|_| problem.soon(slice::from_ref(&values)).remove(0));
    let polished = polished.map(|design| Summit {
        unit: seen.best,
        design,
    });
    if let (Err(infeasible), true) = (&polished, seen.summits.is_empty()) {
        return Err(none(infeasible.clone()));
    }
    let score = |it: &Summit| problem.objective.score(it.design.value);
    let mut starts: Vec<Summit> = polished.into_iter().chain(seen.summits).collect();
    starts.sort_by(|a, b| score(b).total_cmp(&score(a)));
    let mut held: Vec<Held> = Vec::new();
    let mut lack: Option<Infeasible> = None;
    let mut take = |start: &Summit, held: &mut Vec<Held>| match hold(problem, start) {
        Ok(it) => {
            cost.note(&it.summit, Rank::Held);
            held.push(it);
        }
        Err(error) if lack.as_ref().is_none_or(|known| error.gap < known.gap) => lack = Some(error),
        Err(_) => {}
    };
    let best = |held: &[Held]| held.iter().map(|it| score(&it.summit)).fold(0.0, f64::max);
    for (index, start) in starts.iter().enumerate() {
        let is_known = starts[..index].iter().any(|other| is_same(other, start));
        if !is_known && score(start) > RIVAL * best(&held) {
            take(start, &mut held);
        }
    }
    for point in &seen.spare {
        if -point.cost > best(&held) {
            let start = ascend(problem, &point.unit);
            let start = start.filter(|start| !starts.iter().any(|other| is_same(other, start)));
            if let Some(start) = start {
                take(&start, &mut held);
                starts.push(start);
            }
        }
    }
    held.sort_by(|a, b| score(&b.summit).total_cmp(&score(&a.summit)));
    let Some(first) = held.first() else {
        let reason = || "the search has met nothing".to_owned();
        return Err(none(lack.unwrap_or_else(|| Infeasible {
            gap: 0.0,
            reason: reason(),
        })));
    };
    let exchanged = exchange(problem, first);
    let (mut best, resolution) = pass(problem, exchanged).map_err(none)?;
    let others = held.into_iter().map(|it| it.summit);
    let mut others: Vec<Summit> = others
        .filter(|it| score(it) > RIVAL * score(&best) && problem.passes(&it.design.orbit, FULL))
        .collect();
    if let Some(better) = others.first_mut().filter(|it| score(it) > score(&best)) {
        swap(better, &mut best);
    }
    cost.note(&best, Rank::Passed);
    Ok(Found {
        resolution,
        ..Found::new(problem, best, &others)
    })
}

/// Points of the survey from which a search goes on where the best designs had to give way, at most.
const SPARE: usize = 4;

/// True if two designs are one.
fn is_same(one: &Summit, other: &Summit) -> bool {
    let near = |(a, b): (&f64, &f64)| (a - b).abs() < SAME;
    let [a, b] = [one, other].map(|it| it.design.place);
    one.unit.iter().zip(&other.unit).all(near) && near((&a, &b))
}

/// Distance along a coordinate that is none.
const SAME: f64 = 1e-5;

/// True if two designs differ by more than a small part of the range of some axis.
fn is_another(problem: &Problem, one: &Design, other: &Design) -> bool {
    problem.axes.iter().any(|axis| {
        let [one, other] = [one, other].map(|it| it.machine.value(axis.parameter).unwrap_or(0.0));
        (one - other).abs() > APART * (axis.range.high - axis.range.low)
    })
}

/// True if two points of the cube are not one hill's.
fn is_apart(one: &[f64], other: &[f64]) -> bool {
    let far = |(a, b): (&f64, &f64)| (a - b).abs() > APART;
    one.iter().zip(other).any(far)
}

/// Values in words, after "nearest try".
fn place(problem: &Problem, values: &[f64]) -> String {
    if values.is_empty() {
        return String::new();
    }
    let said = problem.axes.iter().zip(values);
    let said = said.map(|(axis, value)| stated(&problem.machine, axis.parameter, *value));
    format!(", at {}", said.collect::<Vec<_>>().join(", "))
}

/// Survey, swarm, gradients and polish.
fn outer(cost: &Cost<'_>, settings: Settings) -> Result<Seen, SearchError> {
    let dimension = cost.space.dimension();
    if dimension == 0 {
        cost.watch.evaluated(None);
        return Ok(Seen {
            best: Vec::new(),
            summits: Vec::from_iter(ascend(cost.problem, &[])),
            spare: Vec::new(),
        });
    }
    let share = (dimension as u64 * settings.evaluations) / SURVEY;
    let survey = survey(cost, share.min(settings.evaluations / 3))?;
    let left = settings.evaluations.saturating_sub(survey.len() as u64);
    let swarm = left * 2 / 3;
    let best = swarm_best(cost, &survey, settings.seed, swarm)?;
    let mut starts = vec![best.clone()];
    for point in &survey {
        let is_new = starts
            .iter()
            .all(|start| is_apart(&start.unit, &point.unit));
        if starts.len() < STARTS + SPARE && is_new && point.cost < DISTANT {
            starts.push(point.clone());
        }
    }
    let spare = starts.split_off(STARTS.min(starts.len()));
    let ascents = starts
        .par_iter()
        .map(|start| ascend(cost.problem, &start.unit));
    let mut summits: Vec<Summit> = ascents.collect::<Vec<_>>().into_iter().flatten().collect();
    let score = |it: &Summit| cost.problem.objective.score(it.design.value);
    summits.sort_by(|a, b| score(b).total_cmp(&score(a)));
    if let Some(summit) = summits.first() {
        cost.note(summit, Rank::Seen);
    }
    let summit = summits.first().map(|it| Point {
        unit: it.unit.clone(),
        cost: -score(it),
    });
    let start = [Some(best), summit].into_iter().flatten();
    let start = start.min_by(|a, b| a.cost.total_cmp(&b.cost));
    let start = start.ok_or_else(|| Error::msg("the swarm is empty"))?;
    Ok(Seen {
        best: polish(cost, start, left - swarm)?.unit,
        summits,
        spare,
    })
}
