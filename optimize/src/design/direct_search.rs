//! A direct search: without derivatives, by points around the best so far (Kolda, Lewis and Torczon 2003).

use std::mem;

use softstop_console::interrupt;

use super::coordinates::Coordinates;
use super::problem::Problem;

/// First distance of the points around the best, in edges of the cube.
const FIRST: f64 = 0.08;
/// Factor by which the distance shrinks where nothing better is found, and grows again, up to the first, where something is.
const SHRINKING: f64 = 0.7;
/// Rounds in a row that gain nothing, after which the search ends.
const FRUITLESS: usize = 2;
/// Steps back to the point from which the best has come in the direction that is tried again.
const STEPS_BACK: usize = 4;

/// A direct search in rounds, each from the first step on until that is shorter than `last`, until these gain nothing any more: `better`
/// tells the best of some points, if that is better, and whether it gains enough. Directions turn, a step that bettered is gone on with, and
/// the direction of the last few steps is tried, too: where the border of the machines that have a zone holds a design back, only a narrow
/// cone of directions leads up.
pub(super) fn direct_search<T>(
    problem: &Problem,
    mut best: T,
    last: f64,
    unit: impl Fn(&T) -> &Vec<f64>,
    better: impl Fn(&[Vec<f64>], &T) -> Option<(T, bool)>,
) -> T {
    let mut step = FIRST;
    let mut passed: Vec<Vec<f64>> = Vec::new();
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
        if fruitless == FRUITLESS || interrupt::requested() {
            break;
        }
        let coordinates = Coordinates::new(problem, unit(&best));
        let mut units = coordinates.around(step, turn);
        if let Some(before) = passed.last().filter(|_| has_bettered) {
            units.extend(coordinates.beyond(before, |way| [way, 2.0 * way]));
        }
        let mut earlier = passed.iter().rev().take(STEPS_BACK).skip(1);
        if let Some(earlier) = earlier.next_back() {
            units.extend(coordinates.beyond(earlier, |_| [step, -step]));
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
            passed.push(unit(&before).clone());
        }
    }
    best
}
