//! The border of the machines that have a zone. Where a flip or a fold goes, a zone is there at once: the best designs that pass
//! their trials may lie in a strip beside the border that is narrower than any lattice.

use super::problem::Problem;

/// Halvings of a line across the border.
const HALVINGS: u32 = 9;
/// Largest cosine of a direction that leads along the border with the border's normal.
const MAX_COSINE: f64 = 0.4;

impl Problem {
    /// Points of the border between points of the unit cube, of which one has a zone, and others nearer than a distance that
    /// have none.
    pub(super) fn border_between(&self, units: &[Vec<f64>], distance: f64) -> Vec<Vec<f64>> {
        let has_zone = self.have_zones(units);
        let with = |has: bool| units.iter().zip(&has_zone).filter(move |it| *it.1 == has);
        let pairs = with(true).flat_map(|(one, _)| with(false).map(move |(other, _)| (one, other)));
        let near = pairs.filter(|(one, other)| length(&vector(one, other)) < distance);
        self.border_on(near.map(|(one, other)| [one.clone(), other.clone()]))
    }

    /// Points of the border where it goes on from a point that has a zone, in directions of points around it: across the border
    /// from those of them that lie along it. The sum of the directions that lead to no zone tells its normal.
    pub(super) fn border_along(&self, from: &[f64], around: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let has_zone = self.have_zones(around);
        let outside = around.iter().zip(has_zone).filter(|(_, has)| !has);
        let zero = vec![0.0; from.len()];
        let sum = outside.fold(zero, |sum, (unit, _)| moved(&sum, 1.0, &vector(from, unit)));
        let size = length(&sum);
        let lines = around.iter().filter_map(|unit| {
            let step = vector(from, unit);
            // The line across the border reaches as far to both sides as its middle is from here.
            let reach = length(&step) / size;
            let along: f64 = step.iter().zip(&sum).map(|(a, b)| a * b).sum();
            let is_along = along.abs() <= MAX_COSINE * length(&step) * size;
            let end = |sign: f64| moved(unit, sign * reach, &sum).into_iter();
            let line = [-1.0, 1.0].map(|sign| end(sign).map(|at| at.clamp(0.0, 1.0)).collect());
            (is_along && reach.is_finite() && reach > 0.0).then_some(line)
        });
        let lines: Vec<[Vec<f64>; 2]> = lines.collect();
        let has_zone = self.have_zones(&lines.concat());
        let pairs = lines.into_iter().zip(has_zone.chunks(2));
        self.border_on(pairs.filter(|(_, has)| has[0] && !has[1]).map(|it| it.0))
    }

    /// The last points with a zone on lines, each from a point that has one to a point that has none.
    fn border_on(&self, lines: impl Iterator<Item = [Vec<f64>; 2]>) -> Vec<Vec<f64>> {
        let mut lines: Vec<_> = lines.collect();
        for _ in 0..HALVINGS {
            let middles = lines.iter();
            let middles = middles.map(|[one, other]| moved(one, 0.5, &vector(one, other)));
            let middles: Vec<_> = middles.collect();
            let has_zone = self.have_zones(&middles);
            for ((line, middle), has) in lines.iter_mut().zip(middles).zip(has_zone) {
                line[usize::from(!has)] = middle;
            }
        }
        lines.into_iter().map(|[inside, _]| inside).collect()
    }

    /// Whether points of the unit cube have a zone with places that are allowed.
    fn have_zones(&self, units: &[Vec<f64>]) -> Vec<bool> {
        let values: Vec<_> = units.iter().map(|unit| self.axis_values(unit)).collect();
        let windows = self.on_zones(&values, |it| it.window());
        windows.iter().map(Result::is_ok).collect()
    }
}

/// The vector from a point to another.
fn vector(from: &[f64], to: &[f64]) -> Vec<f64> {
    moved(to, -1.0, from)
}

/// A point, moved so many times along a vector.
fn moved(point: &[f64], times: f64, by: &[f64]) -> Vec<f64> {
    point
        .iter()
        .zip(by)
        .map(|(at, by)| at + times * by)
        .collect()
}

fn length(vector: &[f64]) -> f64 {
    vector.iter().map(|it| it * it).sum::<f64>().sqrt()
}
