//! What the last stages of a search move: the axes that are no catalogues, and the place in the zone.

use softstop::Parameter;
use softstop_dynamics::spread_points::sobol_point;

use super::Design;
use super::operating_point::SearchPoint;
use super::problem::Problem;
use super::slope::unit_row;

/// A design and its point of the unit cube.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// The point.
    pub unit: Vec<f64>,
    /// The design.
    pub design: Design,
}

/// Largest distance along each coordinate at which two places are one.
const SAME: f64 = 1e-5;

impl Candidate {
    /// Its point of the unit cube and its place in the zone, to start from.
    pub(super) fn start(&self) -> SearchStart {
        (self.unit.clone(), self.design.place)
    }

    /// True if it lies where another one does.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        self.is_at((&other.unit, other.design.place))
    }

    /// True if it lies at a point of the unit cube and a place of its zone.
    pub(super) fn is_at(&self, (unit, place): (&[f64], f64)) -> bool {
        let mut pairs = self
            .unit
            .iter()
            .zip(unit)
            .chain([(&self.design.place, &place)]);
        pairs.all(|(one, other)| (one - other).abs() < SAME)
    }
}

/// A point of the unit cube and a place in its zone, from which something is sought.
pub type SearchStart = (Vec<f64>, f64);

/// The one of the highest score, the last of several.
pub(super) fn best_by<T>(all: impl IntoIterator<Item = T>, score: impl Fn(&T) -> f64) -> Option<T> {
    let mut all = all.into_iter();
    let first = all.next()?;
    Some(
        all.fold(first, |one, other| match score(&other) < score(&one) {
            true => one,
            false => other,
        }),
    )
}

/// Keeps the one of the higher score, of equals what is known.
pub(super) fn keep_best<T>(best: &mut Option<T>, other: T, score: impl Fn(&T) -> f64) {
    if best.as_ref().is_none_or(|best| score(best) < score(&other)) {
        *best = Some(other);
    }
}

/// Distance from the ends of the cube that is none: a solver comes as near to them as that.
const AT_END: f64 = 1e-9;

/// Axes that are moved all at once, at most.
const FEW: usize = 3;

/// The coordinates that are moved.
#[derive(Debug)]
pub(super) struct Coordinates {
    /// A point of the unit cube, of which those of catalogues stay.
    unit: Vec<f64>,
    /// Which are moved.
    moved: Vec<usize>,
    /// Whether the place is, too: the frequency is not held.
    with_place: bool,
}

impl Coordinates {
    /// Those about a point of the unit cube.
    pub(super) fn new(problem: &Problem, unit: &[f64]) -> Self {
        let free = problem.free_axes();
        let moved = free
            .enumerate()
            .filter(|(_, axis)| axis.catalogue.is_empty());
        Self {
            unit: unit.to_vec(),
            moved: moved.map(|(index, _)| index).collect(),
            with_place: !problem.frequency.is_held(),
        }
    }

    /// The parameters of the axes that are moved.
    pub(super) fn parameters(&self, problem: &Problem) -> Vec<Parameter> {
        let free = problem.free_axes();
        let free: Vec<Parameter> = free.map(|axis| axis.parameter).collect();
        self.moved.iter().map(|index| free[*index]).collect()
    }

    /// Those of a point of the cube and a place.
    pub(super) fn start(&self, place: f64) -> Vec<f64> {
        let mut start = self.axes();
        start.extend(self.with_place.then_some(place));
        start
    }

    /// Those of the axes alone.
    pub(super) fn axes(&self) -> Vec<f64> {
        self.moved.iter().map(|index| self.unit[*index]).collect()
    }

    /// The ends of each.
    pub(super) fn bounds(&self, problem: &Problem) -> Vec<(f64, f64)> {
        let margin = problem.margin;
        let place = self.with_place.then_some((margin, 1.0 - margin));
        let moved = self.moved.iter().map(|_| (0.0, 1.0));
        moved.chain(place).collect()
    }

    /// The point of the unit cube.
    pub(super) fn unit(&self, at: &[f64]) -> Vec<f64> {
        let mut unit = self.unit.clone();
        for (index, coordinate) in self.moved.iter().zip(at) {
            let is_end = coordinate.min(1.0 - coordinate) < AT_END;
            unit[*index] = if is_end {
                coordinate.round()
            } else {
                *coordinate
            };
        }
        unit
    }

    /// Points of the unit cube around it: so far along each axis that is moved and, if they are few, along all at once; in each turn
    /// but the first along the reflections of these directions by another hyperplane, as in OrthoMADS (Abramson, Audet, Dennis and Le
    /// Digabel 2009).
    pub(super) fn around(&self, step: f64, turn: usize) -> Vec<Vec<f64>> {
        let count = self.moved.len();
        let normal = sobol_point(turn, count);
        let square: f64 = normal.iter().map(|it| it * it).sum();
        let reflected = |direction: Vec<f64>| {
            let along: f64 = direction.iter().zip(&normal).map(|(a, b)| a * b).sum();
            let pairs = direction.iter().zip(&normal);
            pairs
                .map(|(own, normal)| own - 2.0 * along / square * normal)
                .collect()
        };
        let directions = axes_and_diagonals(count).into_iter();
        let directions = directions.map(|it| if turn == 0 { it } else { reflected(it) });
        let both = directions.flat_map(|it| [step, -step].map(|step| self.moved_by(&it, step)));
        both.collect()
    }

    /// Points of the unit cube on the line from another one through it, beyond it by the distances that are told of the distance
    /// between the two.
    pub(super) fn beyond(
        &self,
        other: &[f64],
        distances: impl Fn(f64) -> [f64; 2],
    ) -> [Vec<f64>; 2] {
        let by = self.moved.iter().map(|it| self.unit[*it] - other[*it]);
        let by: Vec<f64> = by.collect();
        let length = by.iter().map(|it| it * it).sum::<f64>().sqrt();
        let unit: Vec<f64> = by
            .iter()
            .map(|it| it / length.max(f64::MIN_POSITIVE))
            .collect();
        distances(length).map(|distance| self.moved_by(&unit, distance))
    }

    /// The point of the unit cube so many times a vector away, or the nearest one.
    fn moved_by(&self, vector: &[f64], factor: f64) -> Vec<f64> {
        let pairs = self.axes().into_iter().zip(vector);
        let to = pairs.map(|(at, by)| (at + factor * by).clamp(0.0, 1.0));
        self.unit(&to.collect::<Vec<f64>>())
    }

    /// The same for what computes there.
    pub(super) fn at<'a>(&'a self, unit: &'a [f64], at: &[f64]) -> SearchPoint<'a> {
        SearchPoint {
            unit,
            moved: &self.moved,
            place: at
                .get(self.moved.len())
                .copied()
                .filter(|_| self.with_place),
        }
    }
}

/// The directions of the axes and, if they are few, of the diagonals.
fn axes_and_diagonals(count: usize) -> Vec<Vec<f64>> {
    let axes = (0..count).map(|axis| unit_row(count, Some(axis)).collect());
    let diagonals = match count {
        2..=FEW => 1 << (count - 1),
        _ => 0,
    };
    let diagonals = (0..diagonals).map(|signs| {
        let sign = |axis| if signs >> axis & 1 == 1 { 1.0 } else { -1.0 };
        (0..count).map(sign).collect()
    });
    axes.chain(diagonals).collect()
}
