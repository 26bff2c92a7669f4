//! What a design has of all that is required.

use softstop_console::failure::Failure;

use crate::design::judge::RequirementValue;
use crate::design::operating_point::OperatingPoint;
use crate::design::search::SearchResult;
use crate::design::{Design, Problem};

/// What a design has of all that is required, in its own machine and in the worst within the tolerances, in all cases.
pub(super) fn met(
    problem: &Problem,
    found: &SearchResult,
) -> Result<Vec<RequirementValue>, Failure> {
    let design = &found.design;
    let mut met = Vec::new();
    for OperatingPoint {
        case,
        problem,
        design,
    } in problem.operating_points(design)
    {
        let own = of_motion(&problem, design)?.into_iter();
        met.extend(own.map(|it| RequirementValue { case, ..it }));
    }
    met.extend(match found.tried.is_empty() {
        true => problem.tried(design).map_err(anyhow::Error::from)?,
        false => found.tried.clone(),
    });
    Ok(met)
}

/// What one motion tells, without cases.
fn of_motion(problem: &Problem, design: &Design) -> Result<Vec<RequirementValue>, Failure> {
    let motion = design.judged().map_err(anyhow::Error::from)?;
    let mut met = Vec::from_iter(problem.share(&motion));
    let worst = problem.worst_of_required(design);
    met.extend(problem.met(&motion).into_iter().map(|met| {
        let is_asked = met.requirement.is_of_each_motion();
        let own = worst.iter();
        let own = own.filter(|(figure, ..)| is_asked && *figure == met.requirement.figure);
        let margin = |it: &f64| met.requirement.margin(*it);
        let values = own.map(|(.., worst)| worst.value);
        let worst = values.min_by(|a, b| margin(a).total_cmp(&margin(b)));
        RequirementValue { worst, ..met }
    }));
    Ok(met)
}
