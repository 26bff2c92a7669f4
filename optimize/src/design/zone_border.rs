//! The border of the machines that have a zone. Where a flip goes, a zone is there at once: the designs that pass their trials may
//! lie in a strip beside the border that is narrower than any lattice.

use super::problem::Problem;

/// Halvings of the distance between a point that has a zone and one that has none.
const HALVINGS: u32 = 10;

impl Problem {
    /// Points of the unit cube that have a zone, at its border: between each of some points that has one and each that has none
    /// and is nearer than a distance.
    pub(super) fn border_between(&self, units: &[Vec<f64>], distance: f64) -> Vec<Vec<f64>> {
        let is_near = |one: &[f64], other: &[f64]| {
            let squares = one.iter().zip(other).map(|(a, b)| (a - b).powi(2));
            squares.sum::<f64>().sqrt() < distance
        };
        let has_zone = self.have_zones(units);
        let with = |has: bool| units.iter().zip(&has_zone).filter(move |it| *it.1 == has);
        let pairs = with(true).flat_map(|(one, _)| with(false).map(move |(other, _)| (one, other)));
        let near = pairs.filter(|(one, other)| is_near(one, other));
        let mut lines: Vec<_> = near
            .map(|(one, other)| [one.clone(), other.clone()])
            .collect();
        for _ in 0..HALVINGS {
            let middle = |[one, other]: &[Vec<f64>; 2]| {
                let pairs = one.iter().zip(other);
                pairs.map(|(a, b)| a.midpoint(*b)).collect()
            };
            let middles: Vec<Vec<f64>> = lines.iter().map(middle).collect();
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
