//! The best designs that a search has found, until one passes its trials, with other values of catalogues where they fail.

use softstop::internals::budget;

use super::Infeasible;
use super::check_trials::{PassedDesign, TriedDesigns};
use super::coordinates::SearchStart;
use super::distant_values::try_distant_values;
use super::improve_catalogue::CatalogueSearch;
use super::problem::Problem;
use super::robustify::RobustDesign;

/// Designs with other values of catalogues than those of finalists whose trials are made, at most.
const OTHERS: usize = 2;
/// Work that the look at values far from these may cost, in scan windows: some 20 s of a core.
const DISTANT_WINDOWS: u64 = 1 << 31;

/// The best design that passes its trials, and others that do, from designs that keep their box of tolerances, each bettered by
/// exchange of values of catalogues. What is then not better than a bound, or than one that passes, is left out. Where one fails,
/// designs with other values are tried as they are; where all fail, and there is neither a bound nor a front to find, values far
/// from theirs.
///
/// # Errors
/// What each design lacks if none passes.
pub(super) fn check_finalists(
    problem: &Problem,
    finalists: impl IntoIterator<Item = RobustDesign>,
    bound: f64,
    sought_from: &mut Vec<SearchStart>,
) -> Result<(PassedDesign, Vec<PassedDesign>), Vec<Infeasible>> {
    let mut tried = TriedDesigns {
        problem,
        bound,
        passing: Vec::new(),
        failed: Vec::new(),
        sought_from,
    };
    let mut others = 0..OTHERS;
    for finalist in finalists {
        let mut catalogues = CatalogueSearch::new(problem, finalist);
        let best = catalogues.take_best(0.0);
        let Some(best) = best.filter(|it| tried.score(it) > tried.least()) else {
            continue;
        };
        if tried.try_as_is(best) {
            continue;
        }
        tried.seek_from(tried.failed.len() - 1);
        for _ in others.by_ref() {
            let next = catalogues.take_best(tried.least());
            if next.is_none_or(|next| tried.try_as_is(next)) {
                break;
            }
        }
    }
    if tried.passing.is_empty() && bound == 0.0 && problem.traded.is_empty() {
        let known = tried.failed.len();
        let look = || try_distant_values(&mut tried);
        let ((), spent) = budget::run_within(DISTANT_WINDOWS, look);
        if spent >= DISTANT_WINDOWS {
            // What ended then fails for want of work.
            tried.failed.truncate(known);
        }
    }
    tried.into_passing()
}
