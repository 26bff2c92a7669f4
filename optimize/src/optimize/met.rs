//! What a design has of all that is required.

use softstop_console::failure::Failure;

use crate::design::judge::{Met, Within};
use crate::design::operating_point::OperatingPoint;
use crate::design::search::Found;
use crate::design::{Design, Problem};
use crate::robust::Worst;

/// What a design has of all that is required, in its own machine and in the worst within the tolerances, in all cases.
pub(super) fn met(problem: &Problem, found: &Found) -> Result<Vec<Met>, Failure> {
    let design = &found.design;
    let mut met = Vec::new();
    for OperatingPoint {
        case,
        problem,
        design,
    } in problem.operating_points(design)
    {
        let own = of_motion(&problem, design)?.into_iter();
        met.extend(own.map(|it| Met { case, ..it }));
    }
    met.extend(match found.tried.is_empty() {
        true => problem.tried(design).map_err(anyhow::Error::from)?,
        false => found.tried.clone(),
    });
    Ok(met)
}

/// What one motion tells, without cases.
fn of_motion(problem: &Problem, design: &Design) -> Result<Vec<Met>, Failure> {
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
    Ok(met)
}
