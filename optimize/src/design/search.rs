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

use softstop_dynamics::monitor::OptionalMemory;

use super::check_trials::PassedDesign;
use super::critical::CriticalMachines;
use super::design_search::DesignSearch;
pub use super::design_search::{EVALUATIONS_PER_START, LEAST_EVALUATIONS, SearchSettings};
pub use super::found::{Ascents, SearchResult};
use super::incumbent::Incumbent;
pub use super::no_design::SearchError;
use super::robustify::RobustDesign;
use super::survey::Survey;
pub use super::survey::{QuietMonitor, SearchMonitor, Unmonitored};
pub use super::trial_search::Resolution;
use super::{GAIN, Problem};
use crate::order::sort_falling;
/// The feasible design that is best by the problem's objective. What is known of the search is recalled.
///
/// # Errors
/// [`SearchError`] if nothing feasible was met or the watcher stopped the search.
pub fn search(
    problem: &Problem,
    settings: SearchSettings,
    watch: &dyn SearchMonitor,
    kept: OptionalMemory<'_>,
) -> Result<SearchResult, SearchError> {
    search_from(problem, settings, &[], (watch, kept))
}

/// [`search`] with further starts of ascents: points of the unit cube, each with a place of its zone.
///
/// # Errors
/// As [`search`].
pub fn search_from(
    problem: &Problem,
    settings: SearchSettings,
    starts: &[(Vec<f64>, f64)],
    (watch, kept): (&dyn SearchMonitor, OptionalMemory<'_>),
) -> Result<SearchResult, SearchError> {
    let incumbent = Incumbent::new(problem);
    let survey = Survey::new(problem, watch, &incumbent, kept);
    let found = DesignSearch::new(&survey, settings, starts).map(best_over_ranges);
    // What was cut short may be among the best.
    if survey.is_over_budget() {
        return Err(SearchError::OverBudget);
    }
    if watch.stop() {
        let best = incumbent.take().map(|candidate| {
            let known = CriticalMachines::default();
            let untried = PassedDesign {
                robust: RobustDesign { candidate, known },
                tried: Vec::new(),
                resolution: None,
            };
            let problem = problem.on_range_of(&untried.robust.candidate.design);
            Box::new(SearchResult::new(&problem, untried, Vec::new()))
        });
        return Err(SearchError::Stopped(best));
    }
    found.unwrap_or(Err(SearchError::Stopped(None)))
}

/// The best design of a search. Where the branch of a zone folds back, several motions coexist and each ends at a fold of its own:
/// such a zone is searched as a whole, where its hardest motion counts at each frequency, and on each of its ranges apart.
fn best_over_ranges(whole: DesignSearch<'_>) -> Result<SearchResult, SearchError> {
    let survey = whole.survey;
    let problem = survey.problem;
    let on_ranges = (0..whole.most_ranges()).map(|index| Problem {
        range: Some(index),
        ..problem.clone()
    });
    let on_ranges: Vec<Problem> = on_ranges.collect();
    let surveys: Vec<_> = on_ranges.iter().map(|it| survey.of_problem(it)).collect();
    let mut searches: Vec<DesignSearch<'_>> = surveys.iter().map(|it| whole.on_range(it)).collect();
    searches.retain(|it| it.top_score() > 0.0);
    searches.push(whole);
    sort_falling(&mut searches, DesignSearch::top_score);
    let mut best: Option<SearchResult> = None;
    let mut failure = None;
    for search in searches {
        let bound = best.as_ref();
        let bound = bound.map_or(0.0, |it| (1.0 + GAIN) * problem.score(&it.design));
        if best.is_some() && search.top_score() <= bound {
            continue;
        }
        match search.best(bound) {
            Ok(found) if problem.score(&found.design) > bound => best = Some(found),
            Ok(_) => (),
            Err(error) => _ = failure.get_or_insert(error),
        }
    }
    match (best, failure) {
        (Some(found), _) => Ok(found),
        (None, Some(error)) => Err(error),
        (None, None) => Err(SearchError::Stopped(None)),
    }
}

#[cfg(test)]
mod tests {
    use softstop::{Machine, Parameter};

    use super::{SearchSettings, Unmonitored, search};
    use crate::design::certain::{ShareGoal, certain};
    use crate::design::figure::Figure;
    use crate::design::problem::{Problem, Tolerance, Width};
    use crate::design::requirement::Requirement;
    use crate::design::space::{Axis, Interval};

    /// The drawing's machine may go farther than the bound of the force lets the stiffest one within the tolerances.
    #[test]
    fn what_linear_models_lead_to_is_as_required_within_tolerances()
    -> Result<(), Box<dyn std::error::Error>> {
        let clearance = Axis::new(Parameter::Clearance, Interval::new(5.0, 15.0));
        let stiffness = Tolerance::new(Parameter::StopStiffness, Width::Share(0.03));
        let problem = Problem {
            tolerances: vec![stiffness],
            requirements: vec![Requirement::at_most(Figure::StopForce, 74.5)],
            ..Problem::of(
                Machine::named("unloaded").ok_or("the paper's machine")?,
                vec![clearance],
            )
        };
        let found = search(
            &problem,
            SearchSettings { evaluations: 200 },
            &Unmonitored,
            None,
        )?;
        let goal = ShareGoal {
            share: 0.05,
            known: &found.known,
            leaves_out_slow: false,
        };
        let best = certain(&problem, &found.candidate(), goal).ok_or("some share leads there")?;
        assert!(found.known.design(&problem, best.design.clone()).is_some());
        assert!(problem.score(&best.design) > 0.9 * problem.score(&found.design));
        Ok(())
    }
}
