//! Whether a design is as the problem requires, and what it has of what is sought.

use super::conflict::{conflict, short};
use super::figure::Figure;
use super::judge::violation;
use super::problem::Problem;
use super::{Design, Infeasible};

/// A design with the value of what is sought, if it is as required.
pub(super) fn as_required(problem: &Problem, design: Design) -> Result<Design, Infeasible> {
    let motion = design.judged().map_err(Infeasible::unknown)?;
    let met = problem.met(&motion);
    let gap = violation(&met);
    if gap != 0.0 {
        return Err(Infeasible::new(gap, conflict(motion.machine, &met)));
    }
    let value = problem.sought(&motion).ok_or_else(|| {
        let figure = problem.objective.figure;
        let name = figure.name();
        Infeasible::unknown(match problem.value(&motion, figure) {
            value if value.is_finite() => {
                let value = short(value);
                format!("{name} is {value}: what is sought must be positive")
            }
            _ => match &problem.cost {
                Some(cost) if figure == Figure::Cost => {
                    format!("objective.cost = {cost:?} has no finite value")
                }
                _ => format!("{name} has no value"),
            },
        })
    })?;
    Ok(Design { value, ..design })
}
