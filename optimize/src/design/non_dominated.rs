//! Which of some points no other one dominates.

use crate::order::sort_falling;

/// Difference, in units of the range of each coordinate, below which two points are one.
const SAME: f64 = 1e-6;

/// The points that no other one dominates.
#[derive(Debug, PartialEq)]
pub(super) struct NonDominated {
    /// Which, the one with the largest first coordinate first.
    pub members: Vec<usize>,
    /// The place among them of the one that is nearest to the largest of each coordinate, in units of their ranges.
    pub nearest: usize,
}

/// The points that no other one dominates, whose coordinates are the better the larger. Of points that differ by next to nothing it has one.
pub(super) fn non_dominated(points: &[Vec<f64>]) -> NonDominated {
    let scaled = scaled(points);
    let sum = |index: &usize| scaled[*index].iter().sum::<f64>();
    let mut order: Vec<usize> = (0..points.len()).collect();
    // What dominates a point has the larger sum.
    sort_falling(&mut order, sum);
    let mut members: Vec<usize> = Vec::new();
    for index in order {
        let covers = |other: &usize| {
            let mut pairs = scaled[*other].iter().zip(&scaled[index]);
            pairs.all(|(other, own)| *other >= own - SAME)
        };
        if !members.iter().any(covers) {
            members.push(index);
        }
    }
    sort_falling(&mut members, |index| points[*index][0]);
    let own: Vec<Vec<f64>> = members.iter().map(|index| points[*index].clone()).collect();
    let distance = |at: &Vec<f64>| at.iter().map(|it| (1.0 - it).powi(2)).sum::<f64>();
    let distances = self::scaled(&own);
    let distances = distances.iter().map(distance).enumerate();
    let nearest = distances.min_by(|a, b| a.1.total_cmp(&b.1));
    NonDominated {
        members,
        nearest: nearest.map_or(0, |(index, _)| index),
    }
}

/// Points in units of the range of each coordinate, from 0 to 1; a coordinate without range is 1.
fn scaled(points: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let ends = |coordinate: usize| {
        let all = points.iter().map(|it| it[coordinate]);
        let low = all.clone().fold(f64::INFINITY, f64::min);
        (low, all.fold(f64::NEG_INFINITY, f64::max))
    };
    let scale = |(coordinate, value): (usize, &f64)| match ends(coordinate) {
        (low, high) if high > low => (value - low) / (high - low),
        _ => 1.0,
    };
    let all = points.iter();
    all.map(|it| it.iter().enumerate().map(scale).collect())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{NonDominated, non_dominated};

    #[test]
    fn what_others_dominate_or_equal_is_left_out() {
        let points = [
            [3.0, 0.0],
            [2.0, 2.0],
            [2.0, 1.0],
            [0.0, 3.0],
            [2.0, 2.0 - 1e-9],
        ];
        let found = non_dominated(&points.map(Vec::from));
        let (members, nearest) = (vec![0, 1, 3], 1);
        assert_eq!(found, NonDominated { members, nearest });
        let (members, nearest) = (vec![0], 0);
        assert_eq!(
            non_dominated(&[vec![1.0, 5.0]]),
            NonDominated { members, nearest }
        );
        assert!(non_dominated(&[]).members.is_empty());
    }
}
