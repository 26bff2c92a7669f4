//! The search for the best design: a survey of zones all over the box, ascents with exact derivatives from its best distant
//! points, the box of tolerances, the values beside those of catalogues, and the trials.
//!
//! The survey finds hills: the best design can stand on a narrow ridge. Each ascent (`ascend`) leads to the top of one. The
//! best of these give way until they keep the motion within the whole box of tolerances (`enforce_tolerance_box`); the best
//! of those is compared with what else catalogues hold (`improve_catalogue`) and passes its trials (`check_trials`).
//!
//! The survey sees the unit cube, whose boundary is part of its lattice: many optima stand there. `&Problem` is the cost
//! function of every solver of `argmin` that needs no derivatives.

use std::mem::swap;

use rayon::prelude::*;
use softstop_dynamics::watch::Kept;

use super::ascent::ascend;
pub use super::check_trials::Resolution;
use super::check_trials::check_trials;
use super::conflict::stated;
use super::coordinates::Candidate;
use super::improve_catalogue::improve_catalogue;
use super::incumbent::{Incumbent, Rank};
use super::nearest_miss::nearest_miss;
use super::robustify::{Robust, enforce_tolerance_box};
use super::space::Space;
use super::survey::{Point, Survey};
pub use super::survey::{Unwatched, Watch};
use super::trial::FULL;
use super::{Design, Infeasible, Problem};

/// Fewest zones a search makes sense with.
pub const LEAST_EVALUATIONS: u64 = 100;
/// Share of the evaluations that the survey takes for each coordinate, as 1 / share, and of all coordinates at most.
const SURVEY: u64 = 15;
const LARGEST_SURVEY: u64 = 3;
/// Points from which ascents start. Of many axes, those that the survey leaves of the evaluations, so many for each.
const STARTS: usize = 4;
const MANY_AXES: usize = 6;
const EVALUATIONS_PER_START: u64 = 100;
/// Points of the survey from which ascents start where the best designs had to give way, at most.
const SPARE: usize = 4;
/// How far apart along an axis they are at least, and the cost of a point that has no motion to begin with.
const APART: f64 = 0.12;
const DISTANT: f64 = 10.0;
/// Share of the best score from which another design is a rival.
const RIVAL: f64 = 0.97;
/// Distance along a coordinate that is none.
const SAME: f64 = 1e-5;

/// How to search.
#[derive(Debug, Clone, Copy)]
pub struct Settings {
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
    /// The survey and the ascents from it cost more than they may.
    #[error("over its budget")]
    OverBudget,
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
    let incumbent = Incumbent::new(problem);
    let survey = Survey::new(problem, watch, &incumbent, kept);
    let found = Search::new(&survey, settings).map(|search| search.best());
    // What was cut short may be among the best.
    if survey.is_over_budget() {
        return Err(SearchError::OverBudget);
    }
    if watch.stop() {
        let best = incumbent.take();
        let best = best.map(|it| Box::new(Found::new(problem, it, &[])));
        return Err(SearchError::Stopped(best));
    }
    found.unwrap_or(Err(SearchError::Stopped(None)))
}

impl Found {
    /// The best of some designs, and those that are its rivals.
    fn new(problem: &Problem, best: Candidate, others: &[Candidate]) -> Self {
        let score = |it: &Design| problem.score(it);
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

/// A search after its survey and its ascents.
struct Search<'a> {
    survey: &'a Survey<'a>,
    /// The best point of the survey.
    nearest: Point,
    /// The tops of hills, the best first.
    tops: Vec<Candidate>,
    /// Points of the survey that are apart from those of the ascents, the best first.
    spare: Vec<Point>,
    /// Designs that keep their whole box of tolerances.
    robust: Vec<Robust>,
    /// What the best of the others lacks.
    lack: Option<Infeasible>,
}

impl<'a> Search<'a> {
    /// None if the survey was stopped.
    fn new(survey: &'a Survey<'a>, settings: Settings) -> Option<Self> {
        let problem = survey.problem;
        let dimension = Space(&problem.axes).dimension();
        let share = dimension as u64 * settings.evaluations / SURVEY;
        let share = share.min(settings.evaluations / LARGEST_SURVEY);
        let points = survey.points(share as usize)?;
        let left = (settings.evaluations - share) / EVALUATIONS_PER_START;
        let starts = match dimension < MANY_AXES {
            true => STARTS,
            false => STARTS.max(left as usize),
        };
        let mut apart: Vec<Point> = Vec::new();
        for point in &points {
            let is_new = apart.iter().all(|other| is_apart(&other.unit, &point.unit));
            if apart.len() < starts + SPARE && is_new && point.cost < DISTANT {
                apart.push(point.clone());
            }
        }
        let spare = apart.split_off(starts.min(apart.len()));
        let ascents = apart
            .par_iter()
            .filter_map(|start| survey.charged(|| ascend(problem, &start.unit)));
        let mut search = Self {
            survey,
            nearest: points.into_iter().next()?,
            tops: ascents.collect(),
            spare,
            robust: Vec::new(),
            lack: None,
        };
        search.sort();
        Some(search)
    }

