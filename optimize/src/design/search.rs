//! The search for the best design: a survey of zones all over the box, ascents with exact derivatives from its best distant
//! points, the box of tolerances, the values beside those of catalogues, and the trials.
//!
//! The survey finds hills: the best design can stand on a narrow ridge. Each ascent (`ascend`) leads to the top of one. The
//! best of these give way until they keep the whole box of tolerances (`enforce_tolerance_box`). Ascents go on from further
//! points until some of them in a row have bettered nothing, or the evaluations are spent. The best design is compared with
//! what else catalogues hold (`improve_catalogue`) and passes its trials (`check_trials`).
//!
//! The survey sees the unit cube, whose boundary is part of its lattice: many optima stand there. `&Problem` is the cost
//! function of every solver of `argmin` that needs no derivatives.

use softstop::internals::plain_number;
use softstop_dynamics::monitor::OptionalMemory;
use softstop_dynamics::parallel;
use softstop_dynamics::zone::ZoneKind;

use super::ascent::{ascend, ascend_from};
use super::check_finalists::check_finalists;
use super::check_trials::{Passed, Refusal};
use super::conflict::stated;
use super::coordinates::Candidate;
use super::critical::CriticalMachines;
use super::found::{APART, GAIN, RIVAL, is_another};
pub use super::found::{Ascents, Found};
use super::incumbent::{Incumbent, Rank};
use super::nearest_miss::nearest_miss;
use super::robustify::{Robust, enforce_tolerance_box};
use super::space::{Axis, Interval};
use super::survey::{Point, Survey};
pub use super::survey::{Quiet, Unwatched, Watch};
use super::trial::FULL;
pub use super::trial_search::Resolution;
use super::{Infeasible, Problem};
use crate::order::sort_falling;

/// Fewest zones a search makes sense with.
pub const LEAST_EVALUATIONS: u64 = 100;
/// Share of the evaluations that the survey takes for each coordinate, as 1 / share, and of all coordinates at most.
const SURVEY: u64 = 15;
const LARGEST_SURVEY: u64 = 3;
/// Points from which ascents start at once: where as many better nothing, no more are made.
const STARTS: usize = 4;
/// What each ascent counts of the evaluations that the survey leaves.
pub const EVALUATIONS_PER_START: u64 = 80;
/// The cost of a point that has no motion to begin with.
const DISTANT: f64 = 10.0;
/// Designs whose catalogues and trials are looked at, at most, until one passes.
const FINALISTS: usize = 3;

/// How to search.
#[derive(Debug, Clone, Copy)]
pub struct Settings {
    /// Zones to compute at most, at least [`LEAST_EVALUATIONS`].
    pub evaluations: u64,
}

