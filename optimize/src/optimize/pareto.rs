//! The designs of a front, each looked at as the design of the report is.

use rayon::prelude::*;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::progress::Progress;

use super::met::met;
use super::task::Job;
use crate::design::Problem;
use crate::design::judge::Met;
use crate::design::pareto::{Alternative, Pareto};
use crate::robust::{FITTED, Settings, verify};

/// Machines within the tolerances of each design at least.
const FEWEST_MACHINES: usize = 1 << 12;

/// A front, and what its designs have of all that is required.
#[derive(Debug)]
pub struct CheckedFront {
    /// The designs, all as required.
    pub pareto: Pareto,
    /// What each has of the requirements; none of an interrupted run.
    pub met: Vec<Vec<Met>>,
    /// Machines within the tolerances that were looked at about each, and the largest share of them that violates one requirement
    /// or loses the motion; none if all is exact or they were not looked at.
    pub violating: Option<(usize, Vec<f64>)>,
}

impl CheckedFront {
    /// The designs of a front as they were found.
    pub(super) const fn found(pareto: Pareto) -> Self {
        Self {
            pareto,
            met: Vec::new(),
            violating: None,
        }
    }

    /// Looks at the designs of a front anew, and leaves out what is not as required. The first is the design of the report,
    /// which states what is met.
    pub(super) fn new(problem: &Problem, pareto: Pareto) -> Self {
        let all = pareto.points.par_iter().enumerate();
        let all = all.map(|(index, it)| {
            let design = &it.found.design;
            let met = met(problem, &it.found).ok()?;
            let is_whole = met.iter().all(Met::is_met) && problem.has_box(design).is_ok();
            (is_whole || index == 0).then_some(met)
        });
        let all: Vec<Option<Vec<Met>>> = all.collect();
        if interrupt::requested() {
            return Self::found(pareto);
        }
        let is_kept: Vec<bool> = all.iter().map(Option::is_some).collect();
        Self {
            met: all.into_iter().flatten().collect(),
            pareto: pareto.kept(&is_kept),
            violating: None,
        }
    }

    /// Looks at machines all over the tolerances of each design: together as many as about the design of the report.
    pub(super) fn look_at_machines(&mut self, job: &Job) -> Result<(), Failure> {
        let problem = job.problem.as_built();
        let points = &self.pareto.points;
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
        let share = |point: &Alternative| {
            let design = &point.found.design;
            let spread = problem.spread(&design.machine)?;
            let watcher = progress.watcher();
            let drawn = spread.over(FITTED);
            let verdict = verify(&drawn, &design.orbit, (settings, &required), &watcher).ok()?;
            let most = verdict.violating.iter().copied().max();
            let most = most.unwrap_or(0).max(verdict.lost);
            Some(most as f64 / verdict.machines as f64)
        };
        let shares = points.iter().map(|it| share(it).unwrap_or(f64::NAN));
        let shares: Vec<f64> = shares.collect();
        match interrupt::requested() {
            true => Err(Failure::Interrupted),
            false => {
                self.violating = Some((machines, shares));
                Ok(())
            }
        }
    }
}
