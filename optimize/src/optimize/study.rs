//! What the tolerances do to a design.

use softstop::Parameter;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::progress::Progress;

use crate::design::Design;
use crate::design::problem::Problem;
use crate::robust::{Settings, Tolerance, Tolerances, Verdict, verify};

/// A design's machines within its tolerances.
#[derive(Debug)]
pub struct Study {
    /// Before-impact velocity of the design itself in m/s.
    pub nominal: f64,
    /// What the machines have shown.
    pub verdict: Verdict,
}

/// The tolerances of a problem about a design, in SI units.
fn tolerances(problem: &Problem, design: &Design) -> Vec<Tolerance> {
    let machine = &design.machine;
    let about = problem.tolerances.iter().filter(|it| !it.is_exact());
    let si = |it: &crate::design::problem::Tolerance| {
        let width = it.width.around(machine.value(it.parameter)?);
        let half_width = match it.parameter {
            Parameter::Preload if machine.preload_deflection.is_some() => width,
            parameter => machine.to_si(parameter.about().dimension, width),
        };
        Some(Tolerance {
            parameter: it.parameter,
            half_width,
        })
    };
    about.filter_map(si).collect()
}

/// Looks at machines all over the tolerances; none if everything is exact.
pub(super) fn study(
    problem: &Problem,
    design: &Design,
    machines: usize,
) -> Result<Option<Study>, Failure> {
    let all = tolerances(problem, design);
    if all.is_empty() || machines == 0 {
        return Ok(None);
    }
    let spread = Tolerances::new(&design.machine, &all)?;
    let progress = Progress::new(machines as u64, "machines");
    let settings = Settings {
        machines,
        ..Settings::default()
    };
    let verdict = verify(&spread, &design.orbit, settings, &progress.watcher());
    let verdict = verdict.map_err(anyhow::Error::from)?;
    if interrupt::requested() {
        return Err(Failure::Interrupted);
    }
    Ok(Some(Study {
        nominal: design.before_impact_velocity(),
        verdict,
    }))
}
