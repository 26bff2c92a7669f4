//! From a task to what came of it.

use anyhow::anyhow;
use rayon::prelude::*;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::keep::Keep;
use softstop_dynamics::basin::{ErosionProfile, zone_box};
use softstop_dynamics::run_up::RunUp;

use super::outcome::{Interrupted, Outcome, PLACES};
use super::progress::Best;
use super::task::Job;
use crate::design::figure::Figure;
use crate::design::front::{Front, front};
use crate::design::judge::Met;
use crate::design::search::{self, Found, SearchError};
use crate::design::trial::{ANGLES, STARTS};
use crate::design::{Design, Problem};

/// Searches, and looks at what was found; a search that is interrupted ends with its best design, if that is as asked.
pub(super) fn solve(job: &Job, keep: &Keep) -> Result<Outcome, Failure> {
    let budget = job
        .budget
        .windows()
        .saturating_mul(job.settings.evaluations);
    let best = Best::new(&job.problem, job.settings.evaluations, budget);
    let outcome = search::search(&job.problem, job.settings, &best, Some(keep));
    let evaluations = best.evaluations();
    drop(best);
    let mut interrupted = None;
    let found = match outcome {
        Ok(found) => found,
        Err(SearchError::Stopped(Some(found))) => {
            interrupt::save();
            interrupted = Some(Interrupted::Search);
            *found
        }
        Err(SearchError::Stopped(None)) => return Err(Failure::Interrupted),
        Err(SearchError::OverBudget) => return Err(anyhow!(job.budget.refusal()).into()),
        Err(error) => return Err(Failure::Run(error.into())),
    };
    let mut met = met(&job.problem, &found.design);
    if interrupt::requested() {
        interrupt::save();
        interrupted = Some(Interrupted::Report);
        met = self::met(&job.problem, &found.design);
    }
    let met = met?;
    // Of an unfinished search nothing is written that is not as asked.
    let is_whole =
        |design: &Design| met.iter().all(Met::is_met) && job.problem.has_box(design).is_ok();
    if interrupted == Some(Interrupted::Search) && !is_whole(&found.design) {
        return Err(Failure::Interrupted);
    }
    let design = &found.design;
    let watcher = &interrupt::watch;
    let ((erosion, run_up), fronts) = match job.report && interrupted.is_none() {
        false => ((None, None), Vec::new()),
        true => rayon::join(
            || {
                let up = || RunUp::of(&design.orbit, ANGLES, watcher);
                rayon::join(|| erosion(design), || up().ok())
            },
            || fronts(&job.problem, &found),
        ),
    };
    Ok(Outcome {
        met,
        design: found.design,
        erosion,
        run_up,
        fronts,
        rivals: found.rivals,
        evaluations,
        resolution: found.resolution,
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

/// What a design has of all that is required.
fn met(problem: &Problem, design: &Design) -> Result<Vec<Met>, Failure> {
    let motion = design.judged().map_err(anyhow::Error::from)?;
    let mut met = Vec::from_iter(problem.share(&motion));
    met.extend(problem.met(&motion));
    met.extend(problem.tried(&design.orbit).map_err(anyhow::Error::from)?);
    Ok(met)
}

/// What is traded for what is sought.
const TRADED: [Figure; 5] = [
    Figure::Share,
    Figure::Certainty,
    Figure::StopForce,
    Figure::DriveForce,
    Figure::DrivePower,
];

/// What more of one good costs of another, where it costs something.
fn fronts(problem: &Problem, found: &Found) -> Vec<Front> {
    let traded = TRADED.par_iter();
    let traded = traded.filter(|figure| **figure != problem.objective.figure);
    let found = traded.filter_map(|figure| front(problem, (&found.unit, &found.design), *figure));
    found
        .filter(|it| it.points.len() > 2 || it.left_out > 0)
        .collect()
}
