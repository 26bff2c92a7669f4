//! The pictures of a design, one file for each kind: what is computed for it, how it is drawn, and its words.

mod basin;
mod effects;
mod erosion;
mod front;
mod histogram;
mod map;
mod motion;
mod pareto;
mod portrait;
mod response;
mod sketch;

use rayon::join;
use softstop::{Dimension, Machine};

use super::figure::Figure;
use crate::design::Problem;
use crate::optimize::outcome::{Outcome, for_picture};
use crate::optimize::study::ToleranceStudy;

pub use pareto::pareto;
pub use response::response;
pub use sketch::sketch;

/// The pictures of what a run has found, but for the response, and why some are missing.
pub fn figures(
    problem: &Problem,
    outcome: &Outcome,
    study: Option<&ToleranceStudy>,
) -> (Vec<Figure>, Vec<String>) {
    let design = outcome.design();
    let (maps, (motions, basin)) = join(
        || map::maps(problem, design),
        || {
            let basin = || for_picture("the picture of its basins", || basin::basin(design));
            join(|| portrait::motions(design), basin)
        },
    );
    let erosion = outcome.erosion.as_ref();
    let undrawn = [
        erosion.and_then(|it| it.as_ref().err()),
        basin.as_ref().err(),
    ];
    let missing = outcome.solution.missing.iter();
    let missing = missing.chain(undrawn.into_iter().flatten());
    let missing = missing.map(|it| format!("the report goes without {it}"));
    let missing = missing.collect();
    let erosion = erosion.and_then(|it| it.as_ref().ok());
    let fronts = outcome.solution.fronts.iter();
    let mut figures = maps;
    figures.push(sketch::sketch(&design.machine));
    figures.push(motion::motion(design, &motions));
    figures.push(portrait::portrait(design, &motions));
    figures.extend(basin);
    figures.extend(erosion.map(|it| erosion::erosion(problem, design, it)));
    figures.extend(fronts.map(|it| front::front(problem, it)));
    figures.extend(study.map(|it| histogram::histogram(design, it)));
    figures.extend(study.map(|it| effects::effects(&design.machine, it)));
    (figures, missing)
}

/// The label of the before-impact velocity.
fn velocity(machine: &Machine) -> String {
    machine.label("before-impact velocity", "X′₋", Dimension::Velocity)
}
