//! The problems of a front: which objective is best within which bounds of the others.

use super::space::digits;
use crate::order::{sort_falling, sort_rising};

/// Bounds of each objective but the first between its ends, by how many objectives there are from three on: 35, 26 and 15
/// problems.
const LEVELS: [usize; 3] = [5, 2, 1];
/// Gap between designs of two objectives, in units of their ranges, that needs no design.
const SMALL_GAP: f64 = 0.04;

/// Gap between the values of one of several objectives, as a share of its range, that needs no design.
const SMALL_MARGINAL_GAP: f64 = 0.15;

/// Bounds of each objective but the first, of so many.
pub(super) fn levels(objectives: usize) -> usize {
    LEVELS[(objectives - 3).min(LEVELS.len() - 1)]
}

/// What a problem of a front asks for.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FrontProblem {
    /// Which objective is to be best.
    pub objective: usize,
    /// Bounds of the objectives, in SI units.
    pub bounds: Vec<Option<f64>>,
}

/// For each objective the worst value of the best designs by each, and the best.
#[derive(Debug, Default)]
pub(super) struct Ranges(pub Vec<[f64; 2]>);

impl FrontProblem {
    /// The best by the first of so many objectives with a bound of one of them.
    pub fn of_bound(count: usize, bounded: usize, bound: f64) -> Self {
        let mut bounds = vec![None; count];
        bounds[bounded] = Some(bound);
        Self {
            objective: 0,
            bounds,
        }
    }
}

impl Ranges {
    /// A value of an objective in units of its range: 0 at its worst, 1 at its best.
    pub fn scaled(&self, index: usize, value: f64) -> f64 {
        let [worst, best] = self.0[index];
        (value - worst) / (best - worst)
    }

    /// Problems in the middle of the gaps between designs of two objectives, the widest first, but for those that were posed.
    pub fn widest_gaps(
        &self,
        mut points: Vec<Vec<f64>>,
        posed: &[FrontProblem],
    ) -> Vec<FrontProblem> {
        sort_rising(&mut points, |it| it[0]);
        let mut gaps: Vec<(f64, FrontProblem)> = Vec::new();
        for pair in points.windows(2) {
            let widths = [0, 1].map(|index| {
                (self.scaled(index, pair[0][index]) - self.scaled(index, pair[1][index])).abs()
            });
            let wider = usize::from(widths[1] > widths[0]);
            let of = |bounded: usize| FrontProblem {
                objective: 1 - bounded,
                ..FrontProblem::of_bound(2, bounded, 0.5 * (pair[0][bounded] + pair[1][bounded]))
            };
            let new = [wider, 1 - wider].map(of).into_iter();
            let mut new = new.filter(|it| !posed.contains(it));
            let width = widths[0].hypot(widths[1]);
            if width > SMALL_GAP {
                gaps.extend(new.next().map(|it| (width, it)));
            }
        }
        widest_first(gaps)
    }

    /// Problems in the middle of the gaps between the values that designs of several objectives have of each, the widest first,
    /// but for those that were posed: of the objective that the worse end of the gap has most more of.
    pub fn widest_marginal_gaps(
        &self,
        points: &[Vec<f64>],
        posed: &[FrontProblem],
    ) -> Vec<FrontProblem> {
        let count = self.0.len();
        let mut gaps: Vec<(f64, FrontProblem)> = Vec::new();
        for bounded in 0..count {
            let mut sorted: Vec<&Vec<f64>> = points.iter().collect();
            sort_rising(&mut sorted, |it| self.scaled(bounded, it[bounded]));
            for pair in sorted.windows(2) {
                let gain = |index: usize| {
                    self.scaled(index, pair[0][index]) - self.scaled(index, pair[1][index])
                };
                let others =
                    (0..count).filter(|index| *index != bounded && gain(*index).is_finite());
                let objective = others.max_by(|a, b| gain(*a).total_cmp(&gain(*b)));
                let middle = 0.5 * (pair[0][bounded] + pair[1][bounded]);
                let new = FrontProblem {
                    objective: objective.unwrap_or(0),
                    ..FrontProblem::of_bound(count, bounded, middle)
                };
                if -gain(bounded) > SMALL_MARGINAL_GAP && !posed.contains(&new) {
                    gaps.push((-gain(bounded), new));
                }
            }
        }
        widest_first(gaps)
    }

    /// Problems of the first objective with so many bounds of each other one, by the sums of their levels.
    pub fn lattice(&self) -> Vec<Vec<FrontProblem>> {
        let (others, levels) = (self.0.len() - 1, levels(self.0.len()));
        let count = (levels + 1).pow(others as u32);
        let bound = |index: usize, level: usize| {
            let [worst, best] = self.0[index];
            worst + (best - worst) * level as f64 / (levels + 1) as f64
        };
        let mut sums: Vec<Vec<FrontProblem>> = vec![Vec::new(); others * levels + 1];
        for number in 1..count {
            let own: Vec<usize> = digits(number, levels + 1, others).collect();
            let bounds = own.iter().enumerate();
            let bounds =
                bounds.map(|(place, level)| (*level > 0).then(|| bound(place + 1, *level)));
            sums[own.iter().sum::<usize>()].push(FrontProblem {
                objective: 0,
                bounds: [None].into_iter().chain(bounds).collect(),
            });
        }
        sums
    }
}

fn widest_first(mut gaps: Vec<(f64, FrontProblem)>) -> Vec<FrontProblem> {
    sort_falling(&mut gaps, |it| it.0);
    gaps.into_iter().map(|(_, it)| it).collect()
}
