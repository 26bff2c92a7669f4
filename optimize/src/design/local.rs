//! What is sought and what must hold at one point of the search, with derivatives.

use softstop::Dimension;

use super::Design;
use super::exact::Exact;
use super::figure::{Figure, Sense};
use super::here::{At, Here};
use super::judge::{Judged, Met};
use super::problem::Problem;
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

/// What is known at a point; none if there is no stable motion.
pub fn local(problem: &Problem, at: &At<'_>) -> Option<Local> {
    let here = Here::find(problem, at)?;
    let motion = here.judged()?;
    let exact = Exact::of(problem, at, &here);
    let slopes = slopes(problem, at, exact.as_ref(), &motion)?;
    let (frequency, figures) = slopes.split_last()?;
    let (sought, required) = figures.split_first()?;
    let score = problem.objective.score(sought.value);
    // d score / d value: 1, or that of the reciprocal.
    let by_value = match problem.objective.sense {
        Sense::Least => 1.0,
        Sense::Most => -score * score,
    };
    let objective = Slope {
        value: score,
        by: sought.by.iter().map(|by| by * by_value).collect(),
    };
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
    if !problem.tolerances.is_empty() {
        let edges = here.box_window(problem)?;
        let exact = exact.as_ref()?;
        constraints.push(exact.inside(frequency.value, &edges.low, 1.0));
        constraints.push(exact.inside(frequency.value, &edges.high, -1.0));
    }
    let is_met = problem.met(&motion).iter().all(Met::is_met);
    let is_good = is_met && here.is_within(problem) && score > 0.0 && score.is_finite();
    let design = is_good.then(|| here.design(sought.value));
    Some(Local {
        objective,
        constraints,
        design,
    })
}

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

/// Half of a difference's width, in edges of the cube.
const WIDTH: f64 = 1e-5;

/// The same with their derivatives, and the drive's frequency: exact ones where the motion has them, differences for the
/// rest.
fn slopes(
    problem: &Problem,
    at: &At<'_>,
    exact: Option<&Exact>,
    motion: &Judged<'_>,
) -> Option<Vec<Slope>> {
    let figures = figures(problem);
    let derivative = |figure: &Figure| exact.and_then(|it| it.by(*figure, motion));
    let mut all: Vec<Option<Vec<f64>>> = figures.iter().map(derivative).collect();
    all.push(exact.map(|it| it.frequency.clone()));
    let value = |motion: &Judged<'_>| {
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
    let values = value(motion)?;
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

/// Central differences of values by each coordinate, one row for each.
fn differences(
    problem: &Problem,
    at: &At<'_>,
    values: &impl Fn(&Judged<'_>) -> Option<Vec<f64>>,
) -> Option<Vec<Vec<f64>>> {
    let count = at.moved.len() + usize::from(at.place.is_some());
    let row = |index: usize| {
        let aside = |by: f64| {
            let (mut unit, mut place) = (at.unit.to_vec(), at.place);
            let moved = at.moved.get(index).and_then(|index| unit.get_mut(*index));
            let coordinate = moved.or(place.as_mut())?;
            *coordinate = (*coordinate + by).clamp(0.0, 1.0);
            let coordinate = *coordinate;
            let aside = At {
                unit: &unit,
                moved: at.moved,
                place,
            };
            let here = Here::find(problem, &aside)?;
            Some((coordinate, values(&here.judged()?)?))
        };
        let ((low, before), (high, after)) = (aside(-WIDTH)?, aside(WIDTH)?);
        let pairs = before.iter().zip(&after);
        Some(
            pairs
                .map(|(before, after)| (after - before) / (high - low))
                .collect(),
        )
    };
    (0..count).map(row).collect()
}
