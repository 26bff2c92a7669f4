//! The designs of a front, each looked at as the design of the report is.

use rayon::prelude::*;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::progress::Progress;

use super::met::met;
use super::task::Job;
use crate::design::Problem;
use crate::design::judge::Met;
use crate::design::pareto::Pareto;
use crate::robust::{FITTED, Settings, Verdict, verify};

/// Machines within the tolerances of each design at least.
const FEWEST_MACHINES: usize = 1 << 12;

/// A front whose designs were judged anew.
#[derive(Debug)]
pub struct CheckedFront {
    /// The designs, all as required.
    pub pareto: Pareto,
    /// Machines within the tolerances that were looked at about each; none if all is exact or they were not looked at.
    pub machines: Option<usize>,
}

impl CheckedFront {
    /// The designs of a front as they were found.
    pub(super) const fn found(pareto: Pareto) -> Self {
        Self {
            pareto,
            machines: None,
        }
    }

    /// Judges the designs of a front anew, and leaves out what is not as required. The first is the design of the report, which
    /// states what is met.
    pub(super) fn new(problem: &Problem, mut pareto: Pareto) -> Self {
        let all = pareto.points.par_iter_mut().enumerate();
        let is_kept = all.map(|(index, it)| {
            let Ok(met) = met(problem, &it.found) else {
                return false;
            };
            let has_box = || problem.has_box(&it.found.design).is_ok();
            let is_whole = met.iter().all(Met::is_met) && has_box();
            it.met = met;
            is_whole || index == 0
        });
        let is_kept: Vec<bool> = is_kept.collect();
        match interrupt::requested() {
            true => Self::found(pareto),
            false => {
                pareto.keep(&is_kept);
                Self::found(pareto)
            }
        }
    }

    /// Looks at machines all over the tolerances of each design, together as many as about the design of the report; leaves out
    /// designs of which too many with normal tolerances violate a requirement.
    pub(super) fn look_at_machines(&mut self, job: &Job) -> Result<(), Failure> {
        let problem = job.problem.as_built();
        let points = &mut self.pareto.points;
        if job.samples == 0 || !problem.has_tolerances() || points.is_empty() {
            return Ok(());
        }
        let machines = (job.samples / points.len()).max(FEWEST_MACHINES);
        let settings = Settings {
            machines,
            ..Settings::default()
        };
        let required = problem.required_of_each();
        let progress = Progress::new((machines * points.len()) as u64, "machines of the front");
        let mut is_kept = Vec::new();
        for (index, point) in points.iter_mut().enumerate() {
            let design = &point.found.design;
            let verdict = problem.spread(&design.machine).and_then(|spread| {
                let drawn = spread.over(FITTED);
                let watcher = &progress.watcher();
                verify(&drawn, &design.orbit, (settings, &required), watcher).ok()
            });
            point.violating = verdict.as_ref().map(Verdict::rejected_share);
            let most = verdict.map_or(1.0, |verdict| verdict.share_rejected()[1]);
            is_kept
                .push(index == 0 || !problem.has_normal_tolerances() || most <= problem.violating);
        }
        if interrupt::requested() {
            return Err(Failure::Interrupted);
        }
        self.machines = Some(machines);
        self.pareto.keep(&is_kept);
        Ok(())
    }
}