/// Why a search has no design to show.
#[derive(Debug, thiserror::Error)]
pub enum SearchError {
    /// Nothing that was met within the bounds is feasible.
    #[error("{found}; nearest try{place}: {reason}")]
    NoDesign {
        /// What was looked for and where, in words.
        found: String,
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

impl SearchError {
    /// Nothing feasible was met of a problem whose survey saw so many machines, if it was that which met nothing, and of which
    /// trials were made with so many of all choices from catalogues: more is not said than that.
    pub(super) fn no_design(
        problem: &Problem,
        surveyed: Option<usize>,
        choices: Option<[usize; 2]>,
        (place, reason): (String, String),
    ) -> Self {
        let zone = match problem.zone {
            ZoneKind::Hysteresis => "in a hysteresis zone ",
            ZoneKind::SingleImpact { .. } => "",
        };
        let sought = format!("stable z = 1 motion {zone}");
        let found = match surveyed.zip(widest(problem)) {
            Some((surveyed, widest)) => format!(
                "found no {sought}that is as the task asks; the survey saw {surveyed} machines on a logarithmic lattice: narrow {widest}"
            ),
            None => match choices {
                Some([tried, all]) => format!(
                    "found no {sought}that is as the task asks; what takes many motions was tried with {tried} of {all} choices from \
                     catalogues"
                ),
                None => format!("no {sought}is as the task asks within the bounds"),
            },
        };
        Self::NoDesign {
            found,
            place,
            reason,
        }
    }
}

/// The axes that are searched by their logarithms, the widest first; none if there are none.
fn widest(problem: &Problem) -> Option<String> {
    let axes = problem.axes.iter();
    let wide = axes.filter_map(|axis| Some((axis, axis.decades()?)));
    let mut wide: Vec<(&Axis, f64)> = wide.collect();
    sort_falling(&mut wide, |it| it.1);
    let stated = |(axis, _): &(&Axis, f64)| {
        let Interval { low, high } = axis.range;
        let name = problem.machine.name(axis.parameter);
        format!("{name} = [{}, {}]", plain_number(low), plain_number(high))
    };
    let stated: Vec<String> = wide.iter().map(stated).collect();
    (!stated.is_empty()).then(|| stated.join(", "))
}

/// The feasible design that is best by the problem's objective. What is known of the search is recalled.
///
/// # Errors
/// [`SearchError`] if nothing feasible was met or the watcher stopped the search.
pub fn search(
    problem: &Problem,
    settings: Settings,
    watch: &dyn Watch,
    kept: OptionalMemory<'_>,
) -> Result<Found, SearchError> {
    search_from(problem, settings, &[], (watch, kept))
}

/// [`search`] with further starts of ascents: points of the unit cube, each with a place of its zone.
///
/// # Errors
/// As [`search`].
pub fn search_from(
    problem: &Problem,
    settings: Settings,
    starts: &[(Vec<f64>, f64)],
    (watch, kept): (&dyn Watch, OptionalMemory<'_>),
) -> Result<Found, SearchError> {
    let incumbent = Incumbent::new(problem);
    let survey = Survey::new(problem, watch, &incumbent, kept);
    let found = Search::new(&survey, settings, starts).map(|search| search.best());
    // What was cut short may be among the best.
    if survey.is_over_budget() {
        return Err(SearchError::OverBudget);
    }
    if watch.stop() {
        let best = incumbent.take().map(|candidate| {
            let known = CriticalMachines::default();
            let untried = Passed::as_is(Robust { candidate, known }, Vec::new());
            Box::new(Found::new(problem, untried, &[]))
        });
        return Err(SearchError::Stopped(best));
    }
    found.unwrap_or(Err(SearchError::Stopped(None)))
}

/// A search after its survey and its ascents.
struct Search<'a> {
    survey: &'a Survey<'a>,
    /// The best point of the survey, and how many it has.
    nearest: Point,
    surveyed: usize,
    /// The tops of hills, the best first.
    tops: Vec<Candidate>,
    /// Points of the survey that are apart from those of the ascents, the best first.
    spare: Vec<Point>,
    /// Designs that keep their whole box of tolerances.
    robust: Vec<Robust>,
    /// What the best of the others lacks.
    lack: Option<Infeasible>,
    ascents: Ascents,
}

impl<'a> Search<'a> {
    /// None if the survey was stopped.
    fn new(survey: &'a Survey<'a>, settings: Settings, starts: &[(Vec<f64>, f64)]) -> Option<Self> {
        let problem = survey.problem;
        let dimension = problem.free_axes().count();
        let share = dimension as u64 * settings.evaluations / SURVEY;
        let share = share.min(settings.evaluations / LARGEST_SURVEY);
        let points = survey.points(share as usize)?;
        let most = STARTS.max(((settings.evaluations - share) / EVALUATIONS_PER_START) as usize);
        let mut apart: Vec<Point> = Vec::new();
        for point in &points {
            let is_new = apart.iter().all(|other| is_apart(&other.unit, &point.unit));
            if is_new && point.cost < DISTANT {
                apart.push(point.clone());
            }
        }
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
        let points: Vec<Point> = self.spare.drain(..count).collect();
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

    /// The best design with the whole box of tolerances, the neighbours of catalogues and all trials.
    fn best(mut self) -> Result<Found, SearchError> {
        let problem = self.survey.problem;
        if self.tops.is_empty() {
            self.climb_from_nearest()?;
        }
        self.survey.incumbent.update(&self.tops[0], Rank::Motion);
        self.make_robust();
        if self.robust.is_empty() {
            let unknown = Infeasible {
                gap: 0.0,
                reason: "the search has met nothing".to_owned(),
            };
            return Err(self.no_design(self.lack.clone().unwrap_or(unknown)));
        }
        let mut finalists: Vec<&Robust> = Vec::new();
        for robust in &self.robust {
            let design = &robust.candidate.design;
            let is_new = |it: &&Robust| is_another(problem, &it.candidate.design, design);
            if finalists.len() < FINALISTS && finalists.iter().all(is_new) {
                finalists.push(robust);
            }
        }
        let mut sought_from = Vec::new();
        let finalists = finalists.into_iter().cloned();
        let passing = check_finalists(problem, finalists, 0.0, &mut sought_from);
        let mut passing = passing
            .map_err(|refusal| self.no_design(refusal))?
            .into_iter();
        let Some(passed) = passing.next() else {
            return Err(self.no_design(Infeasible::unknown("stopped")));
        };
        let best = &passed.robust;
        let others = passing.map(|it| it.robust.candidate);
        let rivals = self.robust.iter();
        let rivals = rivals.filter(|it| {
            let score = self.score(&it.candidate);
            (RIVAL * self.score(&best.candidate)..=self.score(&best.candidate)).contains(&score)
                && problem.passes(&it.candidate.design, &best.known, FULL)
        });
        let rivals = rivals.map(|it| it.candidate.clone());
        let others: Vec<Candidate> = others.chain(rivals).collect();
        let incumbent = self.survey.incumbent;
        incumbent.update(&best.candidate, Rank::Trials);
        Ok(Found {
            ascents: self.ascents,
            sought_from,
            ..Found::new(problem, passed, &others)
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
        let design = design.map_err(|it| self.no_design(it))?;
        let unit = self.nearest.unit.clone();
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
            self.ascents.idle = if is_better {
                0
            } else {
                STARTS.min(self.ascents.made)
            };
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
    fn no_design(&self, refusal: impl Into<Refusal>) -> SearchError {
        let problem = self.survey.problem;
        let Refusal {
            lack,
            unit,
            choices,
        } = refusal.into();
        let top = self.tops.first().map_or(&self.nearest.unit, |it| &it.unit);
        let values =
            problem.axis_values(unit.as_ref().filter(|_| choices.is_some()).unwrap_or(top));
        let values = problem.axes.iter().zip(values);
        let all = values.map(|(axis, value)| stated(&problem.machine, axis.parameter, value));
        let all = all.collect::<Vec<_>>().join(", ");
        let place = match problem.axes.is_empty() {
            true => String::new(),
            false => format!(", at {all}"),
        };
        SearchError::no_design(problem, Some(self.surveyed), choices, (place, lack.reason))
    }
}

/// True if two points of the cube are not one hill's.
fn is_apart(one: &[f64], other: &[f64]) -> bool {
    let far = |(a, b): (&f64, &f64)| (a - b).abs() > APART;
    one.iter().zip(other).any(far)
}

#[cfg(test)]
mod tests {
    use softstop::{Machine, Parameter};

    use super::{Axis, Problem, SearchError};

    #[test]
    fn of_catalogues_and_trials_no_more_is_said_than_what_was_tried() {
        let machine = Machine::named("unloaded").expect("the paper's machine");
        let axis = Axis::of_catalogue(Parameter::Damping, vec![1e-6, 0.02]);
        let problem = Problem::of(machine, vec![axis]);
        let says = |choices| {
            let nowhere = (String::new(), String::new());
            SearchError::no_design(&problem, Some(9), choices, nowhere).to_string()
        };
        assert!(says(None).starts_with("no stable z = 1 motion"));
        let words = says(Some([1, 2]));
        assert!(words.starts_with("found no"), "{words}");
        assert!(words.contains("tried with 1 of 2 choices from catalogues"));
    }
}
