//! One search after its survey: ascents from distant points, the box of tolerances, and the trials of the best designs.

use softstop_dynamics::parallel;

use super::ascent::{ascend, ascend_from};
use super::check_finalists::check_finalists;
use super::coordinates::Candidate;
use super::critical::CriticalMachines;
use super::found::{APART, Ascents, RIVAL, SearchResult, is_another};
use super::incumbent::CheckLevel;
use super::nearest_miss::nearest_miss;
use super::no_design::SearchError;
use super::robustify::{RobustDesign, enforce_tolerance_box};
use super::survey::{Survey, SurveyPoint};
use super::trial::FULL;
use super::{DISTANT, Design, GAIN, Infeasible};
use crate::order::sort_falling;
/// Fewest zones a search makes sense with.
pub const LEAST_EVALUATIONS: u64 = 100;
/// Share of the evaluations that the survey takes for each coordinate, as 1 / share, and of all coordinates at most.
const SURVEY: u64 = 15;
const LARGEST_SURVEY: u64 = 3;
/// Points from which ascents start at once: where as many better nothing, no more are made.
const STARTS: usize = 4;
/// Points of the survey whose zones have several ranges from which ascents start on each of these.
const STARTS_ON_RANGES: usize = 2;
/// What each ascent counts of the evaluations that the survey leaves.
pub const EVALUATIONS_PER_START: u64 = 80;
/// Designs whose catalogues and trials are looked at, at most, until one passes.
const FINALISTS: usize = 3;

/// How to search.
#[derive(Debug, Clone, Copy)]
pub struct SearchSettings {
    /// Zones to compute at most, at least [`LEAST_EVALUATIONS`].
    pub evaluations: u64,
}

/// A search after its survey and its ascents.
pub(super) struct DesignSearch<'a> {
    pub survey: &'a Survey<'a>,
    /// The best point of the survey, and how many it has.
    nearest: SurveyPoint,
    surveyed: usize,
    /// The tops of hills, the best first.
    tops: Vec<Candidate>,
    /// Points of the survey that are apart from those of the ascents, the best first.
    spare: Vec<SurveyPoint>,
    /// The best points of the survey whose zones have several ranges.
    folded: Vec<SurveyPoint>,
    /// Designs that keep their whole box of tolerances.
    robust: Vec<RobustDesign>,
    /// What the best of the others lacks.
    lack: Option<Infeasible>,
    ascents: Ascents,
}

impl<'a> DesignSearch<'a> {
    /// None if the survey was stopped.
    pub fn new(
        survey: &'a Survey<'a>,
        settings: SearchSettings,
        starts: &[(Vec<f64>, f64)],
    ) -> Option<Self> {
        let problem = survey.problem;
        let dimension = problem.free_axes().count();
        let share = dimension as u64 * settings.evaluations / SURVEY;
        let share = share.min(settings.evaluations / LARGEST_SURVEY);
        let points = survey.points(share as usize)?;
        let most = STARTS.max(((settings.evaluations - share) / EVALUATIONS_PER_START) as usize);
        let mut apart: Vec<SurveyPoint> = Vec::new();
        for point in &points {
            let is_new = apart.iter().all(|other| is_apart(&other.unit, &point.unit));
            if is_new && point.cost < DISTANT {
                apart.push(point.clone());
            }
        }
        let folded = points.iter().filter(|it| it.ranges > 1);
        let folded: Vec<SurveyPoint> = folded.take(STARTS_ON_RANGES).cloned().collect();
        let left_out = apart.len().saturating_sub(most);
        apart.truncate(most);
        let known = CriticalMachines::default();
        let given = parallel::filter_map(starts, |(unit, place)| {
            survey.charged(|| ascend_from(problem, &known, (unit, *place)))
        });
        let mut search = Self {
            survey,
            surveyed: points.len(),
            nearest: points.into_iter().next()?,
            tops: given,
            spare: apart,
            folded,
            robust: Vec::new(),
            lack: None,
            ascents: Ascents {
                left_out,
                ..Ascents::default()
            },
        };
        search.ascend_from_spare();
        search.sort();
        Some(search)
    }

    /// Ascends from the next spare points; true if there were any.
    fn ascend_from_spare(&mut self) -> bool {
        let count = STARTS.min(self.spare.len());
        let points: Vec<SurveyPoint> = self.spare.drain(..count).collect();
        let survey = self.survey;
        self.tops.extend(parallel::filter_map(&points, |start| {
            survey.charged(|| ascend(survey.problem, &start.unit))
        }));
        self.ascents.made += count;
        count > 0
    }

    fn score(&self, it: &Candidate) -> f64 {
        self.survey.problem.score(&it.design)
    }

    /// Puts the best tops first, each but once.
    fn sort(&mut self) {
        let problem = self.survey.problem;
        sort_falling(&mut self.tops, |it| problem.score(&it.design));
        self.tops.dedup_by(|it, known| it.is_same(known));
    }

    /// The most ranges of a zone of its tops and of the points of the survey that have several; 0 if none has.
    pub fn most_ranges(&self) -> usize {
        let surveyed = self.folded.iter().map(|it| it.ranges);
        let tops = self.tops.iter().filter(|it| has_ranges(it));
        let tops = tops.map(|it| it.design.zone.ranges().len());
        surveyed.chain(tops).max().unwrap_or(0)
    }

