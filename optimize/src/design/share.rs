//! Normal tolerances: how many standard deviations of them a design keeps, so that no more of the machines that are built lose
//! the motion or violate a requirement than may.
//!
//! The search keeps a whole box. What share of the machines that leaves is counted on some thousand of them and judged by the
//! upper end of its interval. If that is too large the box is made wider, and if it need not be so small, narrower: in proportion
//! to the normal quantile of the share, as the width is where one linear bound is violated, within a bracket.

use softstop_console::interrupt;
use softstop_dynamics::basin::wilson_interval;
use softstop_dynamics::monitor::OptionalMemory;

use super::conflict::short;
use super::problem::{Problem, Tolerance};
use super::requirement::{Requirement, Scope};
use super::search::{
    QuietMonitor, SearchError, SearchMonitor, SearchResult, SearchSettings, search, search_from,
};
use super::{Design, Infeasible};
use crate::robust::{self, Verdict, normal_quantile, verify_in_cases};

/// Boxes that are tried at most, and the widest in standard deviations.
const ROUNDS: usize = 16;
const WIDEST: f64 = 8.0;
/// Machines that a report looks at, at most; those that decide are others, which begin there.
pub const MAX_MACHINES: usize = 1 << 26;
/// Part of the machines that is counted first, and the share of what is allowed below which it decides.
const PART: usize = 16;
const FAR: f64 = 0.8;
/// Share of the width, or of the allowed share, within which the narrowest box is found.
const NARROW: f64 = 5e-3;
const CLOSE: f64 = 0.05;

impl Problem {
    /// What is required of the motion of every machine within the tolerances.
    pub fn required_of_each(&self) -> Vec<Requirement> {
        let all = self.requirements.iter().copied();
        all.filter(Requirement::is_of_each_motion).collect()
    }

    /// Whether a box of normal tolerances may be narrower than the share that lies outside it: nothing is asked of its ends but
    /// what is counted.
    fn is_box_free(&self) -> bool {
        let mut tolerances = self.tolerances.iter().filter(|it| !it.is_exact());
        let mut trials = self.requirements.iter().filter(|it| it.figure.is_trial());
        tolerances.all(Tolerance::is_normal)
            && self.objective.scope == Scope::Drawing
            && trials.all(|it| it.scope == Scope::Drawing)
    }

    /// The upper end of the share of the machines that lose the motion or violate a requirement, on a part of them where that
    /// decides; 1 where it cannot be counted.
    pub(super) fn rejected(&self, design: &Design, machines: usize) -> f64 {
        let Some(drawn) = self.drawn(design) else {
            return 1.0;
        };
        let required = self.required_of_each();
        let count = |machines| {
            let settings = robust::VerifySettings {
                machines,
                first: MAX_MACHINES,
                ..robust::VerifySettings::default()
            };
            let verdict = verify_in_cases(&drawn, (settings, &required), &interrupt::watch);
            verdict.map_or([1.0; 2], |verdict| verdict.share_rejected())
        };
        let [low, high] = count(machines / PART);
        match low > self.violating || high < FAR * self.violating {
            true => high,
            false => count(machines)[1],
        }
    }
}

impl Verdict {
    /// Share of the machines that lose the motion or violate a requirement.
    pub fn rejected_share(&self) -> f64 {
        self.rejected as f64 / self.machines as f64
    }

    /// The 95 % interval of the share of the machines that lose the motion or violate a requirement.
    pub fn share_rejected(&self) -> [f64; 2] {
        wilson_interval(self.rejected, self.machines)
    }
}

/// The design of [`search`], and the standard deviations that it keeps: the fewest with which the share that is counted on so
/// many machines may be; those of the problem if nothing has a normal tolerance. False if a search for fewer was interrupted.
///
/// # Errors
/// As [`search`]; [`SearchError::NoDesign`] with the least share if none may be.
pub(super) fn search_with_share(
    problem: &Problem,
    (settings, machines): (SearchSettings, usize),
    (watch, kept): (&dyn SearchMonitor, OptionalMemory<'_>),
) -> Result<(SearchResult, f64, bool), SearchError> {
    let mut outcome = search(problem, settings, watch, kept);
    let mut deviations = problem.deviations;
    if !problem.has_normal_tolerances() {
        return outcome.map(|found| (found, deviations, true));
    }
    let mut too_few = if problem.is_box_free() {
        0.0
    } else {
        deviations
    };
    let mut enough = WIDEST;
    let (mut best, mut lack) = (None, None);
    let mut is_settled = true;
    let mut least_share: f64 = 1.0;
    let mut starts = Vec::new();
    for _ in 0..ROUNDS {
        let mut next = f64::NAN;
        match outcome {
            Ok(found) => {
                let share = problem
                    .with_deviations(deviations)
                    .as_built()
                    .rejected(&found.design, machines);
                if interrupt::requested() {
                    is_settled = false;
                    break;
                }
                let aim = (1.0 - 0.5 * CLOSE) * problem.violating;
                next = deviations * normal_quantile(aim) / normal_quantile(share);
                starts = vec![found.start()];
                least_share = least_share.min(share);
                if share <= problem.violating {
                    enough = deviations;
                    best = Some((found, deviations));
                    if share >= (1.0 - CLOSE) * problem.violating {
                        break;
                    }
                } else {
                    too_few = deviations;
                }
            }
            Err(error @ SearchError::NoDesign { .. }) if too_few < deviations => {
                enough = deviations;
                lack.get_or_insert(error);
            }
            Err(SearchError::Stopped(_)) if least_share < 1.0 => {
                is_settled = false;
                break;
            }
            Err(error) => return Err(error),
        }
        if enough <= too_few * (1.0 + 2.0 * NARROW) {
            break;
        }
        deviations = match next > 0.0 {
            true => next
                .max((1.0 + NARROW) * too_few)
                .min((1.0 - NARROW) * enough),
            false => too_few.midpoint(enough),
        };
        let tried = problem.with_deviations(deviations);
        outcome = search_from(&tried, settings, &starts, (&QuietMonitor(watch), None));
    }
    let failure = match lack.filter(|_| starts.is_empty()) {
        _ if interrupt::requested() => SearchError::Stopped(None),
        Some(lack) => lack,
        None => {
            let reason = format!(
                "a share of {} of the machines as they are built loses the motion or violates a requirement: may be {} at most",
                short(least_share),
                short(problem.violating)
            );
            SearchError::no_design(problem, None, None, Infeasible::unknown(reason))
        }
    };
    let best = best.map(|(found, deviations)| (found, deviations, is_settled));
    best.ok_or(failure)
}
