//! From a task to what came of it.

use anyhow::anyhow;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::keep::{KEPT, Keep};
use softstop_dynamics::basin::{ErosionProfile, zone_box};
use softstop_dynamics::run_up::{RunUp, RunUpSettings};

use super::met::met;
use super::outcome::{Interrupted, Outcome, PLACES, for_picture};
use super::pareto;
use super::progress::SearchProgress;
use super::task::Job;
use crate::design::Design;
use crate::design::figure::Figure;
use crate::design::judge::RequirementValue;
use crate::design::search::SearchError;
use crate::design::solution::{SideTasks, Solution};
use crate::design::trial::{ANGLES, STARTS};

/// Searches, and looks at what was found; a search that is interrupted ends with its best design, if that is as asked.
pub(super) fn solve(job: &Job, keep: &Keep) -> Result<Outcome, Failure> {
    let budget = job
        .budget
        .windows()
        .saturating_mul(job.settings.evaluations);
    let best = SearchProgress::new(&job.problem, job.settings.evaluations, budget);
    let beside = SideTasks {
        relaxed: job.samples > 0 && job.problem.has_tolerances(),
        fronts: job.report,
        machines: job.samples,
    };
    let search = || Solution::of(&job.problem, job.settings, beside, (&best, Some(keep)));
    let outcome = best.while_beating(search);
    let evaluations = best.evaluations();
    drop(best);
    let mut interrupted = None;
    let mut solution = match outcome {
        Ok(solution) => solution,
        Err(SearchError::Stopped(Some(found))) => Solution {
            found: *found,
            deviations: job.problem.deviations,
            is_settled: false,
            relaxed: None,
            fronts: Vec::new(),
            missing: Vec::new(),
            pareto: None,
        },
        Err(SearchError::Stopped(None)) => return Err(interrupted_without_design()),
        Err(SearchError::OverBudget) => return Err(anyhow!(job.budget.refusal()).into()),
        Err(error) => return Err(Failure::Run(error.into())),
    };
    if !solution.is_settled {
        interrupt::save();
        interrupted = Some(Interrupted::Search);
    }
    let problem = &solution.problem(&job.problem);
    let mut met = met(problem, &solution.found);
    if interrupt::requested() {
        interrupt::save();
        interrupted.get_or_insert(Interrupted::Report);
        met = self::met(problem, &solution.found);
    }
    let met = met?;
    // Of an unfinished search nothing is written that is not as asked.
    let is_whole = |design: &Design| {
        met.iter().all(RequirementValue::is_met) && problem.has_box(design).is_ok()
    };
    if interrupted == Some(Interrupted::Search) && !is_whole(&solution.found.design) {
        return Err(interrupted_without_design());
    }
    if let (Some(front), None) = (&mut solution.pareto, interrupted) {
        pareto::judge(problem, front);
    }
    let design = &solution.found.design;
    let watcher = &interrupt::watch;
    let is_required = met.iter().any(|it| it.requirement.figure == Figure::RunUp);
    let is_finished = interrupted.is_none();
    let ways = RunUpSettings {
        with_peaks: true,
        ..job.problem.run_up.clone()
    };
    let basin = || for_picture("the basin along the zone", || erosion(design));
    let up = || RunUp::of(&design.orbit, &ways, ANGLES, watcher).ok();
    let (erosion, run_up) = rayon::join(
        || (is_finished && job.report).then(basin),
        || {
            (is_finished && (job.report || is_required))
                .then(up)
                .flatten()
        },
    );
    Ok(Outcome {
        met,
        without_effect: solution.found.without_effect(problem),
        solution,
        erosion,
        run_up,
        evaluations,
        interrupted,
    })
}

/// What is said of a search that is ended before it has met a design that is as asked.
const NO_DESIGN: &str = "interrupted: no design met so far is as required, so none is written; what is done is kept, and the same line \
                         with --resume goes on from there";

/// Ends an interrupted run, whose closing words say why no design is written beside what is kept.
fn interrupted_without_design() -> Failure {
    let mut under_way = interrupt::under_way();
    if under_way.closing == KEPT {
        under_way.closing = NO_DESIGN;
    }
    Failure::Interrupted
}

/// The integrity along the zone of a design and at the design itself, by the starts that requirements count.
fn erosion(design: &Design) -> anyhow::Result<ErosionProfile> {
    let watcher = &interrupt::watch;
    let (region, widened) = zone_box(&design.orbit.scene, &design.zone, watcher)?;
    let mut places = ErosionProfile::evenly_spaced_places(PLACES);
    places.push(design.place);
    places.sort_by(f64::total_cmp);
    let mut profile = ErosionProfile::of(&design.zone, &region, (&places, STARTS), watcher)?;
    profile.widened |= widened;
    Ok(profile)
}