    /// A search on a range of the zones that have several, from where these are.
    pub fn on_range<'b>(&self, survey: &'b Survey<'b>) -> DesignSearch<'b> {
        let tops = self.tops.iter().filter(|it| has_ranges(it));
        let folded = self.folded.iter().map(|it| &it.unit);
        let units: Vec<_> = tops.map(|it| &it.unit).chain(folded).collect();
        let tops = parallel::filter_map(&units, |unit| {
            survey.charged(|| ascend(survey.problem, unit))
        });
        let mut search = DesignSearch {
            survey,
            surveyed: self.surveyed,
            nearest: self.nearest.clone(),
            tops,
            spare: Vec::new(),
            folded: Vec::new(),
            robust: Vec::new(),
            lack: None,
            ascents: self.ascents,
        };
        search.sort();
        search
    }

    /// The score of the best top; that of none is below all.
    pub fn top_score(&self) -> f64 {
        let top = self.tops.first();
        top.map_or(f64::NEG_INFINITY, |it| self.score(it))
    }

    /// The best design with the whole box of tolerances, the neighbours of catalogues and all trials, if its score is above a bound.
    pub fn best(mut self, bound: f64) -> Result<SearchResult, SearchError> {
        let problem = self.survey.problem;
        if self.tops.is_empty() {
            self.climb_from_nearest()?;
        }
        self.survey
            .incumbent
            .update(&self.tops[0], CheckLevel::Motion);
        self.make_robust();
        if self.robust.is_empty() {
            let lack = self.lack.take().unwrap_or_else(Infeasible::stopped);
            return Err(self.no_design(lack));
        }
        let mut finalists: Vec<&RobustDesign> = Vec::new();
        for robust in &self.robust {
            let design = &robust.candidate.design;
            let is_new = |it: &&RobustDesign| is_another(problem, &it.candidate.design, design);
            if finalists.len() < FINALISTS && finalists.iter().all(is_new) {
                finalists.push(robust);
            }
        }
        let mut sought_from = Vec::new();
        let finalists = finalists.into_iter().cloned();
        let passing = check_finalists(problem, finalists, bound, &mut sought_from);
        let failed = |failed| SearchError::none_passes(problem, self.surveyed, failed);
        let (passed, others) = passing.map_err(failed)?;
        let best = &passed.robust;
        let score = self.score(&best.candidate);
        let others = others.into_iter().map(|it| it.robust.candidate.design);
        let mut others: Vec<Design> = others.collect();
        let rivals = self.robust.iter().filter(|it| {
            (RIVAL * score..=score).contains(&self.score(&it.candidate))
                && problem.passes(&it.candidate.design, &best.known, FULL)
        });
        others.extend(rivals.map(|it| it.candidate.design.clone()));
        let incumbent = self.survey.incumbent;
        incumbent.update(&best.candidate, CheckLevel::Trials);
        Ok(SearchResult {
            ascents: self.ascents,
            sought_from,
            ..SearchResult::new(problem, passed, others)
        })
    }

    /// Where no ascent met a design: seeks a point that has one without derivatives.
    ///
    /// # Errors
    /// [`SearchError::NoDesign`] if there is none: what the nearest point lacks.
    fn climb_from_nearest(&mut self) -> Result<(), SearchError> {
        let problem = self.survey.problem;
        self.nearest = nearest_miss(self.survey, self.nearest.clone());
        let values = problem.axis_values(&self.nearest.unit);
        let design = problem.at(&values);
        let design = design.or_else(|_| problem.at_batch(&[values]).remove(0));
        let unit = self.nearest.unit.clone();
        let design = design.map_err(|lack| self.no_design(lack.at(&unit)))?;
        self.tops.extend(ascend(problem, &unit));
        self.tops.push(Candidate { unit, design });
        self.sort();
        Ok(())
    }

    /// Makes tops keep their box of tolerances, as long as they may be rivals of the best, and ascends from spare points until
    /// that betters nothing.
    fn make_robust(&mut self) {
        let mut done: Vec<Candidate> = Vec::new();
        loop {
            let before = self.best_robust();
            for top in self.tops.clone() {
                let is_new = !done.iter().any(|other| other.is_same(&top));
                if is_new && self.score(&top) > RIVAL * self.best_robust() {
                    self.add_robust(&top);
                    done.push(top);
                }
            }
            let is_better = self.best_robust() > (1.0 + GAIN) * before;
            let idle = STARTS.min(self.ascents.made);
            self.ascents.idle = if is_better { 0 } else { idle };
            let is_stopped = self.survey.watch.stop() || self.survey.is_over_budget();
            if !is_better || is_stopped || !self.ascend_from_spare() {
                break;
            }
            self.sort();
        }
        let problem = self.survey.problem;
        sort_falling(&mut self.robust, |it| problem.score(&it.candidate.design));
        self.robust
            .dedup_by(|it, known| it.candidate.is_same(&known.candidate));
    }

    fn no_design(&self, lack: Infeasible) -> SearchError {
        SearchError::no_design(self.survey.problem, Some(self.surveyed), None, lack)
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
                    .update(&it.candidate, CheckLevel::Tolerances);
                self.robust.push(it);
            }
            Err(lack) => self.lack = Some(lack.nearer(self.lack.take())),
        }
    }
}

/// True if the zone of a design has several ranges.
fn has_ranges(it: &Candidate) -> bool {
    it.design.zone.ranges().len() > 1
}

/// True if two points of the cube are not one hill's.
fn is_apart(one: &[f64], other: &[f64]) -> bool {
    let far = |(a, b): (&f64, &f64)| (a - b).abs() > APART;
    one.iter().zip(other).any(far)
}
