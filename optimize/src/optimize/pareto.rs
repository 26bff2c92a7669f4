//! The designs of a front, each looked at as the design of the report is.

use softstop_console::failure::{Failure, check_interrupt};
use softstop_console::interrupt;
use softstop_console::progress::Progress;
use softstop_dynamics::parallel;

use super::met::met;
use super::task::Job;
use crate::design::Problem;
use crate::design::judge::RequirementValue;
use crate::design::pareto::Pareto;
use crate::robust::{FITTED, Verdict, VerifySettings, verify};

/// Machines within the tolerances of each design at least, and in units of the machines among which one may violate a
/// requirement: so many that the share of a design with half of that is surely small enough.
const FEWEST_MACHINES: usize = 1 << 12;
const SHOWING: f64 = 64.0;

/// Judges the designs of a front anew, and leaves out what is not as required. The first is the design of the report, which
/// states what is met.
pub(super) fn judge(problem: &Problem, front: &mut Pareto) {
    let judged = parallel::map(&front.points, |it| {
        let met = met(problem, &it.found).ok()?;
        let has_box = || problem.has_box(&it.found.design).is_ok();
        let is_whole = met.iter().all(RequirementValue::is_met) && has_box();
        Some((met, is_whole))
    });
    let mut is_kept = Vec::new();
    for (index, (it, judged)) in front.points.iter_mut().zip(judged).enumerate() {
        let is_whole = judged.map(|(met, is_whole)| {
            it.met = met;
            is_whole || index == 0
        });
        is_kept.push(is_whole == Some(true));
    }
    if !interrupt::requested() {
        front.keep(&is_kept);
    }
}

/// Looks at machines all over the tolerances of each design of a front, together as many as about the design of the report; leaves
/// out designs of which too many with normal tolerances violate a requirement.
pub(super) fn look_at_machines(job: &Job, front: &mut Pareto) -> Result<(), Failure> {
    let problem = job.problem.as_built();
    let points = &mut front.points;
    if job.samples == 0 || !problem.has_tolerances() || points.is_empty() {
        return Ok(());
    }
    let machines = machines_of_each(&problem, (job.samples, points.len()));
    let settings = VerifySettings::of_machines(machines);
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
        is_kept.push(index == 0 || !problem.has_normal_tolerances() || most <= problem.violating);
    }
    check_interrupt()?;
    front.machines = Some(machines);
    front.keep(&is_kept);
    Ok(())
}

/// Machines to look at about each design: of all together as many as about one, but enough of each to show the share that may
/// violate a requirement, as far as those do.
fn machines_of_each(problem: &Problem, (machines, designs): (usize, usize)) -> usize {
    let showing = match problem.has_normal_tolerances() {
        true => machines.min((SHOWING / problem.violating) as usize),
        false => 0,
    };
    (machines / designs).max(FEWEST_MACHINES).max(showing)
}

#[cfg(test)]
mod tests {
    use super::{Problem, machines_of_each};
    use crate::design::problem::{Tolerance, Width};
    use crate::robust::Distribution;
    use softstop::{Machine, Parameter};
    use softstop_dynamics::basin::wilson_interval;

    #[test]
    fn enough_machines_show_a_small_share() {
        let machine = Machine::named("unloaded").expect("the paper's machine");
        let mut problem = Problem::of(machine, Vec::new());
        assert_eq!(machines_of_each(&problem, (1 << 20, 16)), 1 << 16);
        assert_eq!(machines_of_each(&problem, (1 << 10, 16)), 1 << 12);
        problem.tolerances.push(Tolerance {
            distribution: Distribution::Normal(3.0),
            ..Tolerance::new(Parameter::Clearance, Width::Share(0.01))
        });
        for violating in [1e-4, 2.7e-3] {
            problem.violating = violating;
            let machines = machines_of_each(&problem, (1 << 20, 16));
            let half = (0.5 * violating * machines as f64) as usize;
            assert!(wilson_interval(half, machines)[1] < violating, "{machines}");
        }
        problem.violating = 1e-5;
        assert_eq!(machines_of_each(&problem, (1 << 20, 16)), 1 << 20);
    }
}
