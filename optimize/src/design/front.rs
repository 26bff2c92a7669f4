//! Trade-offs: the best designs with a bound of one figure that is moved step by step, each from the one before it
//! (epsilon-constraint continuation).

use super::Design;
use super::coordinates::Summit;
use super::figure::{Figure, Sense};
use super::gradient::{ascend, ascend_from};
use super::problem::Problem;
use super::requirement::Requirement;

/// What is given up for more of what is sought.
#[derive(Debug, Clone)]
pub struct Front {
    /// What is traded for what is sought.
    pub figure: Figure,
    /// Its value, in SI units, and the best value of what is sought, in rising order of the first.
    pub points: Vec<(f64, f64)>,
}

/// Steps to either side of the design.
const STEPS: usize = 6;
/// Share of a bound by which it is moved.
const STEP: f64 = 0.08;
/// Largest margin M, and the step to it.
const WIDEST: f64 = 0.5;
const WIDENING: f64 = 0.05;
/// Change of the traded figure, relative, below which its bound no longer holds the design.
const FREE: f64 = 1e-6;

/// What a figure costs of what is sought, around a design at a point of the unit cube.
pub fn front(problem: &Problem, from: (&[f64], &Design), figure: Figure) -> Front {
    let mut points = match figure {
        Figure::Share => margins(problem, from.0),
        _ => bounds(problem, from, figure),
    };
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    Front { figure, points }
}

/// Over the margin M from both ends of the zone.
fn margins(problem: &Problem, from: &[f64]) -> Vec<(f64, f64)> {
    let mut points = Vec::new();
    let mut unit = from.to_vec();
    for step in 0..=(WIDEST / WIDENING) as usize {
        let wider = Problem {
            margin: step as f64 * WIDENING,
            ..problem.clone()
        };
        if let Some(summit) = ascend(&wider, &unit) {
            points.push((wider.margin, summit.design.value));
            unit = summit.unit;
        }
    }
    points
}

/// Over a bound of a figure, tighter and looser.
fn bounds(problem: &Problem, (unit, design): (&[f64], &Design), figure: Figure) -> Vec<(f64, f64)> {
    let value = |summit: &Summit| summit.design.judged().ok().map(|it| it.value(figure));
    let start = Summit {
        unit: unit.to_vec(),
        design: design.clone(),
    };
    let Some(here) = value(&start).filter(|value| value.is_finite() && *value > 0.0) else {
        return Vec::new();
    };
    let mut points = vec![(here, design.value)];
    for tightening in [-STEP, STEP] {
        let (mut from, mut bound) = (start.clone(), here);
        for _ in 0..STEPS {
            bound *= 1.0 + tightening;
            let bounded = bounded(problem, figure, bound);
            let Some(summit) = ascend_from(&bounded, &from.unit, from.design.place) else {
                break;
            };
            let Some(reached) = value(&summit) else { break };
            points.push((reached, summit.design.value));
            if (reached - bound).abs() > FREE * bound {
                break;
            }
            from = summit;
        }
    }
    points
}

/// The problem with another bound of a figure.
fn bounded(problem: &Problem, figure: Figure, bound: f64) -> Problem {
    let mut bounded = problem.clone();
    bounded.requirements.retain(|it| it.figure != figure);
    let is_least = figure.sense() == Sense::Least;
    bounded.requirements.push(Requirement {
        figure,
        least: is_least.then_some(bound),
        most: (!is_least).then_some(bound),
    });
    bounded
}
