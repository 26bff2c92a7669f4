//! From a task to what came of it.

use anyhow::anyhow;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::keep::Keep;
use softstop_dynamics::basin::{ErosionProfile, zone_box};
use softstop_dynamics::run_up::RunUp;

use super::outcome::{Interrupted, Outcome, PLACES};
use super::progress::Best;
use super::task::Job;
use crate::design::judge::{Met, Within};
use crate::design::search::{Found, SearchError};
use crate::design::solution::{Beside, Solution};
use crate::design::trial::{ANGLES, STARTS};
use crate::design::{Design, Problem};
use crate::robust::Worst;

/// Searches, and looks at what was found; a search that is interrupted ends with its best design, if that is as asked.
pub(super) fn solve(job: &Job, keep: &Keep) -> Result<Outcome, Failure> {
    let budget = job
        .budget
        .windows()
        .saturating_mul(job.settings.evaluations);
    let best = Best::new(&job.problem, job.settings.evaluations, budget);
    let beside = Beside {
        relaxed: job.samples > 0 && job.problem.has_tolerances(),
        fronts: job.report,
        machines: job.samples,
    };
    let outcome = Solution::of(&job.problem, job.settings, beside, (&best, Some(keep)));
    let evaluations = best.evaluations();
    drop(best);
    let mut interrupted = None;
    let solution = match outcome {
        Ok(solution) => solution,
        Err(SearchError::Stopped(Some(found))) => {
            interrupt::save();
            interrupted = Some(Interrupted::Search);
            Solution {
                found: *found,
                deviations: job.problem.deviations,
                relaxed: None,
                fronts: Vec::new(),
            }
        }
        Err(SearchError::Stopped(None)) => return Err(Failure::Interrupted),
        Err(SearchError::OverBudget) => return Err(anyhow!(job.budget.refusal()).into()),
        Err(error) => return Err(Failure::Run(error.into())),
    };
    let Solution {
        found,
        deviations,
        relaxed,
        fronts,
    } = solution;
    let problem = &job.problem.with_deviations(deviations);
    let mut met = met(problem, &found);
    if interrupt::requested() {
        interrupt::save();
        interrupted = Some(Interrupted::Report);
        met = self::met(problem, &found);
    }
    let met = met?;
    // Of an unfinished search nothing is written that is not as asked.
    let is_whole = |design: &Design| met.iter().all(Met::is_met) && problem.has_box(design).is_ok();
    if interrupted == Some(Interrupted::Search) && !is_whole(&found.design) {
        return Err(Failure::Interrupted);
    }
    let design = &found.design;
    let watcher = &interrupt::watch;
    let (erosion, run_up) = match job.report && interrupted.is_none() {
        false => (None, None),
        true => {
            let up = || RunUp::of(&design.orbit, ANGLES, watcher);
            rayon::join(|| erosion(design), || up().ok())
        }
    };
    Ok(Outcome {
        met,
        design: found.design,
        deviations,
        erosion,
        run_up,
        fronts,
        relaxed,
        limits: found.limits,
        rivals: found.rivals,
        evaluations,
        resolution: found.resolution,
        ascents: found.ascents,
        interrupted,
    })
}

/// The integrity along the zone of a design and at the design itself, by the starts that requirements count.
fn erosion(design: &Design) -> Option<ErosionProfile> {
    let watcher = &interrupt::watch;
    let (region, widened) = zone_box(&design.orbit.scene, &design.zone, watcher).ok()?;
    let mut places = ErosionProfile::evenly(PLACES);
    places.push(design.place);
    places.sort_by(f64::total_cmp);
    let mut profile = ErosionProfile::of(&design.zone, &region, (&places, STARTS), watcher).ok()?;
    profile.widened |= widened;
    Some(profile)
}

/// What a design has of all that is required, in its own machine and in the worst within the tolerances.
fn met(problem: &Problem, found: &Found) -> Result<Vec<Met>, Failure> {
    let design = &found.design;
    let motion = design.judged().map_err(anyhow::Error::from)?;
    let mut met = Vec::from_iter(problem.share(&motion));
    let worst = problem.worst_of_required(design);
    met.extend(problem.met(&motion).into_iter().map(|met| {
        let own = worst
            .iter()
            .filter(|(figure, ..)| *figure == met.requirement.figure);
        let own = own.map(|(.., worst)| worst);
        let margin = |it: &&Worst| met.requirement.margin(it.value);
        let nearest = own.min_by(|a, b| margin(a).total_cmp(&margin(b)));
        let is_asked = met.requirement.is_of_each_motion();
        let within = nearest.filter(|_| is_asked).map(|it| Within {
            worst: it.value,
            at: it.at.clone(),
        });
        Met { within, ..met }
    }));
    met.extend(match found.tried.is_empty() {
        true => problem.tried(design).map_err(anyhow::Error::from)?,
        false => found.tried.clone(),
    });
    Ok(met)
}
