//! A direct search: without derivatives, by points around the best so far (Kolda, Lewis and Torczon 2003).

use std::collections::VecDeque;
use std::mem;

use softstop_console::interrupt;

use super::coordinates::Coordinates;
use super::problem::Problem;

/// First distance of the points around the best, in edges of the cube.
const FIRST: f64 = 0.08;
/// Factor by which the distance shrinks where nothing better is found, and grows again, up to the first, where something is.
const SHRINKING: f64 = 0.7;
/// Rounds in a row that gain nothing, after which the search ends.
const MAX_FRUITLESS_ROUNDS: usize = 2;
/// Points passed, at most, from the first of which to the best a direction leads that is tried; one tells no
/// other direction than the last step.
const MAX_PASSED: usize = 4;

/// A direct search in rounds, each from the first step on until that is shorter than `last`, until these gain nothing any
/// more: `better` tells the best of some points, if that is better, and whether it gains enough. Directions turn, a step
/// that bettered is gone on with, and the direction of the last few steps is tried, too: where the border of the machines
/// that have a zone holds a design back, only a narrow cone of directions leads up.
pub(super) fn direct_search<T>(
    problem: &Problem,
    mut best: T,
    last: f64,
    unit: impl Fn(&T) -> &Vec<f64>,
    better: impl Fn(&[Vec<f64>], &T) -> Option<(T, bool)>,
) -> T {
    let mut step = FIRST;
    let mut passed: VecDeque<Vec<f64>> = VecDeque::new();
    let mut has_bettered = false;
    let mut has_gained = false;
    let mut fruitless = 0;
    for turn in 0.. {
        if step < last {
            fruitless = match mem::take(&mut has_gained) {
                true => 0,
                false => fruitless + 1,
            };
            step = FIRST;
        }
        if fruitless == MAX_FRUITLESS_ROUNDS || interrupt::requested() {
            break;
        }
        let coordinates = Coordinates::new(problem, unit(&best));
        let mut units = coordinates.around(step, turn);
        if let Some(before) = passed.back().filter(|_| has_bettered) {
            units.extend(coordinates.beyond(before, |length| [length, 2.0 * length]));
        }
        if let Some(first) = passed.front().filter(|_| passed.len() > 1) {
            units.extend(coordinates.beyond(first, |_| [step, -step]));
        }
        let found = better(&units, &best);
        has_bettered = found.is_some();
        let gains = found.as_ref().is_some_and(|(_, gains)| *gains);
        has_gained |= gains;
        step = match gains {
            true => FIRST.min(step / SHRINKING),
            false => step * SHRINKING,
        };
        if let Some((better, _)) = found {
            let before = mem::replace(&mut best, better);
            passed.push_back(unit(&before).clone());
            if passed.len() > MAX_PASSED {
                passed.pop_front();
            }
        }
    }
    best
}
