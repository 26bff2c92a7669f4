//! What is sought and what must hold at one point of the search, with derivatives.

use softstop::Dimension;

use super::Design;
use super::differences::differences;
use super::exact::Linearization;
use super::figure::Figure;
use super::judge::{Judged, Met};
use super::operating_point::{At, OperatingPoint};
use super::problem::Problem;
use super::reach::{LossDirections, inside};
use super::requirement::Requirement;
use super::slope::Slope;

/// What is known at a point: what is sought as a score, and constraints, which are met where they are not negative.
#[derive(Debug, Clone)]
pub struct Local {
    /// The score.
    pub objective: Slope,
    /// The constraints, each in units of its bound.
    pub constraints: Vec<Slope>,
    /// The design there, if it is as required.
    pub design: Option<Design>,
}

/// What is known at a point, with what is known of the machines within the tolerances; none if there is no stable motion.
pub fn local(problem: &Problem, at: &At<'_>, known: &LossDirections) -> Option<Local> {
    let here = OperatingPoint::find(problem, at)?;
    let motion = here.judged()?;
    let exact = Linearization::of(problem, at, &here);
    let slopes = slopes(problem, at, exact.as_ref(), (&here, &motion))?;
    let (frequency, figures) = slopes.split_last()?;
    let (sought, required) = figures.split_first()?;
    let objective = problem.objective.slope(sought.clone());
    let score = objective.value;
    let mut constraints = Vec::new();
    for (it, slope) in single(problem).zip(required) {
        for (bound, sign) in [(it.least, 1.0), (it.most, -1.0)] {
            constraints.extend(bound.map(|bound| slope.beyond(bound, sign)));
        }
    }
    let si = |end: f64| problem.machine.to_si(Dimension::Frequency, end);
    match required.get(single(problem).count()) {
        Some(share) => constraints.push(share.beyond(problem.margin, 1.0)),
        None => {
            for (end, sign) in [(problem.frequency.low, 1.0), (problem.frequency.high, -1.0)] {
                if end.is_finite() && end > f64::MIN_POSITIVE {
                    constraints.push(frequency.beyond(si(end), sign));
                }
            }
        }
    }
    let edges = here.box_window(problem)?;
    if let Some(edges) = &edges {
        let exact = exact.as_ref()?;
        let none = || Slope::free(exact.frequency.len());
        let inside = |edge| inside(exact, edge);
        constraints.push(inside(&edges.low)?);
        for edge in &edges.high {
            constraints.push(edge.as_ref().map_or_else(|| Some(none()), inside)?);
        }
    }
    let kept = known.reserves(exact.as_ref())?;
    let is_kept = kept.iter().all(|it| it.value >= -ROUNDING);
    constraints.extend(kept);
    let is_met = problem.met(&motion).iter().all(Met::is_met);
    let is_good = is_met
        && is_kept
        && here.is_within(problem, edges.as_ref())
        && score > 0.0
        && score.is_finite();
    let design = is_good.then(|| here.design(sought.value));
    Some(Local {
        objective,
        constraints,
        design,
    })
}

/// How far outside a bound the solver may leave what it holds.
const ROUNDING: f64 = 1e-9;

/// The requirements that a single motion tells.
fn single(problem: &Problem) -> impl Iterator<Item = &Requirement> {
    problem
        .requirements
        .iter()
        .filter(|it| !it.figure.is_trial())
}

/// The figures of a point: what is sought, what is required, and the share of the zone if the frequency is held.
fn figures(problem: &Problem) -> Vec<Figure> {
    let required = single(problem).map(|it| it.figure);
    let share = problem.frequency.is_held().then_some(Figure::Share);
    let all = [problem.objective.figure]
        .into_iter()
        .chain(required)
        .chain(share);
    all.collect()
}

/// The same with their derivatives, and the drive's frequency: exact ones where the motion has them, differences for the
/// rest.
fn slopes(
    problem: &Problem,
    at: &At<'_>,
    exact: Option<&Linearization<'_>>,
    (here, motion): (&OperatingPoint, &Judged<'_>),
) -> Option<Vec<Slope>> {
    let figures = figures(problem);
    let derivative = |figure: &Figure| exact.and_then(|it| it.by(*figure, motion));
    let mut all: Vec<Option<Vec<f64>>> = figures.iter().map(derivative).collect();
    all.push(exact.map(|it| it.frequency.clone()));
    let value = |here: &OperatingPoint| {
        let motion = &here.judged()?;
        let sought = problem.sought(motion)?;
        let rest = figures[1..].iter().map(|figure| motion.value(*figure));
        let frequency = motion.orbit.scene.excitation.frequency;
        Some(
            [sought]
                .into_iter()
                .chain(rest)
                .chain([frequency])
                .collect::<Vec<f64>>(),
        )
    };
    let values = value(here)?;
    if all.iter().any(Option::is_none) {
        let differences = differences(problem, at, &value)?;
        for (index, by) in all.iter_mut().enumerate() {
            by.get_or_insert_with(|| differences.iter().map(|row| row[index]).collect());
        }
    }
    let pairs = values.into_iter().zip(all);
    let slopes = pairs.map(|(value, by)| Some(Slope { value, by: by? }));
    slopes.collect()
}