    fn score(&self, it: &Candidate) -> f64 {
        self.survey.problem.score(&it.design)
    }

    /// Puts the best tops first, each but once.
    fn sort(&mut self) {
        let problem = self.survey.problem;
        let score = |it: &Candidate| problem.score(&it.design);
        self.tops.sort_by(|a, b| score(b).total_cmp(&score(a)));
        self.tops.dedup_by(|it, known| is_same(it, known));
    }

    /// The best design with the whole box of tolerances, the neighbours of catalogues and all trials.
    fn best(mut self) -> Result<Found, SearchError> {
        let problem = self.survey.problem;
        if self.tops.is_empty() {
            self.climb_from_nearest()?;
        }
        self.survey.incumbent.update(&self.tops[0], Rank::Motion);
        self.make_robust();
        let Some(first) = self.robust.first() else {
            let unknown = Infeasible {
                gap: 0.0,
                reason: "the search has met nothing".to_owned(),
            };
            return Err(self.no_design(self.lack.clone().unwrap_or(unknown)));
        };
        let improved = improve_catalogue(problem, first);
        let (mut best, resolution) =
            check_trials(problem, improved).map_err(|it| self.no_design(it))?;
        let others = self.robust.iter().map(|it| &it.candidate);
        let others = others.filter(|it| {
            self.score(it) > RIVAL * self.score(&best) && problem.passes(&it.design.orbit, FULL)
        });
        let mut others: Vec<Candidate> = others.cloned().collect();
        let better = others.first_mut();
        if let Some(better) = better.filter(|it| self.score(it) > self.score(&best)) {
            swap(better, &mut best);
        }
        self.survey.incumbent.update(&best, Rank::Trials);
        Ok(Found {
            resolution,
            ..Found::new(problem, best, &others)
        })
    }

    /// Where no ascent met a design: seeks a point that has one without derivatives.
    ///
    /// # Errors
    /// [`SearchError::NoDesign`] if there is none: what the nearest point lacks.
    fn climb_from_nearest(&mut self) -> Result<(), SearchError> {
        let problem = self.survey.problem;
        self.nearest = nearest_miss(self.survey, self.nearest.clone());
        let values = Space(&problem.axes).values(&self.nearest.unit);
        let design = problem.at(&values);
        let design = design.or_else(|_| problem.at_batch(&[values]).remove(0));
        let design = design.map_err(|it| self.no_design(it))?;
        let unit = self.nearest.unit.clone();
        self.tops.extend(ascend(problem, &unit));
        self.tops.push(Candidate { unit, design });
        self.sort();
        Ok(())
    }

    /// Makes tops keep their box of tolerances, as long as they may be rivals of the best, then those of spare points that may
    /// be better.
    fn make_robust(&mut self) {
        for top in self.tops.clone() {
            if self.score(&top) > RIVAL * self.best_robust() {
                self.add_robust(&top);
            }
        }
        for point in std::mem::take(&mut self.spare) {
            if -point.cost <= self.best_robust() {
                continue;
            }
            let top = ascend(self.survey.problem, &point.unit);
            let top = top.filter(|top| !self.tops.iter().any(|other| is_same(other, top)));
            if let Some(top) = top {
                self.add_robust(&top);
                self.tops.push(top);
            }
        }
        let problem = self.survey.problem;
        let score = |it: &Robust| problem.score(&it.candidate.design);
        self.robust.sort_by(|a, b| score(b).total_cmp(&score(a)));
    }

    fn best_robust(&self) -> f64 {
        let scores = self.robust.iter().map(|it| self.score(&it.candidate));
        scores.fold(0.0, f64::max)
    }

    fn add_robust(&mut self, top: &Candidate) {
        match enforce_tolerance_box(self.survey.problem, top) {
            Ok(it) => {
                self.survey
                    .incumbent
                    .update(&it.candidate, Rank::Tolerances);
                self.robust.push(it);
            }
            Err(error) if self.lack.as_ref().is_none_or(|it| error.gap < it.gap) => {
                self.lack = Some(error);
            }
            Err(_) => {}
        }
    }

    /// What the nearest point lacks.
    fn no_design(&self, infeasible: Infeasible) -> SearchError {
        let problem = self.survey.problem;
        let unit = self.tops.first().map_or(&self.nearest.unit, |it| &it.unit);
        let values = Space(&problem.axes).values(unit);
        let values = problem.axes.iter().zip(values);
        let all = values.map(|(axis, value)| stated(&problem.machine, axis.parameter, value));
        let all = all.collect::<Vec<_>>().join(", ");
        SearchError::NoDesign {
            place: match problem.axes.is_empty() {
                true => String::new(),
                false => format!(", at {all}"),
            },
            reason: infeasible.reason,
        }
    }
}

/// True if two candidates are one.
fn is_same(one: &Candidate, other: &Candidate) -> bool {
    let near = |(a, b): (&f64, &f64)| (a - b).abs() < SAME;
    let [a, b] = [one, other].map(|it| it.design.place);
    one.unit.iter().zip(&other.unit).all(near) && near((&a, &b))
}

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
