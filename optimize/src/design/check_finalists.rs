//! The best designs that a search has found, until one passes its trials, with other values of catalogues where they fail.

use softstop::internals::budget;

use super::check_trials::{Checked, Passed, Refusal, check_trials};
use super::coordinates::SearchStart;
use super::distant_values::check_distant_values;
use super::improve_catalogue::CatalogueSearch;
use super::problem::Problem;
use super::robustify::Robust;

/// Designs with other values of catalogues than those of finalists whose trials are made, at most.
const OTHERS: usize = 2;
/// Work that the look at values far from these may cost, in scan windows: some 20 s of a core.
const DISTANT_WINDOWS: u64 = 1 << 31;

/// The best designs that pass their trials, in falling order, from designs that keep their box of tolerances, each bettered by
/// exchange of values of catalogues. What is then not better than a bound, or than one that passes, is left out. Where one fails,
/// designs with other values are tried as they are; where all fail, and there is neither a bound nor a front to find, values far
/// from theirs.
///
/// # Errors
/// [`Refusal`] if none passes.
pub(super) fn check_finalists(
    problem: &Problem,
    finalists: impl IntoIterator<Item = Robust>,
    bound: f64,
    sought_from: &mut Vec<SearchStart>,
) -> Result<Vec<Passed>, Refusal> {
    let mut checked = Checked {
        problem,
        bound,
        passing: Vec::new(),
        failed: Vec::new(),
    };
    let mut others = 0..OTHERS;
    for finalist in finalists {
        let mut catalogues = CatalogueSearch::new(problem, finalist);
        let best = catalogues.take_best(0.0);
        let Some(mut best) = best.filter(|it| checked.score(it) > checked.least()) else {
            continue;
        };
        let passed = check_trials(problem, &mut best, sought_from);
        if checked.note(best, passed) {
            continue;
        }
        for _ in others.by_ref() {
            let Some(mut next) = catalogues.take_best(checked.least()) else {
                break;
            };
            let passed = problem.pass_trials(&next.candidate.design, &mut next.known);
            let passed = passed.map(|tried| Passed::as_is(next.clone(), tried));
            if checked.note(next, passed) {
                break;
            }
        }
    }
    if checked.passing.is_empty() && bound == 0.0 && problem.traded.is_empty() {
        let known = checked.failed.len();
        let look = || check_distant_values(&mut checked, sought_from);
        let ((), spent) = budget::within(DISTANT_WINDOWS, look);
        if spent >= DISTANT_WINDOWS {
            // What ended then fails for want of work.
            checked.failed.truncate(known);
        }
    }
    checked.into_passing()
}
