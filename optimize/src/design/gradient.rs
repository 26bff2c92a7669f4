//! The gradient stage of the search: sequential quadratic programming (Kraft 1988, the crate `slsqp`) over the axes and
//! the place in the zone, with the derivatives of [`local`](super::local).

use std::cell::RefCell;

use slsqp::{Func, StopTols, minimize};

use super::Design;
use super::coordinates::{Coordinates, Summit};
use super::local::{Local, local};
use super::problem::Problem;
use super::reach::Known;
use super::slope::Slope;
use super::space::Space;

/// Designs that one ascent looks at, at most.
const MOST: usize = 60;
/// Changes of score and coordinates, relative and in edges of the cube, that are too small to go on.
const GAIN: f64 = 1e-12;
const STEP: f64 = 1e-11;
/// By how much each constraint is to be met, in its own unit: more than the solver leaves open.
const SLACK: f64 = 1e-10;
/// What stands where there is no motion: far above every score, which are about -1.
const NOWHERE: f64 = 1e3;

/// The best design that the gradients lead to from a point of the unit cube, and from its best place, with its own point;
/// none if there is none on the way.
pub(super) fn ascend(problem: &Problem, unit: &[f64]) -> Option<Summit> {
    let values = Space(&problem.axes).values(unit);
    let start = problem.soon(&[values]).remove(0);
    ascend_from(problem, unit, start.map_or(0.5, |design| design.place))
}

/// The same from a place of its zone.
pub(super) fn ascend_from(problem: &Problem, unit: &[f64], place: f64) -> Option<Summit> {
    ascend_known(problem, &Known::default(), unit, place)
}

/// The same with what is known of the machines within the tolerances.
pub(super) fn ascend_known(
    problem: &Problem,
    known: &Known,
    unit: &[f64],
    place: f64,
) -> Option<Summit> {
    let path = Path::new(problem, known, unit, place)?;
    if path.start.is_empty() {
        return path.best.into_inner();
    }
    let bounds = path.coordinates.bounds(problem);
    let constraint = |index| {
        move |at: &[f64], gradient: Option<&mut [f64]>, path: &mut &Path<'_>| {
            path.constraint(index, at, gradient)
        }
    };
    let constraints: Vec<_> = (0..path.constraints).map(constraint).collect();
    let constraints: Vec<&dyn Func<&Path<'_>>> = constraints.iter().map(|it| it as _).collect();
    let tolerances = StopTols {
        ftol_rel: GAIN,
        xtol_abs: vec![STEP; path.start.len()],
        ..StopTols::default()
    };
    let objective = |at: &[f64], gradient: Option<&mut [f64]>, path: &mut &Path<'_>| {
        path.objective(at, gradient)
    };
    let start = path.start.clone();
    // What it found is kept on the way; the solver's own verdict is not needed.
    let _ = minimize(
        objective,
        &start,
        &bounds,
        &constraints,
        &path,
        MOST,
        Some(tolerances),
    );
    path.best.into_inner()
}

/// What the solver has seen.
struct Path<'a> {
    problem: &'a Problem,
    known: Known,
    coordinates: Coordinates,
    start: Vec<f64>,
    /// Score at the start: the unit of the objective.
    score: f64,
    constraints: usize,
    last: RefCell<Option<(Vec<f64>, Option<Local>)>>,
    best: RefCell<Option<Summit>>,
}

impl<'a> Path<'a> {
    fn new(problem: &'a Problem, known: &Known, unit: &[f64], place: f64) -> Option<Self> {
        let coordinates = Coordinates::new(problem, unit);
        let mut path = Self {
            problem,
            known: known.clone(),
            start: coordinates.start(place),
            coordinates,
            score: 1.0,
            constraints: 0,
            last: RefCell::default(),
            best: RefCell::default(),
        };
        let start = path.start.clone();
        let (score, constraints) = path.with(&start, |first| {
            let first = first?;
            Some((first.objective.value, first.constraints.len()))
        })?;
        path.score = score.abs().max(f64::MIN_POSITIVE);
        path.constraints = constraints;
        Some(path)
    }

    /// What is known at a point.
    fn compute(&self, at: &[f64]) -> Option<Local> {
        let unit = self.coordinates.unit(at);
        local(self.problem, &self.coordinates.at(&unit, at), &self.known)
    }

    /// The same, once for all that the solver asks of one point.
    fn with<T>(&self, at: &[f64], take: impl FnOnce(Option<&Local>) -> T) -> T {
        let known = matches!(&*self.last.borrow(), Some((other, _)) if other == at);
        if !known {
            let mut found = self.compute(at);
            if let Some(design) = found.as_mut().and_then(|it| it.design.take()) {
                let mut best = self.best.borrow_mut();
                let score = |design: &Design| self.problem.objective.score(design.value);
                if best
                    .as_ref()
                    .is_none_or(|best| score(&design) > score(&best.design))
                {
                    let unit = self.coordinates.unit(at);
                    *best = Some(Summit { unit, design });
                }
            }
            self.last.replace(Some((at.to_vec(), found)));
        }
        let last = self.last.borrow();
        take(last.as_ref().and_then(|(_, found)| found.as_ref()))
    }

    fn objective(&self, at: &[f64], gradient: Option<&mut [f64]>) -> f64 {
        let factor = -1.0 / self.score;
        self.with(at, |found| {
            told(found.map(|it| &it.objective), factor, 0.0, gradient)
        })
    }

    fn constraint(&self, index: usize, at: &[f64], gradient: Option<&mut [f64]>) -> f64 {
        self.with(at, |found| {
            let slope = found.and_then(|it| it.constraints.get(index));
            told(slope, -1.0, SLACK, gradient)
        })
    }
}

/// A value and its gradient in the solver's sign.
fn told(slope: Option<&Slope>, factor: f64, offset: f64, gradient: Option<&mut [f64]>) -> f64 {
    if let Some(gradient) = gradient {
        gradient.fill(0.0);
        let by = slope.into_iter().flat_map(|slope| &slope.by);
        for (to, by) in gradient.iter_mut().zip(by) {
            *to = factor * by;
        }
    }
    slope.map_or(NOWHERE, |slope| factor * slope.value + offset)
}
